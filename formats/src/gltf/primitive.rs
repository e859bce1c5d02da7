//! The triangles of a mesh at its place.

use std::collections::HashMap;
use std::path::Path;

use gltf::accessor::{DataType, Dimensions};
use gltf::mesh::{Mode, Primitive, Semantic};

use super::accessor::{check, check_type};
use super::buffer::Buffers;
use super::malformed;
use super::scene::{Instance, Placement};
use crate::builder::Builder;
use crate::colour::{Colours, Scale};
use crate::error::{Place, ReadError};
use crate::names::{MOST_NAMES, NameTable};
use crate::raw_mesh::RawMesh;

/// Points and corners that may come from using data of the buffers again.
///
/// A few bytes of a node repeat a whole mesh. Beyond what the buffers hold once, this many points
/// and corners may come of it; they take up to 300 MB.
const MOST_REPEATED: u64 = 8_000_000;

/// Gathers the triangles of all instances.
pub(super) struct Emitter<'a> {
    builder: Builder<'a>,
    path: &'a Path,
    names: NameTable,
    face_colours: Colours,
    point_colours: Colours,
    /// Points and corners so far.
    emitted: u64,
}

/// Where the points of an accessor begin in the mesh, and how many there are.
#[derive(Clone, Copy)]
struct Points {
    first: u32,
    count: u32,
}

/// Points of one instance by the accessors of position and colour: primitives may share them.
type SharedPoints = HashMap<(usize, Option<usize>), Points>;

impl<'a> Emitter<'a> {
    pub(super) fn new(builder: Builder<'a>, path: &'a Path) -> Self {
        Self {
            builder,
            path,
            names: NameTable::default(),
            face_colours: Colours::default(),
            point_colours: Colours::default(),
            emitted: 0,
        }
    }

    /// Adds the triangles of one mesh at one place.
    pub(super) fn instance(
        &mut self,
        instance: &Instance<'_>,
        buffers: &mut Buffers<'_>,
    ) -> Result<(), ReadError> {
        let mut shared = SharedPoints::new();
        for primitive in instance.mesh.primitives() {
            let is_surface = matches!(
                primitive.mode(),
                Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan
            );
            if is_surface {
                self.primitive(instance, &primitive, &mut shared, buffers)?;
            }
        }
        Ok(())
    }

    fn primitive(
        &mut self,
        instance: &Instance<'_>,
        primitive: &Primitive<'_>,
        shared: &mut SharedPoints,
        buffers: &mut Buffers<'_>,
    ) -> Result<(), ReadError> {
        let part = format!("meshes[{}].primitives[{}]", instance.mesh.index(), primitive.index());
        let points = self.points(&part, instance, primitive, shared, buffers)?;
        let faces_before = self.builder.mesh.faces.len();
        self.triangles(&part, &instance.placement, primitive, points, buffers)?;
        let faces = self.builder.mesh.faces.len() - faces_before;

        let material = primitive.material();
        let own = [material.name().unwrap_or_default(), instance.mesh.name().unwrap_or_default()];
        let names = own.into_iter().chain(instance.names.iter().copied()).map(str::as_bytes);
        let set = self.names.set(names).map_err(|_| {
            self.builder.too_many("names of nodes, meshes and materials", MOST_NAMES as u64)
        })?;
        self.names.give(set, faces);
        let colour = material.index().map(|_| {
            let [r, g, b, _] = material.pbr_metallic_roughness().base_color_factor();
            [r, g, b]
        });
        for _ in 0..faces {
            self.face_colours.push(colour);
        }
        Ok(())
    }

    /// Adds the points of a primitive, unless another of the same instance has added them.
    fn points(
        &mut self,
        part: &str,
        instance: &Instance<'_>,
        primitive: &Primitive<'_>,
        shared: &mut SharedPoints,
        buffers: &mut Buffers<'_>,
    ) -> Result<Points, ReadError> {
        let Some(positions) = primitive.get(&Semantic::Positions) else {
            return Err(malformed(self.path, part, "positions", "none"));
        };
        let colours = primitive.get(&Semantic::Colors(0));
        let key = (positions.index(), colours.as_ref().map(|colours| colours.index()));
        if let Some(&points) = shared.get(&key) {
            return Ok(points);
        }
        let expected = "positions as Vec3 of F32 (export without KHR_mesh_quantization)";
        check_type(&positions, buffers, expected, |data, dimensions| {
            (data, dimensions) == (DataType::F32, Dimensions::Vec3)
        })?;
        check(&positions, buffers)?;
        self.charge(positions.count(), buffers)?;
        let first = self.builder.mesh.positions.len() as u64;
        self.builder.check_point_count(first + positions.count() as u64)?;

        self.add_positions(part, &instance.placement, primitive, buffers)?;
        self.add_colours(primitive, positions.count(), buffers)?;
        let points = Points { first: first as u32, count: positions.count() as u32 };
        shared.insert(key, points);
        Ok(points)
    }

    fn add_positions(
        &mut self,
        part: &str,
        placement: &Placement,
        primitive: &Primitive<'_>,
        buffers: &Buffers<'_>,
    ) -> Result<(), ReadError> {
        let reader = primitive.reader(|buffer| buffers.get(buffer.index()));
        for (number, position) in reader.read_positions().into_iter().flatten().enumerate() {
            let position = placement.apply(position.map(f64::from));
            self.builder.point(position).map_err(|_| {
                let [x, y, z] = position;
                ReadError::NotFinite {
                    path: self.path.to_owned(),
                    place: Place::Part(format!("{part}.attributes.POSITION")),
                    number: format!(
                        "point {number} ({x:?}, {y:?}, {z:?}), where its node puts it,"
                    ),
                }
            })?;
        }
        Ok(())
    }

