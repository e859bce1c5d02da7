# SPDX-License-Identifier: MIT OR Apache-2.0
"""The cut list of a run, and the same as cells of a FreeCAD spreadsheet; without FreeCAD.

Lengths are in mm, angles in degrees, masses in kg.
"""

from __future__ import annotations

import csv
import re
from dataclasses import dataclass
from typing import Any, Iterable, Mapping, Sequence

from beamwright_step import mark_of

#: What a column of the program's CSV means.  Longer names are tried first.
_ALIASES: Mapping[str, Sequence[str]] = {
    "mark": ("mark", "marks", "name", "beam"),
    "profile": ("profile",),
    "family": ("family",),
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
    * ``length`` in mm, ``mass`` of one piece in kg, ``area`` of the profile in mm²
    * ``angle_1`` and ``angle_2`` of the cuts at the ends, ``twist`` between them, in degrees
    * ``family``: ``CHS`` of ``CHS 60.3x4``
    """

    marks: Sequence[str]
    profile: str
    length: float
    mass: float
    area: float | None = None
    angle_1: float | None = None
    angle_2: float | None = None
    twist: float | None = None
    quantity: int = 1
    standard: str = ""
    material: str = ""
    branch: str = ""
    family: str = ""

    @property
    def size(self) -> str:
        """The size alone: ``60.3x4`` of ``CHS 60.3x4``."""
        return self.profile[len(self.family) :].strip()


def split_profile(profile: str) -> tuple[str, str]:
    """Family and size of a profile: ``("CHS", "60.3x4")``."""
    if " " in profile:
        family, _, size = profile.partition(" ")
        return family, size
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

    profile = cells.get("profile", "")
    family = cells.get("family", "")
    if not family or not profile.startswith(family):
        family = split_profile(profile)[0]
    return CutListRow(
        marks=marks,
        profile=profile,
        family=family,
        length=length,
        mass=number("mass", 0.0),
        area=_number(cells.get("area", "")),
        angle_1=_number(cells.get("angle_1", "")),
        angle_2=_number(cells.get("angle_2", "")),
        twist=_number(cells.get("twist", "")),
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
    "CutTwist",
    "Standard",
    "Area",
    "Branch",
)

#: Of the columns, pixels.
WIDTHS = (110, 190, 80, 100, 90, 85, 85, 85, 105, 75, 85, 100, 95, 60)

LEGEND = (
    "Length: of one piece, to saw off a bar: from the farthest corner to the farthest",
    "CutAngle1, CutAngle2: of the cuts at the two ends; 0 is square",
    "CutTwist: turn between the cuts about the axis; 0 a parallelogram, 180 a trapezium",
    "ApproxWeight: of one piece, with the density given to the run",
    "Area: of the profile",
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
                _with_unit(row.twist, 2, "deg"),
                text_cell(row.standard),
                _with_unit(row.area, 2, "mm^2"),
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


def fill_sheet(sheet: Any, rows: Iterable[CutListRow], parent: str, beams: Sequence[Any]) -> None:
    """The cut list with a head, a line of totals and a legend."""
    labels = {mark_of(b.Label): b.Label for b in beams}
    rows = list(rows)
    cells = sheet_rows(rows, parent, labels)
    for column, name in enumerate(SHEET_COLUMNS):
        sheet.set(cell(0, column), text_cell(name))
    for i, line in enumerate(cells):
        for column, content in enumerate(line):
            if content:
                sheet.set(cell(i + 1, column), content)
    last = len(cells) + 1
    names = ("Length", "Quantity", "ApproxWeight")
    length, quantity, weight = (SHEET_COLUMNS.index(n) for n in names)
    sheet.set(cell(last, 1), "'Total")
    sheet.set(cell(last, length), f"{sum(r.length * r.quantity for r in rows):.3f} mm")
    sheet.set(cell(last, quantity), str(sum(r.quantity for r in rows)))
    sheet.set(cell(last, weight), f"{sum(r.mass * r.quantity for r in rows):.6f} kg")
    for i, text in enumerate(LEGEND):
        sheet.set(cell(last + 2 + i, 1), text_cell(text))
        sheet.mergeCells(f"{cell(last + 2 + i, 1)}:{cell(last + 2 + i, len(SHEET_COLUMNS) - 1)}")
    end = cell(0, len(SHEET_COLUMNS) - 1)
    sheet.setStyle(f"A1:{end}", "bold")
    sheet.setStyle(f"A{last + 1}:{cell(last, len(SHEET_COLUMNS) - 1)}", "bold")
    for column, width in enumerate(WIDTHS):
        sheet.setColumnWidth(cell(0, column)[:-1], width)
