# SPDX-License-Identifier: MIT OR Apache-2.0
"""The skeleton of a run, read without FreeCAD, and the colours of its centeredness.

Lengths are in mm.
"""

from __future__ import annotations

import json
import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Sequence, Tuple

Point = Tuple[float, float, float]
Colour = Tuple[float, float, float]


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


def read_skeleton(path: str, sections: str = "") -> Skeleton:
    """Reads the skeleton of a run, and how well it is centred from the run's sections.

    * ``sections``: file with the section at each point; "" or missing: off-centre is not known

    Raises ``ValueError`` if a file is something else.
    """
    root = _read(path, "beamwright-skeleton")
    centroids = _centroids(sections)
    number: dict[int, int] = {}
    points: list[SkeletalPoint] = []
    for entry in root["points"]:
        number[int(entry["id"])] = len(points)
        position = _point(entry["position"])
        radius = float(entry.get("radius", 0.0))
        centroid = centroids.get(int(entry["id"]))
        off_centre = None
        if centroid is not None and radius > 0.0:
            off_centre = math.dist(position, centroid) / radius
        kind = str(entry.get("kind", "branch"))
        points.append(SkeletalPoint(position, kind, radius, off_centre))
    branches = [[number[int(i)] for i in entry["points"]] for entry in root["branches"]]
    return Skeleton(points, branches)


def _read(path: str, format_name: str) -> dict[str, Any]:
    with open(path, encoding="utf-8") as file:
        root = json.load(file)
    if not isinstance(root, dict) or root.get("format") != format_name:
        raise ValueError(f"{path} is no {format_name}")
    return root


def _centroids(path: str) -> dict[int, Point]:
    """Centroid of the section at each skeletal point that has one."""
    if not path or not Path(path).is_file():
        return {}
    sections = _read(path, "beamwright-sections")["sections"]
    return {int(s["point"]): _point(s["centroid"]) for s in sections}


def _point(numbers: Sequence[float]) -> Point:
    x, y, z = numbers
    return (float(x), float(y), float(z))


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
