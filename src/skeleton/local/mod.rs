//! The march in the local frame (thesis §5.2.2): the identifier box turns with the branch.
pub(crate) mod axis;
pub(crate) mod band;
pub(crate) mod claim;
pub(crate) mod draft;
pub(crate) mod junction;
pub(crate) mod march;
pub(crate) mod patch;
pub(crate) mod sample;
pub(crate) mod search;
pub(crate) mod seed;
pub(crate) mod simplify;

use nalgebra::Point3;

use self::draft::{Draft, HubKind};
use self::march::March;
use super::error::SkeletonError;
use super::graph::{Branch, PointKind, SkeletalPoint, Skeleton};
use super::params::SkeletonParams;
use crate::mesh::Surface;
use crate::observer::Observer;

/// Marches the skeleton of a surface in the local frame.
pub fn skeleton(
    surface: &Surface,
    params: &SkeletonParams,
    observer: &mut impl Observer,
) -> Result<Skeleton, SkeletonError> {
    let t0 = std::time::Instant::now();
    let mut march = March::new(surface, params);
    let found = search::find_tubes(&mut march, mean_radius(surface), observer)?;
    let t1 = std::time::Instant::now();
    let mut draft = Draft::new(&found, &surface.interfaces);
    eprintln!("tubes {} patches {} genus {:?} blobs {} idle {:?}", found.tubes.len(), found.patches.all.len(), found.patches.all.iter().map(|p| p.genus).sum::<usize>(), draft.blobs, draft.idle_interfaces);
    simplify::simplify(&mut draft, &surface.interfaces, &surface.tree);
    for (h, runs) in draft.incidences().iter().enumerate() {
        if !runs.is_empty() { eprintln!("hub {h} {:?} at {:.1?} runs {:?}", draft.hubs[h].kind, draft.hubs[h].position.coords.as_slice(), runs); }
    }
    for (i, r) in draft.runs.iter().enumerate() { eprintln!("run {i} {:?} n {} L {:.1} r {:.2}", r.hubs, r.stations.len(), r.length(), r.radius()); }
    let s = assemble(surface, params, &draft);
    eprintln!("find {:?} rest {:?}", t1 - t0, t1.elapsed());
    Ok(s)
}

/// Mean strut radius 2 V / A of the design part closed over its interface sections, mm.
pub fn mean_radius(surface: &Surface) -> f64 {
    let (mut volume, mut area) = (0.0, 0.0);
    let origin = surface.mesh.positions()[0];
    for f in surface.mesh.faces().filter(|f| surface.labels.is_design(*f)) {
        let [a, b, c] = surface.mesh.corners(f).map(|p| p - origin);
        volume += a.dot(&b.cross(&c)) / 6.0;
        area += surface.mesh.face_area(f);
    }
    for i in &surface.interfaces {
        // The cap looks out of the design part, against the section's normal.
        volume -= i.normal.dot(&(i.centroid - origin)) * i.area / 3.0;
    }
    2.0 * volume / area
}

fn assemble(surface: &Surface, params: &SkeletonParams, draft: &Draft) -> Skeleton {
    let rm = mean_radius(surface); let nb = neighbourhood(surface, rm); let _ = params;
    let mut skeleton = Skeleton::default();
    let mut of_hub = vec![u32::MAX; draft.hubs.len()];
    for (h, runs) in draft.incidences().iter().enumerate() {
        if runs.is_empty() {
            continue;
        }
        of_hub[h] = skeleton.points.len() as u32;
        let kind = match draft.hubs[h].kind {
            HubKind::Joint => PointKind::Junction,
            HubKind::Interface(_) => PointKind::Interface,
            HubKind::Tip => PointKind::End,
        };
        let radius = runs.iter().map(|&(r, _)| draft.runs[r].radius()).fold(0.0, f64::max);
        skeleton.points.push(SkeletalPoint { position: draft.hubs[h].position, radius, kind });
    }
    for run in &draft.runs {
        let ends: [Point3<f64>; 2] = run.hubs.map(|h| draft.hubs[h].position);
        let mut points = vec![of_hub[run.hubs[0]]];
        for sample in sample::samples(surface, run, ends, rm, nb) {
            points.push(skeleton.points.len() as u32);
            skeleton.points.push(SkeletalPoint {
                position: sample.position,
                radius: sample.radius,
                kind: PointKind::Branch,
            });
        }
        points.push(of_hub[run.hubs[1]]);
        skeleton.branches.push(Branch { points });
    }
    skeleton
}

fn neighbourhood(surface: &Surface, rm: f64) -> f64 {
    surface.interfaces.iter().flat_map(|i| i.half_edges.iter().map(|&h| (surface.mesh.position(surface.mesh.origin(h)) - i.centroid).norm())).fold(None, |m: Option<f64>, d| Some(m.map_or(d, |m| m.max(d)))).unwrap_or(2.0 * rm)
}
