# SPDX-License-Identifier: MIT OR Apache-2.0
"""What a run leaves behind, read without FreeCAD: skeleton, cut list, names in the STEP file.

Lengths are in mm, angles in degrees, masses in kg.
"""

from __future__ import annotations

import csv
import json
import re
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Iterable, Mapping, Sequence, Tuple

Point = Tuple[float, float, float]
Colour = Tuple[float, float, float]

# ---------------------------------------------------------------------------------------------
# skeleton
# ---------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class SkeletalPoint:
    """A point of the skeleton.

    * ``kind``: interface, branch, junction or end
    * ``radius``: mm
    * ``off_centre``: distance from the section's centroid in section radii; None: not known
    """

    position: Point
    kind: str = "branch"
    radius: float = 0.0
    off_centre: float | None = None


@dataclass(frozen=True)
class Skeleton:
    """Points, and branches as chains of point numbers."""

    points: Sequence[SkeletalPoint]
    branches: Sequence[Sequence[int]]

    @property
    def knows_centre(self) -> bool:
        """Whether any point says how far off-centre it is."""
        return any(p.off_centre is not None for p in self.points)

    def places(self, *kinds: str) -> list[Point]:
        """Positions of the points of some kinds."""
        return [p.position for p in self.points if p.kind in kinds]

    def segment_colours(self) -> list[Colour]:
        """A colour for each segment, branch after branch."""
        return [
            colour_of(self.points[a].off_centre, self.points[b].off_centre)
            for branch in self.branches
            for a, b in zip(branch, branch[1:])
        ]


def read_skeleton(path: str) -> Skeleton:
    """Reads ``beamwright-skeleton`` JSON.  Raises ``ValueError`` if it is something else."""
    with open(path, encoding="utf-8") as file:
        root = json.load(file)
    if not isinstance(root, dict) or root.get("format") != "beamwright-skeleton":
        raise ValueError(f"{path} is no beamwright skeleton")
    number: dict[int, int] = {}
    points: list[SkeletalPoint] = []
    for entry in root["points"]:
        number[int(entry["id"])] = len(points)
        x, y, z = (float(c) for c in entry["position"])
        off_centre = entry.get("off_centre")
        points.append(
            SkeletalPoint(
                (x, y, z),
                str(entry.get("kind", "branch")),
                float(entry.get("radius", 0.0)),
                None if off_centre is None else float(off_centre),
            )
        )
    branches = [[number[int(i)] for i in entry["points"]] for entry in root["branches"]]
    return Skeleton(points, branches)


#: Off-centre by this many section radii, and more, is shown in the last colour.
FAR_OFF = 0.5

#: From well centred to far off: blue, yellow, red; told apart by colour-blind eyes as well.
SCALE: Sequence[Colour] = ((0.00, 0.27, 0.70), (0.94, 0.89, 0.26), (0.80, 0.10, 0.10))

#: Of a skeleton that says nothing of its centre.
PLAIN: Colour = (0.00, 0.27, 0.70)


def colour_of(*off_centre: float | None) -> Colour:
    """The colour of a segment between points that are so far off-centre, in section radii."""
    known = [o for o in off_centre if o is not None]
    if not known:
        return PLAIN
    at = min(max(sum(known) / len(known) / FAR_OFF, 0.0), 1.0) * (len(SCALE) - 1)
    i = min(int(at), len(SCALE) - 2)
    t = at - i
    a, b = SCALE[i], SCALE[i + 1]
    return (a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2]))


# ---------------------------------------------------------------------------------------------
# cut list
# ---------------------------------------------------------------------------------------------

#: What a column of the program's CSV means.  Longer names are tried first.
_ALIASES: Mapping[str, Sequence[str]] = {
    "mark": ("mark", "marks", "name", "beam"),
    "profile": ("profile",),
    "standard": ("standard",),
    "material": ("material",),
    "length": ("cut_length", "length"),
    "angle_1": ("cut_angle_1", "cut_angle1", "angle_1", "angle1", "end_angle_1"),
    "angle_2": ("cut_angle_2", "cut_angle2", "angle_2", "angle2", "end_angle_2"),
    "twist": ("twist", "cut_twist", "relative_twist"),
    "quantity": ("quantity", "count", "pieces"),
    "mass": ("unit_mass", "mass"),
    "area": ("area",),
    "branch": ("branch",),
}


