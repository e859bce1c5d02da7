"""Skeleton, cut list and STEP names as the macro reads them."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from beamwright_cut_list import cell, read_cut_list, sheet_rows, split_profile, text_cell
from beamwright_report import ReportText, kept_files
from beamwright_skeleton import PLAIN, SCALE, colour_of, read_skeleton
from beamwright_step import arguments, decoded, mark_of, read_occurrences

CUT_LIST = """\
mark,profile,length_mm,area_mm2,mass_kg,branch
B001,CHS 60.3x4,120.5,707.5,0.669,1
B002,Freeform A54.41,5.382,54.407,0.002299,2

total,,125.882,,0.671,
"""

GROUPED = """\
piece,mark,quantity,profile,family,standard,material,length_mm,axis_length_mm,angle_1_deg,\
angle_2_deg,twist_deg,area_mm2,unit_mass_kg,mass_kg,unit_surface_m2,branch
P1,B001 B003,2,HEA 100 A,HEA,EN 10365,steel,500,490,0,45.5,180,2120,8.35,16.7,0.3,1 2
,,,,,,,,,,,,,,,,
total,,quantity,profile,,standard,,length_mm,,,,,,,,,
,,2,HEA 100 A,,EN 10365,,1000,,,,,,,16.7,0.6,
"""


def write(folder: Path, name: str, text: str) -> str:
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return str(path)


def test_a_cut_list_ends_at_its_first_empty_line(tmp_path: Path) -> None:
    rows = read_cut_list(write(tmp_path, "c.csv", CUT_LIST))
    assert [(r.marks, r.profile, r.length) for r in rows] == [
        (["B001"], "CHS 60.3x4", 120.5),
        (["B002"], "Freeform A54.41", 5.382),
    ]
    assert rows[0].angle_1 is None


def test_equal_pieces_may_share_a_line(tmp_path: Path) -> None:
    (row,) = read_cut_list(write(tmp_path, "c.csv", GROUPED))
    assert (row.marks, row.quantity, row.angle_2) == (["B001", "B003"], 2, 45.5)
    assert (row.family, row.size, row.twist) == ("HEA", "100 A", 180.0)
    assert (row.length, row.mass, row.standard) == (500.0, 8.35, "EN 10365")


def test_a_cut_list_without_its_columns_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="has no column mark, profile, length"):
        read_cut_list(write(tmp_path, "c.csv", "nonsense\n"))
    with pytest.raises(ValueError, match="is empty"):
        read_cut_list(write(tmp_path, "c.csv", ""))


def test_cells_are_text_or_numbers_with_units_and_never_formulas(tmp_path: Path) -> None:
    rows = read_cut_list(write(tmp_path, "c.csv", CUT_LIST))
    first = sheet_rows(rows, "=1+1", {"B001": "B001 CHS 60.3x4"})[0]
    assert first[:6] == ["'=1+1", "'B001 CHS 60.3x4", "'CHS", "'60.3x4", "", "120.500 mm"]
    assert text_cell("") == ""


def test_profiles_split_into_family_and_size() -> None:
    assert split_profile("HEA 120 M") == ("HEA", "120 M")
    assert split_profile("IPE200") == ("IPE", "200")
    assert split_profile("Other") == ("Other", "")


def test_cells_are_counted_with_letters() -> None:
    assert [cell(0, 0), cell(9, 25), cell(0, 26), cell(0, 701)] == ["A1", "Z10", "AA1", "ZZ1"]


def skeleton(folder: Path) -> str:
    root = {
        "format": "beamwright-skeleton",
        "points": [
            {"id": 7, "position": [0, 0, 0], "kind": "interface", "radius": 2},
            {"id": 9, "position": [5, 0, 0], "kind": "junction", "radius": 2},
        ],
        "branches": [{"id": 0, "points": [7, 9]}],
    }
    return write(folder, "s.json", json.dumps(root))


def test_off_centre_is_counted_in_radii_from_the_centroid_of_the_section(tmp_path: Path) -> None:
    sections = {
        "format": "beamwright-sections",
        "sections": [{"point": 9, "centroid": [5, 0.5, 0]}],
    }
    path = write(tmp_path, "x.json", json.dumps(sections))
    read = read_skeleton(skeleton(tmp_path), path)
    assert [p.off_centre for p in read.points] == [None, 0.25]
    assert read.segment_colours() == [SCALE[1]]
    assert read.places("junction") == [(5.0, 0.0, 0.0)]


def test_a_skeleton_without_sections_has_one_plain_colour(tmp_path: Path) -> None:
    read = read_skeleton(skeleton(tmp_path), str(tmp_path / "missing.json"))
    assert not read.knows_centre
    assert read.segment_colours() == [PLAIN]


def test_another_file_is_no_skeleton(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="is no beamwright-skeleton"):
        read_skeleton(write(tmp_path, "s.json", "[]"))


def test_colours_run_from_centred_to_far_off() -> None:
    assert colour_of(0.0, 0.0) == SCALE[0]
    assert colour_of(9.0, None) == pytest.approx(SCALE[-1])


STEP = """\
#1=CARTESIAN_POINT('',(1.,2.,3.));
#2=DIRECTION('',(1.,0.,0.));
#3=DIRECTION('',(0.,1.,0.));
#4=AXIS2_PLACEMENT_3D('',#1,#2,#3);
#5=ITEM_DEFINED_TRANSFORMATION('','',#6,#4);
#7=(REPRESENTATION_RELATIONSHIP('','',#8,#9)REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION(#5)SHAPE_REPRESENTATION_RELATIONSHIP());
#10=PRODUCT_DEFINITION_SHAPE('','',#11);
#11=NEXT_ASSEMBLY_USAGE_OCCURRENCE('1','B001 Round 12.5 mm\\X2\\00B2\\X0\\, it''s','',#12,#13,$);
#12=PRODUCT_DEFINITION('design','',#14,#15);
#14=PRODUCT_DEFINITION_FORMATION('','',#16);
#16=PRODUCT('Beams','Beams','',(#17));
#18=CONTEXT_DEPENDENT_SHAPE_REPRESENTATION(#7,#10);
"""


def test_an_occurrence_has_its_name_its_assembly_and_its_place(tmp_path: Path) -> None:
    (found,) = read_occurrences(write(tmp_path, "a.step", STEP))
    assert found.name == "B001 Round 12.5 mm², it's"
    assert found.parent == "Beams"
    assert (found.origin, found.axis, found.x_axis) == ((1, 2, 3), (1, 0, 0), (0, 1, 0))
    assert mark_of(found.name) == "B001"


def test_arguments_are_split_outside_quotes_and_brackets_only() -> None:
    assert arguments("X('a,b',(1.,2.),$)") == ["'a,b'", "(1.,2.)", "$"]
    assert decoded("'\\X\\B2 \\\\'") == "² \\"


def test_the_report_tells_breaches_with_their_places() -> None:
    summary = {
        "input": "part.obj",
        "findings": [{"text": "outside", "breach": True, "place": [1, 2, 3]}],
    }
    text = str(ReportText.of(summary, "0.1.0", ["more"]))
    assert "BREACH: outside at (1.00, 2.00, 3.00) mm" in text
    assert text.endswith("more\n")


def test_files_of_a_run_are_found_whatever_its_name(tmp_path: Path) -> None:
    for name in ("a[1].step", "a[1].csv", "a1.step"):
        write(tmp_path, name, "")
    found = kept_files(str(tmp_path), "a[1]")
    assert [Path(p).name for p in found] == ["a[1].csv", "a[1].step"]