    fn add_colours(
        &mut self,
        primitive: &Primitive<'_>,
        points: usize,
        buffers: &mut Buffers<'_>,
    ) -> Result<(), ReadError> {
        let Some(colours) = primitive.get(&Semantic::Colors(0)) else {
            for _ in 0..points {
                self.point_colours.push(None);
            }
            return Ok(());
        };
        let expected = "colours as Vec3 or Vec4 of F32, U8 or U16";
        check_type(&colours, buffers, expected, |data, dimensions| {
            matches!(data, DataType::F32 | DataType::U8 | DataType::U16)
                && matches!(dimensions, Dimensions::Vec3 | Dimensions::Vec4)
        })?;
        check(&colours, buffers)?;
        if colours.count() != points {
            let part = format!("accessors[{}]", colours.index());
            let expected = format!("a colour for each of the {points} points");
            return Err(malformed(self.path, part, expected, colours.count().to_string()));
        }
        let reader = primitive.reader(|buffer| buffers.get(buffer.index()));
        for colour in reader.read_colors(0).into_iter().flat_map(|colours| colours.into_rgb_f32()) {
            self.point_colours.push(Some(colour));
        }
        Ok(())
    }

    fn triangles(
        &mut self,
        part: &str,
        placement: &Placement,
        primitive: &Primitive<'_>,
        points: Points,
        buffers: &mut Buffers<'_>,
    ) -> Result<(), ReadError> {
        let flip = placement.mirrors();
        let Some(indices) = primitive.indices() else {
            self.charge(points.count as usize, buffers)?;
            let corners = 0..points.count;
            return self.connect(part, primitive.mode(), flip, points, corners);
        };
        let expected = "indices as Scalar of U8, U16 or U32";
        check_type(&indices, buffers, expected, |data, dimensions| {
            matches!(data, DataType::U8 | DataType::U16 | DataType::U32)
                && dimensions == Dimensions::Scalar
        })?;
        check(&indices, buffers)?;
        self.charge(indices.count(), buffers)?;
        let buffers = &*buffers;
        let reader = primitive.reader(|buffer| buffers.get(buffer.index()));
        let corners = reader.read_indices().into_iter().flat_map(|indices| indices.into_u32());
        self.connect(&format!("{part}.indices"), primitive.mode(), flip, points, corners)
    }

    /// Makes triangles of a run of corners.
    fn connect(
        &mut self,
        part: &str,
        mode: Mode,
        flip: bool,
        points: Points,
        corners: impl Iterator<Item = u32>,
    ) -> Result<(), ReadError> {
        // The last two corners, or the first and the last of a fan.
        let (mut a, mut b) = (0, 0);
        let mut count = 0_usize;
        for c in corners {
            if c >= points.count {
                return Err(ReadError::IndexOutOfRange {
                    path: self.path.to_owned(),
                    place: Place::Part(format!("{part}[{count}]")),
                    index: c.to_string(),
                    range: format!("points are numbered from 0 to {}", points.count - 1),
                });
            }
            if let Some(triangle) = completed_triangle(mode, count, flip, [a, b, c]) {
                self.triangle(triangle.map(|corner| points.first + corner))?;
            }
            match mode {
                Mode::TriangleFan if count == 0 => a = c,
                Mode::TriangleFan => b = c,
                _ => (a, b) = (b, c),
            }
            count += 1;
        }
        if mode == Mode::Triangles && !count.is_multiple_of(3) {
            let expected = "three corners for each triangle";
            return Err(malformed(self.path, part, expected, format!("{count} corners")));
        }
        Ok(())
    }

    #[inline]
    fn triangle(&mut self, corners: [u32; 3]) -> Result<(), ReadError> {
        corners.into_iter().for_each(|corner| self.builder.corner(corner));
        self.builder.close_face()
    }

    /// Counts points or corners before they are added.
    fn charge(&mut self, count: usize, buffers: &Buffers<'_>) -> Result<(), ReadError> {
        self.emitted = self.emitted.saturating_add(count as u64);
        if self.emitted > MOST_REPEATED.saturating_add(buffers.size()) {
            let what = "points and corners of meshes that are used again and again";
            return Err(self.builder.too_many(what, MOST_REPEATED));
        }
        Ok(())
    }

    /// The finished mesh.
    pub(super) fn finish(self, label_source: &'static str) -> Result<RawMesh, ReadError> {
        let mut mesh = self.builder.finish(label_source)?;
        mesh.carriers.face_colour = self.face_colours.of_faces(Scale::Unit);
        mesh.carriers.vertex_colour = self.point_colours.of_points(Scale::Unit);
        self.names.move_to(&mut mesh.carriers);
        Ok(mesh)
    }
}

/// The triangle that is complete with its last corner, `number` in the run of all corners.
#[inline]
fn completed_triangle(
    mode: Mode,
    number: usize,
    flip: bool,
    [a, b, c]: [u32; 3],
) -> Option<[u32; 3]> {
    let is_complete = match mode {
        Mode::Triangles => number % 3 == 2,
        // Strips are sewn together by triangles without area.
        _ => number >= 2 && a != b && b != c && c != a,
    };
    // Every second triangle of a strip goes the other way round.
    let is_turned = flip != (mode == Mode::TriangleStrip && number % 2 == 1);
    is_complete.then_some(if is_turned { [b, a, c] } else { [a, b, c] })
}
