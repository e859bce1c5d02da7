//! Gives every beam its profile (thesis §5.2.3: a standard beam for each branch that matches the
//! mean of its sections).
//!
//! 1. Beams whose sections and lengths agree are one group: a symmetric part gets equal beams.
//! 2. Each group is matched to a profile of the wanted kind.
//! 3. With `max_profiles`, the profiles are reduced over the whole frame at least cost.
//! 4. Tapered lofts get the same family at stations along the beam (`lofts`).

use super::params::ProfileParams;
use super::shape::{BeamShape, Loft};
use super::{Beam, Frame, lofts};
use crate::cluster;
use crate::finding::{Finding, FindingKind};
use crate::observer::Observer;
use crate::section::Profile;
use crate::section::catalogue::Catalogue;
use crate::section::matching::{
    Equalized, FewProfiles, MEANT_EQUAL, MatchError, MatchTarget, Matched, ProfileChoice,
    Requirement, equalize, match_profile,
};

/// Worst error of I₁ or I₂ that goes without a finding.
const POOR_MATCH: f64 = 0.25;

/// Matches every beam of a frame to a profile.
///
/// # Errors
/// A family that is not in the catalogue, or no profile that is strong enough.
pub fn match_profiles(
    frame: &mut Frame,
    params: &ProfileParams,
    catalogue: &Catalogue,
) -> Result<Vec<Finding>, MatchError> {
    match_profiles_watched(frame, params, catalogue, &mut ())
}

/// The same, unless the observer asks to stop.
pub(crate) fn match_profiles_watched(
    frame: &mut Frame,
    params: &ProfileParams,
    catalogue: &Catalogue,
    observer: &mut impl Observer,
) -> Result<Vec<Finding>, MatchError> {
    let groups = groups(frame);
    let mut matched = Vec::with_capacity(groups.targets.len());
    for target in &groups.targets {
        keep_on(observer)?;
        matched.push(match_profile(target, &params.choice, params.mode, catalogue)?);
    }
    shape_beams(frame, &groups, matched, params, catalogue, observer)
}

/// An error as soon as the observer asks to stop.
fn keep_on(observer: &mut impl Observer) -> Result<(), MatchError> {
    if observer.keep_on().is_break() { Err(MatchError::Cancelled) } else { Ok(()) }
}

/// The measured beams, as good as equal ones together.
fn groups(frame: &Frame) -> Equalized {
    let measured = frame.beams.iter().filter_map(|b| Some((b.measured.clone()?, b.length)));
    equalize(&measured.collect::<Vec<_>>(), MEANT_EQUAL)
}

/// Gives every beam the shape that its group was matched to.
fn shape_beams(
    frame: &mut Frame,
    groups: &Equalized,
    mut matched: Vec<Matched>,
    params: &ProfileParams,
    catalogue: &Catalogue,
    observer: &mut impl Observer,
) -> Result<Vec<Finding>, MatchError> {
    let targets: Vec<Option<MatchTarget>> =
        frame.beams.iter().map(|b| b.measured.clone()).collect();
    let measured: Vec<usize> = (0..targets.len()).filter(|&i| targets[i].is_some()).collect();
    if let Some(max) = params.max_profiles {
        reduce(&mut matched, groups, max, params, catalogue, observer)?;
    }
    let mut members: Vec<Vec<usize>> = vec![Vec::new(); matched.len()];
    for (k, &i) in measured.iter().enumerate() {
        keep_on(observer)?;
        let group = groups.group_of[k];
        members[group].push(i);
        let beam = &mut frame.beams[i];
        if let Some(own) = &targets[i] {
            beam.shape = BeamShape::constant(matched[group].turned_onto(own)?);
        }
    }
    members.iter().for_each(|group| equalize_lengths(frame, group));
    if params.loft != Loft::Constant {
        for group in &members {
            lofts::shape(frame, group, params, catalogue, || keep_on(observer))?;
        }
    }
    for i in (0..targets.len()).filter(|&i| targets[i].is_none()) {
        frame.beams[i].shape = unmeasured(frame, i, params, catalogue);
    }
    let mut findings = poor_matches(frame);
    if params.choice == ProfileChoice::Freeform {
        findings.extend(no_outlines(frame));
    }
    Ok(findings)
}

/// Lengths of equal beams differ by less than this part of the radius, all together.
const SAME_LENGTH: f64 = 0.2;

/// Lengths that are meant to be equal follow each other by less than this part of the radius;
/// where the lengths of a group leave a gap this wide, it holds two kinds of beams. A truss meshed
/// with six triangles to a radius leaves gaps of 0.07 between equal members.
const NEXT_LENGTH: f64 = 0.1;