@dataclass(frozen=True)
class CutListRow:
    """One line of the cut list.

    * ``marks``: the beams it is about, as ``B001``
    * ``length`` in mm, ``angle_1`` and ``angle_2`` in degrees, ``mass`` of one piece in kg,
      ``area`` of the mean section in mm²
    """

    marks: Sequence[str]
    profile: str
    length: float
    mass: float
    area: float | None = None
    angle_1: float | None = None
    angle_2: float | None = None
    quantity: int = 1
    standard: str = ""
    material: str = ""
    branch: str = ""

    @property
    def family(self) -> str:
        """What comes before the size: ``CHS`` of ``CHS 60.3x4``."""
        return split_profile(self.profile)[0]

    @property
    def size(self) -> str:
        """The size alone: ``60.3x4`` of ``CHS 60.3x4``."""
        return split_profile(self.profile)[1]


def split_profile(profile: str) -> tuple[str, str]:
    """Family and size of a profile: ``("CHS", "60.3x4")``."""
    match = re.match(r"^(\D*?)\s*(\d.*)$", profile)
    return (match.group(1), match.group(2)) if match else (profile, "")


def read_cut_list(path: str) -> list[CutListRow]:
    """Reads the cut list of a run; totals, legend and other tables below it are passed over.

    Raises ``ValueError`` if a column that is needed is missing.
    """
    with open(path, encoding="utf-8-sig", newline="") as file:
        lines = list(csv.reader(line for line in file if not line.startswith("#")))
    if not lines:
        raise ValueError(f"the cut list {path} is empty")
    columns = _columns(lines[0])
    missing = [name for name in ("mark", "profile", "length") if name not in columns]
    if missing:
        raise ValueError(f"the cut list {path} has no column {', '.join(missing)}")
    rows = []
    for line in lines[1:]:
        if not any(cell.strip() for cell in line):
            break
        cells = {name: line[i].strip() for name, i in columns.items() if i < len(line)}
        marks = re.findall(r"[A-Z]+\d+", cells.get("mark", ""))
        length = _number(cells.get("length", ""))
        if marks and length is not None:
            rows.append(_row(marks, length, cells))
    return rows


def _row(marks: list[str], length: float, cells: Mapping[str, str]) -> CutListRow:
    def number(name: str, otherwise: float) -> float:
        value = _number(cells.get(name, ""))
        return otherwise if value is None else value

    return CutListRow(
        marks=marks,
        profile=cells.get("profile", ""),
        length=length,
        mass=number("mass", 0.0),
        area=_number(cells.get("area", "")),
        angle_1=_number(cells.get("angle_1", "")),
        angle_2=_number(cells.get("angle_2", "")),
        quantity=int(number("quantity", float(len(marks)))),
        standard=cells.get("standard", ""),
        material=cells.get("material", ""),
        branch=cells.get("branch", ""),
    )


def _columns(header: Sequence[str]) -> dict[str, int]:
    plain = [re.sub(r"_(mm2|mm|kg|deg|m2)$", "", h.strip().lower()) for h in header]
    found = {}
    for name, aliases in _ALIASES.items():
        for alias in aliases:
            if alias in plain:
                found[name] = plain.index(alias)
                break
    return found


def _number(text: str) -> float | None:
    try:
        return float(text)
    except ValueError:
        return None


#: Columns of the spreadsheet: first those of FrameForge's list, so that its users find their way.
SHEET_COLUMNS = (
    "Parent",
    "Name",
    "Family",
    "SizeName",
    "Material",
    "Length",
    "CutAngle1",
    "CutAngle2",
    "ApproxWeight",
    "Quantity",
    "Area",
    "Branch",
)

LEGEND = (
    "Length: of one piece along its axis, cuts included",
    "CutAngle1, CutAngle2: at the two ends; empty where the run gave none and cuts are square",
    "ApproxWeight: of one piece, with the density given to the run",
    "Area: of the mean section along the branch",
    "Branch: of the skeleton the piece came from, counted from 0",
)


