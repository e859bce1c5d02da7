# SPDX-License-Identifier: MIT OR Apache-2.0
"""Names and places of the beams in a STEP assembly, read without FreeCAD.

FreeCAD names an object after its *product*; the mark of a beam is the name of its *occurrence*.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Mapping, Tuple

Point = Tuple[float, float, float]


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
