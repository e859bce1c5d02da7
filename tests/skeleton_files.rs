//! Skeleton files of other programs are read; ours are written and read again.

use std::path::Path;

use beamwright::skeleton::graph::{Branch, PointKind, SkeletalPoint, Skeleton};
use beamwright::skeleton_file::{Format, LineGraph, read, read_bytes, write};
use beamwright_formats::Unit;
use nalgebra::Point3;
use proptest::prelude::*;

fn fixture(name: &str) -> Skeleton {
    read(&Path::new("tests/data").join(name), Unit::Mm).unwrap()
}

fn length(skeleton: &Skeleton) -> f64 {
    skeleton.branches.iter().map(|b| skeleton.length(b)).sum()
}

#[test]
fn every_format_reads_the_same_t() {
    for name in [
        "starlab.cg",
        "polylines.obj",
        "method_2_nodes.txt",
        "meshlab.ply",
        "traced.swc",
        "ours.json",
    ] {
        let t = fixture(name);
        assert_eq!((t.points.len(), t.branches.len()), (5, 3), "{name}");
        assert_eq!(t.count(PointKind::Junction), 1, "{name}");
        assert!((length(&t) - 45.5).abs() < 1e-9, "{name}");
    }
}

#[test]
fn curve_graphs_that_count_from_0_are_understood() {
    let line = fixture("counted_from_0.cg");
    assert_eq!((line.points.len(), line.branches.len()), (3, 1));
}

#[test]
fn the_unit_scales_places_and_radii_and_json_tells_its_own() {
    let t = read(Path::new("tests/data/meshlab.ply"), Unit::Inch).unwrap();
    assert_eq!((t.points[1].position.x, t.points[2].radius), (254.0, 3.0 * 25.4));
    let t = read(Path::new("tests/data/ours.json"), Unit::M).unwrap();
    assert_eq!((t.points[1].position.x, t.points[2].radius), (10.0, 3.0));
}

#[test]
fn a_radius_that_is_none_is_unknown() {
    let t = fixture("meshlab.ply");
    assert_eq!(t.points.iter().map(|p| p.radius).collect::<Vec<_>>(), [2.5, 2.5, 3.0, 2.5, 0.0]);
}

#[test]
fn types_of_a_cell_are_no_kinds_of_skeletal_points() {
    assert_eq!(fixture("traced.swc").count(PointKind::Interface), 0);
    assert_eq!(fixture("ours.json").count(PointKind::Interface), 1);
}

#[test]
fn binary_edges_are_read_in_both_byte_orders() {
    for little in [true, false] {
        let name = if little { "little" } else { "big" };
        let mut ply = format!(
            "ply\nformat binary_{name}_endian 1.0\nelement vertex 2\nproperty float x\n\
             property float y\nproperty float z\nproperty double radius\nelement face 1\n\
             property list uchar int vertex_indices\nelement edge 1\nproperty uchar red\n\
             property uint vertex1\nproperty uint vertex2\nend_header\n"
        )
        .into_bytes();
        let float = |x: f32| if little { x.to_le_bytes() } else { x.to_be_bytes() };
        let double = |x: f64| if little { x.to_le_bytes() } else { x.to_be_bytes() };
        let int = |x: u32| if little { x.to_le_bytes() } else { x.to_be_bytes() };
        for x in [1.5f32, 4.5] {
            [x, 0.0, -1.0].iter().for_each(|&c| ply.extend(float(c)));
            ply.extend(double(0.75));
        }
        ply.push(3);
        [0, 1, 0].iter().for_each(|&i| ply.extend(int(i)));
        ply.push(255);
        [1, 0].iter().for_each(|&i| ply.extend(int(i)));
        let line = read_bytes(&ply, Format::Ply, Unit::Mm).unwrap();
        assert_eq!(line.points[1].position, Point3::new(4.5, 0.0, -1.0));
        assert_eq!(line.points[1].radius, 0.75);
        assert!((length(&line) - 3.0).abs() < 1e-12);
    }
}

#[test]
fn json_is_written_as_the_design_has_it() {
    let mut json = Vec::new();
    write(&fixture("ours.json"), Format::Json, &mut json).unwrap();
    let expected = r#"{ "format": "beamwright-skeleton", "version": 1, "unit": "mm",
  "points": [
    {"id":0,"position":[0.0,0.0,0.0],"kind":"interface","radius":2.5},
    {"id":1,"position":[10.0,0.0,0.0],"kind":"branch","radius":2.5},
    {"id":2,"position":[20.0,0.0,0.0],"kind":"junction","radius":3.0},
    {"id":3,"position":[30.0,0.0,0.0],"kind":"end","radius":2.5},
    {"id":4,"position":[20.0,15.5,0.0],"kind":"end","radius":2.5}
  ],
  "branches": [
    {"id":0,"points":[0,1,2],"length":20.0},
    {"id":1,"points":[2,3],"length":10.0},
    {"id":2,"points":[2,4],"length":15.5}
  ] }
