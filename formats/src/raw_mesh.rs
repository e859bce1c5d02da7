//! What a file says, before anything is made of it: points, polygons and every carrier of a label.

/// A surface mesh as read: points in millimetres, polygons in file order, label carriers.
///
/// Invariants, kept by every reader: all coordinates are finite; every index is below
/// `positions.len()`; every polygon has at least three corners; each label carrier is either
/// empty or as long as the faces (or the points) it belongs to.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RawMesh {
    /// Points, mm (after the unit of the file was applied).
    pub positions: Vec<[f64; 3]>,
    /// Faces in file order.
    pub faces: Polygons,
    /// Everything the file says about its faces that may mean "non-design".
    pub carriers: LabelCarriers,
    /// Where the labels of this format live, for messages: "OBJ group names".
    pub label_source: &'static str,
}

/// Polygons as one run of corners.
#[derive(Clone, Debug, PartialEq)]
pub struct Polygons {
    /// Corner indices of all polygons, one after the other.
    pub corners: Vec<u32>,
    /// Start of each polygon in `corners`, and the end of the last: `len() + 1` entries.
    pub starts: Vec<u32>,
}

impl RawMesh {
    /// Asserts all invariants; for tests, here and of what is made from the mesh.
    ///
    /// # Panics
    /// If one is broken.
    pub fn check(&self) {
        let (points, faces) = (self.positions.len(), self.faces.len());
        assert!(self.positions.iter().flatten().all(|coordinate| coordinate.is_finite()));
        let Polygons { corners, starts } = &self.faces;
        assert_eq!(starts.first(), Some(&0));
        assert_eq!(starts.last().map(|&end| end as usize), Some(corners.len()));
        assert!(starts.windows(2).all(|pair| pair[1] >= pair[0] + 3));
        assert!(corners.iter().all(|&corner| (corner as usize) < points));

        let carriers = &self.carriers;
        let belongs = |length: usize, to: usize| assert!(length == 0 || length == to);
        belongs(carriers.face_property.len(), faces);
        belongs(carriers.face_selected.len(), faces);
        belongs(carriers.face_quality.len(), faces);
        belongs(carriers.face_colour.len(), faces);
        belongs(carriers.vertex_colour.len(), points);
        belongs(carriers.face_names.len(), faces);
        let (names, sets) = (&carriers.names, &carriers.name_sets);
        assert!(carriers.face_names.iter().all(|&set| (set as usize) < sets.len()));
        assert!(sets.iter().flatten().all(|&name| (name as usize) < names.len()));
    }
}

impl Default for Polygons {
    fn default() -> Self {
        Self { corners: Vec::new(), starts: vec![0] }
    }
}

impl Polygons {
    /// Number of polygons.
    pub fn len(&self) -> usize {
        self.starts.len() - 1
    }

    /// Whether there is no polygon.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Appends one polygon; all together must have fewer than 2³² corners.
    pub fn push(&mut self, corners: impl IntoIterator<Item = u32>) {
        self.corners.extend(corners);
        self.starts.push(self.corners.len() as u32);
    }

    /// Corners of polygon `face`.
    ///
    /// # Panics
    /// If there is no such polygon.
    pub fn corners_of(&self, face: usize) -> &[u32] {
        &self.corners[self.starts[face] as usize..self.starts[face + 1] as usize]
    }

    /// The polygons in order.
    pub fn iter(&self) -> impl Iterator<Item = &[u32]> {
        (0..self.len()).map(|face| self.corners_of(face))
    }
}

/// Everything in a file that may say which faces the optimiser had to keep.
///
/// The readers only carry; `beamwright::mesh::label` decides, in the order of the fields.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LabelCarriers {
    /// An integer property of the face made for this purpose (PLY `non_design`); not 0 = non-design.
    pub face_property: Vec<i64>,
    /// MeshLab's selection: true where bit 32 of the PLY face `flags` is set.
    pub face_selected: Vec<bool>,
    /// PLY face `quality`.
    pub face_quality: Vec<f32>,
    /// Face colour, 8 bits a channel (PLY, COFF faces, binary STL attribute bytes, materials of OBJ
    /// and glTF); `None` where a face has none.
    pub face_colour: Vec<Option<[u8; 3]>>,
    /// Colour of each point, 8 bits a channel; white where only others have one.
    pub vertex_colour: Vec<[u8; 3]>,
    /// Distinct names met in the file: groups, objects, materials, solids, nodes, meshes.
    pub names: Vec<String>,
    /// For each face a set of names, as an index into `name_sets`.
    pub face_names: Vec<u32>,
    /// Each entry: the indices into `names` that hold together for a face (its group, object and
    /// material, say).
    pub name_sets: Vec<Vec<u32>>,
}
