//! Typed indices into the arrays of a mesh.

macro_rules! id_type {
    ($(#[$doc:meta])* $name:ident) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub struct $name(pub u32);

        impl $name {
            /// The id of entry `index`; meshes hold fewer than 2³² entries of any kind.
            pub fn new(index: usize) -> Self {
                debug_assert!(index <= u32::MAX as usize);
                Self(index as u32)
            }

            /// Position in the array the id belongs to.
            pub fn index(self) -> usize {
                self.0 as usize
            }
        }
    };
}
pub(crate) use id_type;

id_type!(
    /// A point of the surface.
    VertexId
);
id_type!(
    /// A directed side of a triangle; `face * 3 + side`.
    HalfEdgeId
);
id_type!(
    /// A triangle.
    FaceId
);
id_type!(
    /// A set of connected non-design faces (thesis §3.4.1.1).
    SetId
);

impl HalfEdgeId {
    /// The triangle the half-edge is a side of.
    pub fn face(self) -> FaceId {
        FaceId(self.0 / 3)
    }

    /// The next side of the same triangle, counter-clockwise seen from outside.
    pub fn next(self) -> Self {
        Self(if self.0 % 3 == 2 { self.0 - 2 } else { self.0 + 1 })
    }

    /// The side before this one in the same triangle.
    pub fn previous(self) -> Self {
        Self(if self.0.is_multiple_of(3) { self.0 + 2 } else { self.0 - 1 })
    }
}

impl FaceId {
    /// The three sides of the triangle, in order.
    pub fn half_edges(self) -> [HalfEdgeId; 3] {
        [HalfEdgeId(3 * self.0), HalfEdgeId(3 * self.0 + 1), HalfEdgeId(3 * self.0 + 2)]
    }
}