"#;
    assert_eq!(String::from_utf8(json).unwrap(), expected);
}

#[test]
fn a_cycle_survives_swc() {
    let ring =
        read_bytes(b"v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2 3 1\n", Format::Obj, Unit::Mm).unwrap();
    let mut swc = Vec::new();
    write(&ring, Format::Swc, &mut swc).unwrap();
    let text = String::from_utf8(swc.clone()).unwrap();
    assert_eq!(text.lines().filter(|l| l.ends_with(" -1")).count(), 1, "{text}");
    assert_eq!(read_bytes(&swc, Format::Swc, Unit::Mm).unwrap().cycle_rank(), 1);
}

/// A connected skeleton of random points, some of them joined to more than one earlier one.
fn skeletons() -> impl Strategy<Value = Skeleton> {
    let point = (prop::array::uniform3(-1e3..1e3f64), 0.0..10.0f64, any::<bool>());
    let link = (any::<prop::sample::Index>(), any::<prop::sample::Index>());
    let points = prop::collection::vec(point, 2..20);
    (points, prop::collection::vec(link, 0..6)).prop_map(|(points, links)| {
        let count = points.len();
        let points = points.into_iter().map(|(place, radius, is_interface)| SkeletalPoint {
            position: Point3::from(place),
            radius,
            kind: if is_interface { PointKind::Interface } else { PointKind::Branch },
        });
        let chain = (1..count as u32).map(|p| [p - 1, p]);
        let extra = links.into_iter().map(|(a, b)| [a.index(count) as u32, b.index(count) as u32]);
        LineGraph::new(points.collect(), chain.chain(extra).collect()).to_skeleton()
    })
}

/// Segments as places of their ends, in an order of their own.
fn segments(skeleton: &Skeleton) -> Vec<[[u64; 3]; 2]> {
    let bits = |p: u32| <[f64; 3]>::from(skeleton.position(p).coords).map(f64::to_bits);
    let mut all: Vec<_> = skeleton
        .segments()
        .map(|s| {
            let mut ends = s.map(bits);
            ends.sort_unstable();
            ends
        })
        .collect();
    all.sort_unstable();
    all
}

proptest! {
    #[test]
    fn what_is_written_is_read_again(skeleton in skeletons()) {
        for format in Format::ALL {
            let mut bytes = Vec::new();
            write(&skeleton, format, &mut bytes).unwrap();
            let again = read_bytes(&bytes, format, Unit::Mm).unwrap();
            prop_assert_eq!(segments(&again), segments(&skeleton), "{:?}", format);
            prop_assert_eq!(again.cycle_rank(), skeleton.cycle_rank());
            let radii = |s: &Skeleton| {
                let mut radii: Vec<f64> = s.points.iter().map(|p| p.radius).collect();
                radii.sort_by(f64::total_cmp);
                radii
            };
            if matches!(format, Format::Json | Format::Ply | Format::Swc) {
                prop_assert_eq!(radii(&again), radii(&skeleton), "{:?}", format);
            }
            if matches!(format, Format::Json | Format::Swc) {
                let interfaces = PointKind::Interface;
                prop_assert_eq!(again.count(interfaces), skeleton.count(interfaces));
            }
            if format == Format::Json {
                prop_assert_eq!(&again, &skeleton);
            }
            let mut twice = Vec::new();
            write(&skeleton, format, &mut twice).unwrap();
            prop_assert_eq!(bytes, twice);
        }
    }
}

#[test]
fn a_branch_may_be_a_ring_with_one_junction() {
    let skeleton = Skeleton {
        branches: vec![Branch { points: vec![0, 1, 2, 0] }, Branch { points: vec![0, 3] }],
        ..read_bytes(b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 5\nl 1 2 3 4\n", Format::Obj, Unit::Mm)
            .unwrap()
    };
    for format in Format::ALL {
        let mut bytes = Vec::new();
        write(&skeleton, format, &mut bytes).unwrap();
        let again = read_bytes(&bytes, format, Unit::Mm).unwrap();
        assert_eq!((again.branches.len(), again.cycle_rank()), (2, 1), "{format:?}");
    }
}