def sheet_rows(
    rows: Iterable[CutListRow], parent: str, labels: Mapping[str, str]
) -> list[list[str]]:
    """Cells of the spreadsheet, ready for ``Sheet.set``: text in quotes, numbers with units.

    * ``labels``: of the document's objects by their marks
    """
    cells = []
    for row in rows:
        name = ", ".join(labels.get(mark, f"{mark} {row.profile}") for mark in row.marks)
        cells.append(
            [
                text_cell(parent),
                text_cell(name),
                text_cell(row.family),
                text_cell(row.size),
                text_cell(row.material),
                f"{row.length:.3f} mm",
                _with_unit(row.angle_1, 2, "deg"),
                _with_unit(row.angle_2, 2, "deg"),
                f"{row.mass:.6f} kg",
                str(row.quantity),
                _with_unit(row.area, 3, "mm^2"),
                text_cell(row.branch),
            ]
        )
    return cells


def _with_unit(value: float | None, digits: int, unit: str) -> str:
    return "" if value is None else f"{value:.{digits}f} {unit}"


def text_cell(text: str) -> str:
    """Cell content that a spreadsheet takes for text, never for a formula or a number."""
    return "'" + text if text else ""


def cell(row: int, column: int) -> str:
    """Address of a cell, both counted from 0: ``cell(0, 0)`` is ``A1``."""
    letters = ""
    column += 1
    while column:
        column, rest = divmod(column - 1, 26)
        letters = chr(ord("A") + rest) + letters
    return f"{letters}{row + 1}"


# ---------------------------------------------------------------------------------------------
# names in the STEP file
# ---------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Occurrence:
    """One placing of a product in an assembly.

    FreeCAD names an object after its *product*, ``Round 12.5 L=80``; the mark of the beam,
    ``B007 Round 12.5``, is the name of the *occurrence*, so it is looked up here.

    * ``parent``: name of the assembly it stands in
    * ``origin``: mm; ``axis`` and ``x_axis``: unit vectors, z and x of its coordinates
    """

    name: str
    parent: str
    origin: Point
    axis: Point
    x_axis: Point


def read_occurrences(path: str) -> list[Occurrence]:
    """All occurrences of a STEP file that holds one statement a line, in the order written."""
    statements: dict[str, str] = {}
    with open(path, encoding="ascii", errors="replace") as file:
        for line in file:
            if line.startswith("#"):
                key, _, rest = line.partition("=")
                statements[key.strip()] = rest.strip().rstrip(";")
    transformation_of = _transformations(statements)
    found = []
    for key, text in statements.items():
        if not text.startswith("NEXT_ASSEMBLY_USAGE_OCCURRENCE"):
            continue
        parts = arguments(text)
        parent = _product_name(statements, parts[3])
        place = statements.get(transformation_of.get(key, ""), "")
        origin, axis, x_axis = _placement(statements, place)
        found.append(Occurrence(decoded(parts[1]), parent, origin, axis, x_axis))
    return found


def _transformations(statements: Mapping[str, str]) -> dict[str, str]:
    """Key of the occurrence to key of the AXIS2_PLACEMENT_3D it is placed at."""
    placed = {}
    for text in statements.values():
        if not text.startswith("CONTEXT_DEPENDENT_SHAPE_REPRESENTATION"):
            continue
        relation, shape = arguments(text)
        occurrence = arguments(statements[shape])[2]
        with_transformation = re.search(
            r"REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION\((#\d+)\)", statements[relation]
        )
        if with_transformation:
            placed[occurrence] = arguments(statements[with_transformation.group(1)])[3]
    return placed


def _product_name(statements: Mapping[str, str], definition: str) -> str:
    formation = arguments(statements[definition])[2]
    product = arguments(statements[formation])[2]
    return decoded(arguments(statements[product])[0])


def _placement(statements: Mapping[str, str], text: str) -> tuple[Point, Point, Point]:
    if not text.startswith("AXIS2_PLACEMENT_3D"):
        return (0.0, 0.0, 0.0), (0.0, 0.0, 1.0), (1.0, 0.0, 0.0)
    _, origin, axis, x_axis = arguments(text)

    def triple(key: str, otherwise: Point) -> Point:
        if key not in statements:
            return otherwise
        x, y, z = (float(c) for c in arguments(statements[key])[1].strip("()").split(","))
        return (x, y, z)

    return (
        triple(origin, (0.0, 0.0, 0.0)),
        triple(axis, (0.0, 0.0, 1.0)),
        triple(x_axis, (1.0, 0.0, 0.0)),
    )


