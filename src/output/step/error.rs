//! Why a document could not be written.

/// Why [`write`](super::write) gave up.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum StepError {
    /// No group holds a part; a STEP file without a shape opens as nothing.
    #[error("nothing to write: the document {document:?} holds no part")]
    Empty {
        /// Name of the document.
        document: String,
    },

    /// The shape of a part is not a solid.
    #[error("part {part:?}: {fault}")]
    Body {
        /// Instance name of the part.
        part: String,
        /// What is wrong with it.
        #[source]
        fault: BodyError,
    },

    /// A number of a part, or one computed from it, is NaN or infinite.
    #[error("part {part:?}: {what} is not a finite number")]
    NotFinite {
        /// Instance name of the part.
        part: String,
        /// Which number.
        what: &'static str,
    },

    /// The file could not be written.
    #[error(transparent)]
    Io(#[from] std::io::Error),
}

/// Why a [`Body`](super::Body) is not a solid.
///
/// Stations, holes, faces and corners are counted from 0; lengths are mm.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum BodyError {
    /// A measure is NaN or infinite.
    #[error("{what} is not a finite number")]
    NotFinite {
        /// Which measure.
        what: &'static str,
    },

    /// A measure must be positive.
    #[error("{what} must be positive, but is {value}")]
    NotPositive {
        /// Which measure.
        what: &'static str,
        /// Its value.
        value: f64,
    },

    /// An outline has a piece shorter than a CAD kernel can tell from a point.
    #[error("outline piece {piece} is only {length:e} mm long")]
    TinyEdge {
        /// Place of the piece in the outline.
        piece: usize,
        /// Its length.
        length: f64,
    },

    /// An arc does not turn, or turns a full circle and more.
    #[error("an arc turns by {radians} rad; it must turn, and by less than a full circle")]
    BadSweep {
        /// The angle given.
        radians: f64,
    },

    /// An outline has too few points, or its points lie on one line.
    #[error("an outline encloses no area")]
    NoArea,

    /// An outline crosses itself.
    #[error("an outline crosses itself between its pieces {first} and {second}")]
    SelfCrossing {
        /// Place of one piece in the outline.
        first: usize,
        /// Place of the other.
        second: usize,
    },

    /// A hole is not inside the outer outline, or cuts another hole.
    #[error("station {station}: hole {hole} is not clear of the outline and of the other holes")]
    HoleOutside {
        /// Which station.
        station: usize,
        /// Which hole.
        hole: usize,
    },

    /// A loft needs at least two stations.
    #[error("a loft needs two stations or more, but has {count}")]
    TooFewStations {
        /// How many it has.
        count: usize,
    },

    /// Stations must follow each other along +z.
    #[error("station {station} is not above the one before it")]
    NotAscending {
        /// Which station.
        station: usize,
    },

    /// Two stations have outlines that no surface connects piece by piece.
    #[error(
        "station {station} has another number of holes, or outlines with other pieces, than station 0"
    )]
    UnlikeOutlines {
        /// Which station.
        station: usize,
    },

    /// An end cut runs nearly along the beam.
    #[error(
        "the cut at the {end} is {degrees:.1}° off square; at most {most}° can be made",
        most = super::tolerance::MOST_OBLIQUE_DEGREES
    )]
    TooOblique {
        /// `"start"` or `"end"`.
        end: &'static str,
        /// Angle between the cut and a square one.
        degrees: f64,
    },

    /// An end cannot lie along a round member.
    #[error("an end cannot be a saddle: {why}")]
    NoSaddle {
        /// What is in the way.
        why: &'static str,
    },

    /// The end cuts meet inside the beam and leave no length on one side.
    #[error("the end cuts cross each other inside the beam")]
    CutsCross,

    /// Between two stations the section shrinks to nothing or turns inside out.
    #[error("the section vanishes or turns inside out between the stations")]
    SectionVanishes,

    /// A face names a corner or circle that is not there.
    #[error("face {face} refers to a corner or circle that does not exist")]
    NoSuchCorner {
        /// Which face.
        face: usize,
    },

    /// A flat face has corners off its plane.
    #[error("face {face} is not flat: a corner lies {off:e} mm off its plane")]
    NotFlat {
        /// Which face.
        face: usize,
        /// Largest distance of a corner from the plane.
        off: f64,
    },

    /// The two circles of a cylinder face differ in axis or radius.
    #[error("face {face} is not a cylinder: its circles differ in axis or radius")]
    NotCylinder {
        /// Which face.
        face: usize,
    },

    /// The faces do not close up, or not everywhere with the same side out.
    #[error("the faces do not enclose a solid: {0}")]
    NotClosed(String),

    /// The faces enclose several solids; each must be a part of its own.
    #[error("the faces enclose {count} separate solids; make each a part of its own")]
    SeveralSolids {
        /// How many.
        count: usize,
    },

    /// The body has no volume, or is inside out.
    #[error("the enclosed volume is {volume} mm³, not positive")]
    NoVolume {
        /// The volume.
        volume: f64,
    },
}

/// Refuses what is not a positive finite number.
pub(super) fn positive(what: &'static str, value: f64) -> Result<(), BodyError> {
    if !value.is_finite() {
        Err(BodyError::NotFinite { what })
    } else if value <= 0.0 {
        Err(BodyError::NotPositive { what, value })
    } else {
        Ok(())
    }
}
