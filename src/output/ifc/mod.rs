//! The frame as IFC4: one `IfcMember` a beam, with its profile, material and quantities.
//!
//! ```text
//! IfcProject ─ IfcSite ─ IfcBuilding ─ IfcBuildingStorey ─ IfcMember …
//!                                                           │  extruded profile along the axis
//!                                                           ├─ IfcMaterialProfileSet
//!                                                           ├─ Qto_MemberBaseQuantities
//!                                                           └─ Beamwright: mark, branch
//! ```
//!
//! Members are extruded square between the cuts on their axis, tapers with their mean profile: the
//! STEP file has the exact solids. Identifiers are made of the name of the part and the mark, so
//! that a member keeps its own when the file is written again.

mod guid;
mod profile;
mod project;

use std::io::{self, Write};

use nalgebra::{Point3, Unit, Vector3};

use self::guid::Guid;
use self::project::Project;
use super::assembly::mark;
use super::material::Material;
use super::part21::{Fault, Id, List, Part21, Real, Text};
use crate::frame::{Beam, Frame};
use crate::joint::{CutBeam, Joints};

/// Writes the model.
///
/// # Errors
/// What `out` says; or a number in the frame is not finite.
pub fn write(
    name: &str,
    frame: &Frame,
    joints: &Joints,
    material: &Material,
    out: &mut dyn Write,
) -> io::Result<()> {
    document(name, frame, joints, material, out).map_err(|fault| match fault {
        Fault::Io(error) => error,
        Fault::NotFinite => io::Error::other("a number of the frame is not finite"),
    })
}

fn document(
    name: &str,
    frame: &Frame,
    joints: &Joints,
    material: &Material,
    out: &mut dyn Write,
) -> Result<(), Fault> {
    let mut part = Part21::new(out);
    part.raw(&format!(
        "ISO-10303-21;\nHEADER;\n\
         FILE_DESCRIPTION(('ViewDefinition [ReferenceView_V1.2]'),'2;1');\n\
         FILE_NAME({},'1970-01-01T00:00:00',(''),(''),'beamwright {}','beamwright','');\n\
         FILE_SCHEMA(('IFC4'));\nENDSEC;\nDATA;\n",
        Text(name),
        env!("CARGO_PKG_VERSION"),
    ))?;
    let mut model = Model::new(part, name, material)?;
    let mut members = Vec::with_capacity(frame.beams.len());
    for (i, (beam, cut)) in frame.beams.iter().zip(&joints.beams).enumerate() {
        members.push(model.member(i, frame, beam, cut)?);
    }
    model.contain(&members)?;
    model.part.raw("ENDSEC;\nEND-ISO-10303-21;\n")?;
    model.part.finish()
}

/// What all members share.
struct Model<'a> {
    part: Part21<'a>,
    name: &'a str,
    material: &'a Material,
    project: Project,
    material_id: Id,
    /// Profiles written so far, by name, with their material sets.
    profiles: Vec<(String, [Id; 2])>,
}

impl<'a> Model<'a> {
    fn new(mut part: Part21<'a>, name: &'a str, material: &'a Material) -> Result<Self, Fault> {
        let project = Project::write(&mut part, name)?;
        let material_id = part.entity(format_args!("IFCMATERIAL({},$,$)", Text(&material.name)))?;
        Ok(Self { part, name, material, project, material_id, profiles: Vec::new() })
    }

    fn member(
        &mut self,
        index: usize,
        frame: &Frame,
        beam: &Beam,
        cut: &CutBeam,
    ) -> Result<Id, Fault> {
        let mark = mark(index);
        let [profile, material] = self.profile(beam)?;
        let [start, _] = frame.axis(beam);
        let axes = beam.axes.rolled(beam.shape.roll);
        let start = start + axes.x.into_inner() * cut.ends[0].setback;
        let at = self.axes(&start, &axes.x, &axes.y)?;
        let storey = self.project.storey_placement;
        let placement = self.part.entity(format_args!("IFCLOCALPLACEMENT({storey},{at})"))?;
        let shape = self.shape(profile, cut.axis_length)?;
        let guid = Guid::of(&[self.name, &mark]);
        let (name, kind) = (Text(&mark), beam.shape.name());
        let member = self.part.entity(format_args!(
            "IFCMEMBER({guid},$,{name},$,{},{placement},{shape},{name},.MEMBER.)",
            Text(&kind)
        ))?;
        self.part.entity(format_args!(
            "IFCRELASSOCIATESMATERIAL({},$,$,$,({member}),{material})",
            Guid::of(&[self.name, &mark, "material"])
        ))?;
        self.quantities(&mark, member, beam, cut)?;
        self.properties(&mark, member, beam)?;
        Ok(member)
    }

    /// The profile and the use of its material set, each profile once.
    fn profile(&mut self, beam: &Beam) -> Result<[Id; 2], Fault> {
        let name = beam.shape.profile.to_string();
        if let Some((_, ids)) = self.profiles.iter().find(|p| p.0 == name) {
            return Ok(*ids);
        }
        let profile = profile::write(&mut self.part, &beam.shape.profile, &name)?;
        let text = Text(&name);
        let layer = self.part.entity(format_args!(
            "IFCMATERIALPROFILE({text},$,{},{profile},$,$)",
            self.material_id
        ))?;
        let set = self.part.entity(format_args!("IFCMATERIALPROFILESET({text},$,({layer}),$)"))?;
        // 10: the axis runs through the centroid.
        let usage = self.part.entity(format_args!("IFCMATERIALPROFILESETUSAGE({set},10,$)"))?;
        self.profiles.push((name, [profile, usage]));
        Ok([profile, usage])
    }

