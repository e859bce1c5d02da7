# SPDX-License-Identifier: MIT OR Apache-2.0
"""The skeleton of a run, read without FreeCAD, and the colours of its centeredness.

Lengths are in mm.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import Sequence, Tuple

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
