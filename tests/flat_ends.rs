//! Parts of which only faces are non-design, without any thickness, and parts that are no beams.

mod common;

use beamwright::skeleton::{self, Orientation, SkeletonError, SkeletonParams};
use common::families::{cube, cylinder_between_pads, quarter_bend};

#[test]
fn a_bar_with_labelled_end_faces_has_a_straight_skeleton_from_face_to_face() {
    for along in [1, 20] {
        let surface = cylinder_between_pads(3.0, 40.0, 24, along).surface();
        for orientation in [Orientation::Local, Orientation::Global] {
            if along == 1 && orientation == Orientation::Global {
                continue; // No nodes along the shaft: the box of the thesis finds nothing there.
            }
            let params = SkeletonParams { orientation, ..SkeletonParams::default() };
            let marched = skeleton::march(&surface, &params, &mut ()).expect("a bar");
            assert!(marched.findings.iter().all(|f| !f.breach), "{:?}", marched.findings);
            let [branch] = marched.skeleton.branches.as_slice() else { panic!("one branch") };
            let length = marched.skeleton.length(branch);
            assert!((length - 40.0).abs() < 0.01, "{along} {orientation:?}: {length}");
        }
    }
}

#[test]
fn a_bend_with_labelled_end_faces_is_followed_inside() {
    let surface = quarter_bend(30.0, 4.0).surface();
    let marched = skeleton::march(&surface, &SkeletonParams::default(), &mut ()).expect("a bend");
    assert!(marched.findings.iter().all(|f| !f.breach), "{:?}", marched.findings);
    let [branch] = marched.skeleton.branches.as_slice() else { panic!("one branch") };
    let arc = 30.0 * std::f64::consts::FRAC_PI_2;
    assert!((marched.skeleton.length(branch) / arc - 1.0).abs() < 0.02);
}

#[test]
fn a_plain_cube_is_not_beam_like() {
    let marched = skeleton::march(&cube().surface(), &SkeletonParams::default(), &mut ());
    assert!(matches!(marched, Err(SkeletonError::NotBeamLike { .. })));
}
