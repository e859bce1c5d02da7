//! The data of an ASCII PLY file: one element a line.

use ply_rs_bw::ply::PropertyType;

use super::Reader;
use super::columns::{ElementKind, Slot, is_integer_type};
use super::header::{Element, Header};
use super::record::{Face, Point, Record};
use crate::error::ReadError;
use crate::input::Input;
use crate::line::{FieldFault, Fields, Line};

/// One value, or one list, of a line.
#[derive(Clone, Copy, Debug)]
struct Column {
    slot: Slot,
    is_list: bool,
    is_integer: bool,
}

/// Reads all elements.
pub(super) fn read(
    input: &mut Input<'_>,
    header: &Header,
    reader: &mut Reader<'_>,
) -> Result<(), ReadError> {
    for element in &header.elements {
        element.check_count(input, header.encoding)?;
        let columns = columns_of(element);
        match element.kind {
            ElementKind::Point => {
                reader.builder.mesh.positions.reserve_exact(element.definition.count);
                each(input, element, |line| point(&line, &columns, reader))?;
            }
            ElementKind::Face => each(input, element, |line| face(&line, &columns, reader))?,
            ElementKind::Other if columns.is_empty() => {}
            ElementKind::Other => each(input, element, |_| Ok(()))?,
        }
    }
    match input.next_content()? {
        Some(line) => Err(line.malformed("the end of the file after the last element", line.text)),
        None => Ok(()),
    }
}

fn columns_of(element: &Element) -> Vec<Column> {
    let properties = element.definition.properties.iter();
    let column = |(name, is_list, is_integer): (&String, bool, bool)| Column {
        slot: Slot::of_name(name),
        is_list,
        is_integer,
    };
    properties
        .map(|(name, property)| match &property.data_type {
            PropertyType::Scalar(scalar) => (name, false, is_integer_type(scalar)),
            PropertyType::List(_, item) => (name, true, is_integer_type(item)),
        })
        .map(column)
        .collect()
}

fn each(
    input: &mut Input<'_>,
    element: &Element,
    mut take: impl FnMut(Line<'_>) -> Result<(), ReadError>,
) -> Result<(), ReadError> {
    for number in 0..element.count() {
        match input.next_content()? {
            Some(line) => take(line)?,
            None => {
                let what = format!("{} {} of {}", element.title(), number + 1, element.count());
                return Err(input.cut_off(what));
            }
        }
    }
    Ok(())
}

fn point(line: &Line<'_>, columns: &[Column], reader: &mut Reader<'_>) -> Result<(), ReadError> {
    let mut fields = line.fields();
    let mut point = Point::default();
    for column in columns {
        if column.is_list {
            skip_list(line, &mut fields)?;
        } else {
            single(line, &mut fields, column, &mut point)?;
        }
    }
    check_end(line, fields)?;
    reader.point(&point, || line.place())
}

fn face(line: &Line<'_>, columns: &[Column], reader: &mut Reader<'_>) -> Result<(), ReadError> {
    let mut fields = line.fields();
    let mut face = Face::default();
    for column in columns {
        if column.slot == Slot::Corners {
            let count = list_length(line, &mut fields)?;
            reader.builder.check_corner_count(count)?;
            for _ in 0..count {
                let expected = "the index of a corner";
                let corner = fields.integer().map_err(|fault| line.fault(expected, fault))?;
                reader.corner(corner, || line.place())?;
            }
        } else if column.is_list {
            skip_list(line, &mut fields)?;
        } else {
            single(line, &mut fields, column, &mut face)?;
        }
    }
    check_end(line, fields)?;
    reader.face(&face, || line.place())
}

#[inline]
fn single(
    line: &Line<'_>,
    fields: &mut Fields<'_>,
    column: &Column,
    record: &mut impl Record,
) -> Result<(), ReadError> {
    let fault = |fault: FieldFault<'_>| {
        let kind = if column.is_integer { "a whole number" } else { "a number" };
        line.fault(format!("{kind} for each property of the element"), fault)
    };
    match column.slot {
        Slot::Unused => {
            fields.word().ok_or_else(|| fault(FieldFault::Missing))?;
        }
        // A colour may be declared as float and have a part that is not a number; so may quality.
        slot if column.is_integer => record.integer(slot, fields.integer().map_err(fault)?),
        slot @ (Slot::X | Slot::Y | Slot::Z) => record.real(slot, fields.number().map_err(fault)?),
        slot => record.real(slot, fields.any_number().map_err(fault)?),
    }
    Ok(())
}

fn list_length(line: &Line<'_>, fields: &mut Fields<'_>) -> Result<u64, ReadError> {
    fields.count().map_err(|fault| line.fault("the length of a list", fault))
}

fn skip_list(line: &Line<'_>, fields: &mut Fields<'_>) -> Result<(), ReadError> {
    for _ in 0..list_length(line, fields)? {
        if fields.word().is_none() {
            return Err(
                line.fault("as many values as the list has by its length", FieldFault::Missing)
            );
        }
    }
    Ok(())
}

fn check_end(line: &Line<'_>, mut fields: Fields<'_>) -> Result<(), ReadError> {
    if fields.is_empty() {
        return Ok(());
    }
    Err(line.malformed("no more values than the header declares for the element", fields.rest()))
}
