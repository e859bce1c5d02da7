//! Products: parts with their solid, colour and properties, and assemblies.

use std::collections::{HashMap, HashSet};

use nalgebra::{Point3, Vector3};

use super::brep::Axes;
use super::catalogue::Product;
use super::context::Context;
use super::document::{Property, Value};
use super::geometry::Geometry;
use super::topology::Topology;
use crate::output::part21::{Fault, Id, List, Part21, Real, Text};

/// The two ends by which a product is placed in another.
#[derive(Clone, Copy)]
pub(super) struct Placed {
    /// PRODUCT_DEFINITION.
    pub(super) definition: Id,
    /// Its shape representation.
    pub(super) shape: Id,
}

/// Writes products, and remembers what they share.
pub(super) struct Products<'w, 'a> {
    pub(super) geometry: Geometry<'w, 'a>,
    context: Context,
    /// The placement at the origin; every representation has it.
    pub(super) origin: Id,
    names: HashSet<String>,
    products: Vec<Id>,
    styled: Vec<Id>,
    styles: HashMap<[u8; 3], Id>,
    units: HashMap<&'static str, Id>,
    /// GENERAL_PROPERTY by name, REPRESENTATION by the text of its only item.
    shared: HashMap<String, Id>,
}

impl<'w, 'a> Products<'w, 'a> {
    pub(super) fn new(part: &'w mut Part21<'a>, context: Context) -> Result<Self, Fault> {
        let axes = Axes::about(Point3::origin(), Vector3::z(), Vector3::x());
        let mut geometry = Geometry::new(part);
        let origin = geometry.placement(&axes)?;
        Ok(Self {
            geometry,
            context,
            origin,
            names: HashSet::new(),
            products: Vec::new(),
            styled: Vec::new(),
            styles: HashMap::new(),
            units: HashMap::new(),
            shared: HashMap::new(),
        })
    }

