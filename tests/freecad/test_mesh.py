"""Triangles with labels: flat regions, faces near a surface, PLY, volume."""

from __future__ import annotations

import struct
from pathlib import Path

import pytest
from beamwright_mesh import (
    FlatRegions,
    Triangles,
    distance_to_triangle,
    file_stem,
    is_non_design_name,
    near_surface,
    write_ply,
)
from beamwright_volume import union_volume

#: Corners of the two triangles of each side of a cube whose corner i is at the bits of i.
CUBE = [
    (0, 2, 3), (0, 3, 1), (4, 5, 7), (4, 7, 6), (0, 1, 5), (0, 5, 4),
    (2, 6, 7), (2, 7, 3), (0, 4, 6), (0, 6, 2), (1, 3, 7), (1, 7, 5),
]  # fmt: skip


def box(x: float = 1.0, y: float = 1.0, z: float = 1.0, at: float = 0.0) -> Triangles:
    points = [(at + x * (i & 1), y * (i >> 1 & 1), z * (i >> 2 & 1)) for i in range(8)]
    return Triangles(list(points), list(CUBE))


def strip(length: int) -> Triangles:
    """A flat strip of squares in the plane z = 0, two triangles each."""
    points = [(float(i), float(j), 0.0) for i in range(length + 1) for j in (0, 1)]
    facets = [f for i in range(0, 2 * length, 2) for f in ((i, i + 2, i + 3), (i, i + 3, i + 1))]
    return Triangles(points, facets)


def test_a_cube_is_closed_and_without_a_facet_it_is_not() -> None:
    cube = box()
    assert cube.is_closed()
    cube.facets.pop()
    assert not cube.is_closed()
    assert not Triangles().is_closed()


def test_two_facets_turned_the_same_way_on_an_edge_are_not_closed() -> None:
    cube = box()
    a, b, c = cube.facets[0]
    cube.facets[0] = (a, c, b)
    assert not cube.is_closed()


def test_the_flat_region_of_a_cube_is_one_side() -> None:
    cube = box()
    regions = FlatRegions(cube)
    for facet in range(12):
        assert regions.around(facet) == {facet - facet % 2, facet - facet % 2 + 1}


def test_a_region_ends_where_what_is_marked_ends() -> None:
    mesh = strip(6)
    regions = FlatRegions(mesh)
    assert regions.around(0) == set(range(12))
    assert regions.around(0, {0, 1, 2, 3}) == {0, 1, 2, 3}


def test_the_facet_at_a_place_is_the_nearest_one() -> None:
    cube = box()
    facet = cube.facet_at((0.2, 0.7, 1.01))
    assert cube.normal(facet) == (0.0, 0.0, 1.0)
    assert Triangles().facet_at((0.0, 0.0, 0.0)) == -1


def test_facets_near_a_surface_are_those_with_all_corners_near() -> None:
    mesh = strip(6)
    found = near_surface(mesh, strip(2), 0.1)
    assert found == {0, 1, 2, 3}
    assert near_surface(mesh, Triangles(), 0.1) == set()


@pytest.mark.parametrize(
    ("place", "distance"),
    [
        ((0.2, 0.2, 3.0), 3.0),
        ((-1.0, 0.0, 0.0), 1.0),
        ((2.0, 0.0, 0.0), 1.0),
        ((0.0, 5.0, 0.0), 4.0),
        ((1.0, 1.0, 0.0), 0.5**0.5),
    ],
)
def test_distances_to_a_triangle(place: tuple[float, float, float], distance: float) -> None:
    corners = ((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0))
    assert distance_to_triangle(place, *corners) == pytest.approx(distance)


def test_what_two_boxes_share_counts_once() -> None:
    assert union_volume([box(2.0)]) == pytest.approx(2.0, rel=1e-9)
    assert union_volume([box(2.0), box(2.0, at=1.0)]) == pytest.approx(3.0, rel=1e-9)
    assert union_volume([]) == 0.0


def test_a_labelled_ply_has_a_label_a_face(tmp_path: Path) -> None:
    cube = box()
    cube.labels = [1] + [0] * 11
    path = tmp_path / "cube.ply"
    write_ply(str(path), cube)
    head, _, body = path.read_bytes().partition(b"end_header\n")
    assert b"property int non_design" in head
    assert len(body) == 8 * 24 + 12 * 17
    assert struct.unpack("<B4i", body[8 * 24 : 8 * 24 + 17]) == (3, 0, 2, 3, 1)


def test_labels_that_do_not_fit_are_refused(tmp_path: Path) -> None:
    cube = box()
    cube.labels = [1]
    with pytest.raises(ValueError, match="1 labels for 12 facets"):
        write_ply(str(tmp_path / "cube.ply"), cube)


@pytest.mark.parametrize("name", ["non_design", "Non-Design 2", "my nondesign part", "fixed_1"])
def test_names_that_say_non_design(name: str) -> None:
    assert is_non_design_name(name)


@pytest.mark.parametrize("name", ["design", "unfixed", "part", ""])
def test_names_that_do_not(name: str) -> None:
    assert not is_non_design_name(name)


def test_any_label_makes_a_file_name() -> None:
    assert file_stem("part/..\\1") == "part_.._1"
    assert file_stem("Träger 7") == "Träger_7"
    assert file_stem("///") == "mesh"
