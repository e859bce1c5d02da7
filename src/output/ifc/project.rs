//! What stands above the members: units, contexts, and the storey of a building on a site.

use super::guid::Guid;
use crate::output::part21::{Fault, Id, List, Part21, Text};

/// The entities of a project that its members refer to.
pub(super) struct Project {
    /// Axes of the whole and of every placement.
    pub(super) origin: Id,
    /// Contexts of axes and of bodies.
    pub(super) contexts: [Id; 2],
    pub(super) storey: Id,
    pub(super) storey_placement: Id,
}

impl Project {
    /// Writes a project down to its one storey.
    pub(super) fn write(part: &mut Part21<'_>, name: &str) -> Result<Self, Fault> {
        let zero = part.entity(format_args!("IFCCARTESIANPOINT((0.,0.,0.))"))?;
        let origin = part.entity(format_args!("IFCAXIS2PLACEMENT3D({zero},$,$)"))?;
        let units = units(part)?;
        let context = part.entity(format_args!(
            "IFCGEOMETRICREPRESENTATIONCONTEXT($,'Model',3,1.E-5,{origin},$)"
        ))?;
        let contexts = [sub_context(part, "Axis", context)?, sub_context(part, "Body", context)?];
        let text = Text(name);
        let guid = |what: &str| Guid::of(&[name, what]);
        let project = part.entity(format_args!(
            "IFCPROJECT({},$,{text},$,$,$,$,({context}),{units})",
            guid("project")
        ))?;
        let at = part.entity(format_args!("IFCLOCALPLACEMENT($,{origin})"))?;
        let site = part.entity(format_args!(
            "IFCSITE({},$,'Site',$,$,{at},$,$,.ELEMENT.,$,$,$,$,$)",
            guid("site")
        ))?;
        let at = part.entity(format_args!("IFCLOCALPLACEMENT({at},{origin})"))?;
        let building = part.entity(format_args!(
            "IFCBUILDING({},$,{text},$,$,{at},$,$,.ELEMENT.,$,$,$)",
            guid("building")
        ))?;
        let storey_placement = part.entity(format_args!("IFCLOCALPLACEMENT({at},{origin})"))?;
        let storey = part.entity(format_args!(
            "IFCBUILDINGSTOREY({},$,'Frame',$,$,{storey_placement},$,$,.ELEMENT.,0.)",
            guid("storey")
        ))?;
        for (what, above, below) in [
            ("project-site", project, site),
            ("site-building", site, building),
            ("building-storey", building, storey),
        ] {
            let guid = guid(what);
            part.entity(format_args!("IFCRELAGGREGATES({guid},$,$,$,{above},({below}))"))?;
        }
        Ok(Self { origin, contexts, storey, storey_placement })
    }
}

/// Millimetres, and what goes with them.
fn units(part: &mut Part21<'_>) -> Result<Id, Fault> {
    let units = List([
        part.entity(format_args!("IFCSIUNIT(*,.LENGTHUNIT.,.MILLI.,.METRE.)"))?,
        part.entity(format_args!("IFCSIUNIT(*,.AREAUNIT.,.MILLI.,.SQUARE_METRE.)"))?,
        part.entity(format_args!("IFCSIUNIT(*,.VOLUMEUNIT.,.MILLI.,.CUBIC_METRE.)"))?,
        part.entity(format_args!("IFCSIUNIT(*,.PLANEANGLEUNIT.,$,.RADIAN.)"))?,
        part.entity(format_args!("IFCSIUNIT(*,.MASSUNIT.,.KILO.,.GRAM.)"))?,
    ]);
    part.entity(format_args!("IFCUNITASSIGNMENT({units})"))
}

fn sub_context(part: &mut Part21<'_>, kind: &str, context: Id) -> Result<Id, Fault> {
    part.entity(format_args!(
        "IFCGEOMETRICREPRESENTATIONSUBCONTEXT({},'Model',*,*,*,*,{context},$,.MODEL_VIEW.,$)",
        Text(kind)
    ))
}