    pub(super) fn part(&mut self) -> &mut Part21<'a> {
        self.geometry.part
    }

    /// Writes a product with a solid in it.
    pub(super) fn leaf(&mut self, product: &Product<'_>) -> Result<Placed, Fault> {
        let brep = Topology::new(&mut self.geometry).solid(&product.solid)?;
        let (origin, context) = (self.origin, self.context.geometry);
        let shape = self.part().entity(format_args!(
            "ADVANCED_BREP_SHAPE_REPRESENTATION('',({origin},{brep}),{context})"
        ))?;
        let (placed, whole) = self.product(&product.part.product, shape)?;
        self.validation(whole, product.volume)?;
        let style = self.style(product.part.colour)?;
        let styled = self.part().entity(format_args!("STYLED_ITEM('',({style}),{brep})"))?;
        self.styled.push(styled);
        for property in &product.part.properties {
            self.property(placed.definition, property)?;
        }
        Ok(placed)
    }

    /// Writes an assembly product; `placements` are where its components go.
    pub(super) fn assembly(&mut self, name: &str, placements: &[Id]) -> Result<Placed, Fault> {
        let mut items = vec![self.origin];
        items.extend(placements);
        let mut there = HashSet::new();
        items.retain(|item| there.insert(*item));
        let (items, context) = (List(&items), self.context.geometry);
        let shape =
            self.part().entity(format_args!("SHAPE_REPRESENTATION('',{items},{context})"))?;
        Ok(self.product(name, shape)?.0)
    }

    /// States the volume, for readers that check what they made of a solid.
    ///
    /// Twelve digits: the rest is rounding, and differs from machine to machine.
    fn validation(&mut self, whole: Id, volume: f64) -> Result<(), Fault> {
        let (unit, context) = (self.power("VOLUME", 3.0)?, self.context.geometry);
        let volume = Real(format!("{volume:.11e}").parse().unwrap_or(volume));
        let part = self.part();
        let property = part.entity(format_args!(
            "PROPERTY_DEFINITION('geometric validation property','',{whole})"
        ))?;
        let item = part.entity(format_args!(
            "MEASURE_REPRESENTATION_ITEM('volume measure',VOLUME_MEASURE({volume}),{unit})"
        ))?;
        let value = part.entity(format_args!("REPRESENTATION('volume',({item}),{context})"))?;
        part.entity(format_args!("PROPERTY_DEFINITION_REPRESENTATION({property},{value})"))?;
        Ok(())
    }

    /// Writes the administrative chain from a product to its shape; also
    /// returns the PRODUCT_DEFINITION_SHAPE.
    fn product(&mut self, name: &str, shape: Id) -> Result<(Placed, Id), Fault> {
        let name = if name.trim().is_empty() { "Part" } else { name };
        let id = self.unique(name);
        let Context { product: context, definition: stage, .. } = self.context;
        let (id, name) = (Text(&id), Text(name));
        let product = self.part().entity(format_args!("PRODUCT({id},{name},'',({context}))"))?;
        let version =
            self.part().entity(format_args!("PRODUCT_DEFINITION_FORMATION('','',{product})"))?;
        let definition = self
            .part()
            .entity(format_args!("PRODUCT_DEFINITION('design','',{version},{stage})"))?;
        let whole =
            self.part().entity(format_args!("PRODUCT_DEFINITION_SHAPE('','',{definition})"))?;
        self.part().entity(format_args!("SHAPE_DEFINITION_REPRESENTATION({whole},{shape})"))?;
        self.products.push(product);
        Ok((Placed { definition, shape }, whole))
    }

    /// A product number nothing else has: the name, with a count if need be.
    fn unique(&mut self, name: &str) -> String {
        let mut id = name.to_owned();
        let mut count = 1;
        while !self.names.insert(id.clone()) {
            count += 1;
            id = format!("{name} ({count})");
        }
        id
    }

    /// The style of a colour, written once.
    fn style(&mut self, colour: [u8; 3]) -> Result<Id, Fault> {
        if let Some(id) = self.styles.get(&colour) {
            return Ok(*id);
        }
        let [r, g, b] = colour.map(|c| Real(f64::from(c) / 255.0));
        let rgb = self.part().entity(format_args!("COLOUR_RGB('',{r},{g},{b})"))?;
        let fill = self.part().entity(format_args!("FILL_AREA_STYLE_COLOUR('',{rgb})"))?;
        let fill = self.part().entity(format_args!("FILL_AREA_STYLE('',({fill}))"))?;
        let fill = self.part().entity(format_args!("SURFACE_STYLE_FILL_AREA({fill})"))?;
        let side = self.part().entity(format_args!("SURFACE_SIDE_STYLE('',({fill}))"))?;
        let usage = self.part().entity(format_args!("SURFACE_STYLE_USAGE(.BOTH.,{side})"))?;
        let style = self.part().entity(format_args!("PRESENTATION_STYLE_ASSIGNMENT(({usage}))"))?;
        self.styles.insert(colour, style);
        Ok(style)
    }

    /// One user-defined attribute of a product.
    ///
    /// OCCT shows it under the name of the GENERAL_PROPERTY.
    fn property(&mut self, definition: Id, property: &Property) -> Result<(), Fault> {
        let name = Text(&property.name).to_string();
        let general = self.once(format!("GENERAL_PROPERTY({name},{name},'')"))?;
        let item = self.item(&name, &property.value)?;
        let item = self.once(item)?;
        let context = self.context.geometry;
        let value = self.once(format!("REPRESENTATION('',({item}),{context})"))?;
        let part = self.part();
        let own = part.entity(format_args!("PROPERTY_DEFINITION({name},'',{definition})"))?;
        part.entity(format_args!("GENERAL_PROPERTY_ASSOCIATION('','',{general},{own})"))?;
        part.entity(format_args!("PROPERTY_DEFINITION_REPRESENTATION({own},{value})"))?;
        Ok(())
    }

    fn item(&mut self, name: &str, value: &Value) -> Result<String, Fault> {
        let measure = |kind: &str, x: f64, unit: Id| {
            format!("MEASURE_REPRESENTATION_ITEM({name},{kind}({}),{unit})", Real(x))
        };
        let number =
            |kind: &str, x: f64| format!("VALUE_REPRESENTATION_ITEM({name},{kind}({}))", Real(x));
        Ok(match *value {
            Value::Text(ref text) => {
                format!("DESCRIPTIVE_REPRESENTATION_ITEM({name},{})", Text(text))
            }
            Value::Length(x) => measure("LENGTH_MEASURE", x, self.context.millimetre),
            Value::Area(x) => measure("AREA_MEASURE", x, self.power("AREA", 2.0)?),
            Value::Volume(x) => measure("VOLUME_MEASURE", x, self.power("VOLUME", 3.0)?),
            Value::Mass(x) => measure("MASS_MEASURE", x, self.kilogram()?),
            Value::Degrees(x) => measure("PLANE_ANGLE_MEASURE", x, self.degree()?),
            Value::Number(x) => number("NUMERIC_MEASURE", x),
            Value::Count(n) => number("COUNT_MEASURE", f64::from(n)),
        })
    }

    /// mm² or mm³.
    fn power(&mut self, name: &'static str, exponent: f64) -> Result<Id, Fault> {
        if let Some(id) = self.units.get(name) {
            return Ok(*id);
        }
        let (millimetre, exponent) = (self.context.millimetre, Real(exponent));
        let element =
            self.part().entity(format_args!("DERIVED_UNIT_ELEMENT({millimetre},{exponent})"))?;
        let unit = self.part().entity(format_args!("DERIVED_UNIT(({element}))"))?;
        self.units.insert(name, unit);
        Ok(unit)
    }

    fn kilogram(&mut self) -> Result<Id, Fault> {
        self.once("(MASS_UNIT()NAMED_UNIT(*)SI_UNIT(.KILO.,.GRAM.))".to_owned())
    }

    fn degree(&mut self) -> Result<Id, Fault> {
        let none = self.once("DIMENSIONAL_EXPONENTS(0.,0.,0.,0.,0.,0.,0.)".to_owned())?;
        let (one, radian) = (Real(1f64.to_radians()), self.context.radian);
        let size = self
            .once(format!("PLANE_ANGLE_MEASURE_WITH_UNIT(PLANE_ANGLE_MEASURE({one}),{radian})"))?;
        self.once(format!(
            "(CONVERSION_BASED_UNIT('DEGREE',{size})NAMED_UNIT({none})PLANE_ANGLE_UNIT())"
        ))
    }

    /// Writes an entity unless the very same has been written.
    fn once(&mut self, entity: String) -> Result<Id, Fault> {
        if let Some(id) = self.shared.get(&entity) {
            return Ok(*id);
        }
        let id = self.part().entity(format_args!("{entity}"))?;
        self.shared.insert(entity, id);
        Ok(id)
    }

    /// Writes what lists all products and all colours.
    pub(super) fn finish(mut self) -> Result<(), Fault> {
        let context = self.context.geometry;
        let (products, styled) =
            (std::mem::take(&mut self.products), std::mem::take(&mut self.styled));
        let products = List(&products);
        self.part()
            .entity(format_args!("PRODUCT_RELATED_PRODUCT_CATEGORY('part',$,{products})"))?;
        let styled = List(&styled);
        self.part().entity(format_args!(
            "MECHANICAL_DESIGN_GEOMETRIC_PRESENTATION_REPRESENTATION('',{styled},{context})"
        ))?;
        Ok(())
    }
}