/// Gives the beams of a group, which have one profile, one length where they are meant to.
fn equalize_lengths(frame: &mut Frame, group: &[usize]) {
    let radius = |i: usize| frame.beams[i].section.mean.radius();
    let distance = |a: usize, b: usize| {
        let [a, b] = [group[a], group[b]];
        let difference = (frame.beams[a].length - frame.beams[b].length).abs();
        Some(difference / radius(a).min(radius(b)))
    };
    for equal in cluster::groups(group.len(), distance, SAME_LENGTH, NEXT_LENGTH) {
        let lengths = equal.iter().map(|&k| frame.beams[group[k]].length);
        let mean = lengths.sum::<f64>() / equal.len() as f64;
        for k in equal {
            frame.beams[group[k]].cut_length = mean;
        }
    }
}

/// Matches the groups anew to at most `max` profiles, unless there are no more already.
fn reduce(
    matched: &mut [Matched],
    groups: &Equalized,
    max: usize,
    params: &ProfileParams,
    catalogue: &Catalogue,
    observer: &mut impl Observer,
) -> Result<(), MatchError> {
    let mut distinct: Vec<Profile> = Vec::new();
    for m in matched.iter() {
        if !distinct.contains(&m.profile) {
            distinct.push(m.profile.clone());
        }
    }
    if distinct.len() <= max {
        return Ok(());
    }
    let mut requirements: Vec<Requirement> = groups
        .targets
        .iter()
        .zip(matched.iter())
        .map(|(target, own)| {
            Ok(Requirement { target: target.required(own, params.mode)?, length: 0.0 })
        })
        .collect::<Result<_, MatchError>>()?;
    for &group in &groups.group_of {
        requirements[group].length += groups.lengths[group];
    }
    let wanted = FewProfiles {
        requirements: &requirements,
        matched: &distinct,
        max,
        choice: &params.choice,
        mode: params.mode,
        catalogue,
    };
    let keep_on = &mut || keep_on(observer);
    let found = wanted.choose_watched(keep_on)?;
    for (i, m) in matched.iter_mut().enumerate() {
        keep_on()?;
        let profile = found.profiles[found.profile_of[i]].clone();
        *m = Matched::of(profile, &groups.targets[i])?;
    }
    Ok(())
}

/// The shape of a beam without sections of its own (a stub in a joint): that of the beam it goes on
/// as, else of the thinnest it meets; where none is measured, of a round bar of the assumed area.
fn unmeasured(
    frame: &Frame,
    index: usize,
    params: &ProfileParams,
    catalogue: &Catalogue,
) -> BeamShape {
    let own = &frame.beams[index];
    let meets = |b: &&Beam| b.ends.iter().any(|e| own.ends.contains(e)) && b.measured.is_some();
    let rank = |b: &Beam| (b.branch != own.branch, b.shape.properties.area);
    let neighbour = frame.beams.iter().filter(meets).min_by(|a, b| {
        let (a, b) = (rank(a), rank(b));
        a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))
    });
    if let Some(neighbour) = neighbour {
        let profile = neighbour.shape.profile.clone();
        let shape = BeamShape::assumed(profile, neighbour.shape.properties);
        let strong = neighbour.axes.rolled(neighbour.shape.roll).y;
        let across = own.axes.across(&strong);
        return BeamShape { roll: across.y.atan2(across.x), ..shape };
    }
    let bar = BeamShape::unmatched(own.assumed_area);
    let target = MatchTarget::of_properties(&bar.properties);
    match_profile(&target, &params.choice, params.mode, catalogue)
        .map(|m| BeamShape::assumed(m.profile, m.properties))
        .unwrap_or(bar)
}

/// Names the beams whose contour no smooth outline follows.
fn no_outlines(frame: &Frame) -> Vec<Finding> {
    let is_other = |b: &Beam| b.measured.is_some() && b.shape.profile.family() != "freeform";
    let beams = frame.beams.iter().enumerate().filter(|(_, b)| is_other(b));
    beams
        .map(|(i, beam)| {
            let [a, b] = frame.axis(beam);
            Finding::note(
                FindingKind::PoorMatch,
                Some(nalgebra::center(&a, &b)),
                format!(
                    "{}: no smooth outline follows its contour; it is {}",
                    super::mark(i),
                    beam.shape.name()
                ),
            )
        })
        .collect()
}

fn poor_matches(frame: &Frame) -> Vec<Finding> {
    let mut findings = Vec::new();
    for (i, beam) in frame.beams.iter().enumerate() {
        let Some(errors) = beam.shape.errors else { continue };
        let worst = errors.i_1.abs().max(errors.i_2.abs());
        if worst > POOR_MATCH {
            let [a, b] = frame.axis(beam);
            findings.push(Finding::note(
                FindingKind::PoorMatch,
                Some(nalgebra::center(&a, &b)),
                format!(
                    "{}: {} is off by {:+.0} % in I1 and {:+.0} % in I2",
                    super::mark(i),
                    beam.shape.name(),
                    100.0 * errors.i_1,
                    100.0 * errors.i_2
                ),
            ));
        }
    }
    findings
}