    /// Axis and extruded body, in the coordinates of the member: z along the beam, x along y of the
    /// profile.
    fn shape(&mut self, profile: Id, length: f64) -> Result<Id, Fault> {
        let part = &mut self.part;
        let [axis, body] = self.project.contexts;
        let length = Real(length);
        let a = part.entity(format_args!("IFCCARTESIANPOINT((0.,0.,0.))"))?;
        let b = part.entity(format_args!("IFCCARTESIANPOINT((0.,0.,{length}))"))?;
        let line = part.entity(format_args!("IFCPOLYLINE(({a},{b}))"))?;
        let up = part.entity(format_args!("IFCDIRECTION((0.,0.,1.))"))?;
        let solid = part.entity(format_args!(
            "IFCEXTRUDEDAREASOLID({profile},{},{up},{length})",
            self.project.origin
        ))?;
        let line =
            part.entity(format_args!("IFCSHAPEREPRESENTATION({axis},'Axis','Curve3D',({line}))"))?;
        let solid = part
            .entity(format_args!("IFCSHAPEREPRESENTATION({body},'Body','SweptSolid',({solid}))"))?;
        part.entity(format_args!("IFCPRODUCTDEFINITIONSHAPE($,$,({line},{solid}))"))
    }

    fn axes(
        &mut self,
        at: &Point3<f64>,
        z: &Unit<Vector3<f64>>,
        x: &Unit<Vector3<f64>>,
    ) -> Result<Id, Fault> {
        let triple = |v: &Vector3<f64>| List([Real(v.x), Real(v.y), Real(v.z)]);
        let at = self.part.entity(format_args!("IFCCARTESIANPOINT({})", triple(&at.coords)))?;
        let z = self.part.entity(format_args!("IFCDIRECTION({})", triple(z)))?;
        let x = self.part.entity(format_args!("IFCDIRECTION({})", triple(x)))?;
        self.part.entity(format_args!("IFCAXIS2PLACEMENT3D({at},{z},{x})"))
    }

    fn quantities(
        &mut self,
        mark: &str,
        member: Id,
        beam: &Beam,
        cut: &CutBeam,
    ) -> Result<(), Fault> {
        let area = beam.shape.properties.area;
        let volume = area * cut.axis_length;
        let mass = volume * self.material.density * 1e-9;
        let part = &mut self.part;
        let length = Real(cut.length);
        let of = [
            part.entity(format_args!("IFCQUANTITYLENGTH('Length',$,$,{length},$)"))?,
            part.entity(format_args!("IFCQUANTITYAREA('CrossSectionArea',$,$,{},$)", Real(area)))?,
            part.entity(format_args!("IFCQUANTITYVOLUME('NetVolume',$,$,{},$)", Real(volume)))?,
            part.entity(format_args!("IFCQUANTITYWEIGHT('NetWeight',$,$,{},$)", Real(mass)))?,
        ];
        let set = part.entity(format_args!(
            "IFCELEMENTQUANTITY({},$,'Qto_MemberBaseQuantities',$,$,{})",
            Guid::of(&[self.name, mark, "quantities"]),
            List(of)
        ))?;
        self.define(mark, "defines-quantities", member, set)
    }

    fn properties(&mut self, mark: &str, member: Id, beam: &Beam) -> Result<(), Fault> {
        let part = &mut self.part;
        let standard = beam.shape.profile.designation.as_ref().map_or("", |d| &d.standard);
        let single = |part: &mut Part21<'_>, name: &str, value: &str| {
            let (name, value) = (Text(name), Text(value));
            part.entity(format_args!("IFCPROPERTYSINGLEVALUE({name},$,IFCLABEL({value}),$)"))
        };
        let of = [
            single(part, "Profile", &beam.shape.name())?,
            single(part, "Standard", standard)?,
            single(part, "Branch", &beam.branch.to_string())?,
        ];
        let set = part.entity(format_args!(
            "IFCPROPERTYSET({},$,'Beamwright',$,{})",
            Guid::of(&[self.name, mark, "properties"]),
            List(of)
        ))?;
        self.define(mark, "defines-properties", member, set)
    }

    fn define(&mut self, mark: &str, what: &str, member: Id, set: Id) -> Result<(), Fault> {
        let guid = Guid::of(&[self.name, mark, what]);
        self.part
            .entity(format_args!("IFCRELDEFINESBYPROPERTIES({guid},$,$,$,({member}),{set})"))
            .map(|_| ())
    }

    fn contain(&mut self, members: &[Id]) -> Result<(), Fault> {
        if members.is_empty() {
            return Ok(());
        }
        let guid = Guid::of(&[self.name, "storey-members"]);
        let (members, storey) = (List(members), self.project.storey);
        self.part
            .entity(format_args!(
                "IFCRELCONTAINEDINSPATIALSTRUCTURE({guid},$,$,$,{members},{storey})"
            ))
            .map(|_| ())
    }
}