def arguments(text: str) -> list[str]:
    """The arguments of a STEP statement, split at the commas that are not nested or quoted."""
    inner = text[text.index("(") + 1 : text.rindex(")")]
    parts: list[str] = [""]
    depth, quoted = 0, False
    for c in inner:
        if c == "'":
            quoted = not quoted
        if not quoted:
            depth += {"(": 1, ")": -1}.get(c, 0)
            if c == "," and depth == 0:
                parts.append("")
                continue
        parts[-1] += c
    return [p.strip() for p in parts]


def decoded(text: str) -> str:
    r"""The text of a STEP string: quotes removed, ``\X2\00B2\X0\`` and ``\X\B2`` read."""
    text = text[1:-1] if text.startswith("'") else text
    text = text.replace("''", "'")
    text = re.sub(
        r"\\X2\\((?:[0-9A-F]{4})+)\\X0\\",
        lambda m: bytes.fromhex(m.group(1)).decode("utf-16-be", "replace"),
        text,
    )
    text = re.sub(
        r"\\X4\\((?:[0-9A-F]{8})+)\\X0\\",
        lambda m: bytes.fromhex(m.group(1)).decode("utf-32-be", "replace"),
        text,
    )
    text = re.sub(r"\\X\\([0-9A-F]{2})", lambda m: chr(int(m.group(1), 16)), text)
    return text.replace("\\\\", "\\")


_MARK = re.compile(r"^(B\d+)\b")


def mark_of(label: str) -> str:
    """The mark at the head of a label, ``B007`` of ``B007 Round 12.5``; "" if it has none."""
    match = _MARK.match(label)
    return match.group(1) if match else ""


# ---------------------------------------------------------------------------------------------
# the text beside the beams
# ---------------------------------------------------------------------------------------------


@dataclass
class ReportText:
    """Lines about a run, as shown in the document and in the log."""

    lines: list[str] = field(default_factory=list)

    @classmethod
    def of(cls, summary: Mapping[str, Any], version: str, extra: Sequence[str] = ()) -> ReportText:
        """The summary of a run in words."""
        frame, skeleton = summary.get("frame") or {}, summary.get("skeleton") or {}
        labels, mesh = summary.get("labels") or {}, summary.get("mesh") or {}
        lines = [f"beamwright {version}: {summary.get('input', '')}", ""]
        if mesh:
            lines.append(
                f"mesh: {mesh.get('triangles', 0)} triangles, genus {mesh.get('genus', 0)}, "
                f"{mesh.get('volume', 0.0):.0f} mm^3"
            )
        if labels.get("source"):
            lines.append(
                f"non-design: {labels.get('non_design_faces', 0)} faces in "
                f"{labels.get('sets', 0)} set(s) by {labels['source']}, "
                f"{len(labels.get('interfaces') or ())} interface section(s)"
            )
        else:
            lines.append("non-design: none; the whole mesh is design")
        if skeleton:
            lines.append(
                f"skeleton: {skeleton.get('branches', 0)} branches, "
                f"{skeleton.get('junctions', 0)} junctions, {skeleton.get('length', 0.0):.1f} mm; "
                f"cycles {skeleton.get('cycles', 0)} of {skeleton.get('expected_cycles', 0)}"
            )
        if frame:
            lines.append(
                f"frame: {frame.get('beams', 0)} beams, {frame.get('nodes', 0)} nodes, "
                f"{frame.get('length', 0.0):.1f} mm; {frame.get('volume', 0.0):.0f} mm^3 of "
                f"{frame.get('design_volume', 0.0):.0f} mm^3 design"
            )
        findings = summary.get("findings") or ()
        lines.append("")
        lines.append(f"{len(findings)} finding(s)" + (":" if findings else ""))
        for finding in findings:
            place = finding.get("place")
            where = " at ({:.2f}, {:.2f}, {:.2f}) mm".format(*place) if place else ""
            kind = "BREACH" if finding.get("breach") else "note"
            lines.append(f"{kind}: {finding.get('text', '')}{where}")
        if extra:
            lines += ["", *extra]
        return cls(lines)

    def __str__(self) -> str:
        return "\n".join(self.lines) + "\n"


def kept_files(folder: str, stem: str) -> list[str]:
    """Files of a run that are there, by their full paths."""
    return sorted(str(p) for p in Path(folder).glob(glob_escape(stem) + ".*"))


def glob_escape(text: str) -> str:
    """A text as itself in a pattern of ``Path.glob``."""
    return re.sub(r"([*?\[])", r"[\1]", text)
