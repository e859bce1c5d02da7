# SPDX-License-Identifier: MIT OR Apache-2.0
"""The volume of overlapping closed meshes, without FreeCAD; lengths are in mm."""

from __future__ import annotations

import math
from collections import defaultdict
from typing import Sequence

from beamwright_mesh import Point, Triangles


def union_volume(meshes: Sequence[Triangles], rays: int = 128) -> float:
    """Volume inside any of some closed meshes, mm³, measured along ``rays`` × ``rays`` rays.

    The rays run along x.  A ray is inside where it has entered more meshes than it has left, so
    what several meshes share counts once.
    """
    points = [p for m in meshes for p in m.points]
    if not points:
        return 0.0
    low = [min(p[k] for p in points) for k in (1, 2)]
    size = [(max(p[k] for p in points) - lo) / rays for k, lo in zip((1, 2), low)]
    if min(size) <= 0.0:
        return 0.0
    crossings: dict[tuple[int, int], list[tuple[float, int]]] = defaultdict(list)
    for mesh in meshes:
        for facet in mesh.facets:
            _cross_rays([mesh.points[i] for i in facet], low, size, crossings)
    return sum(_inside(c) for c in crossings.values()) * size[0] * size[1]


#: Where in its cell a ray runs: off the middle, so that it meets no edge of a regular mesh.
_OFF_MIDDLE = (0.5 + 0.0317, 0.5 - 0.0719)


def _cross_rays(
    corners: Sequence[Point],
    low: Sequence[float],
    size: Sequence[float],
    crossings: dict[tuple[int, int], list[tuple[float, int]]],
) -> None:
    """Notes where the rays that meet a triangle meet it, and whether they enter or leave."""
    # In units of cells, so that a ray stands at a whole number.
    (ay, az), (by, bz), (cy, cz) = (
        [(p[k + 1] - low[k]) / size[k] - _OFF_MIDDLE[k] for k in (0, 1)] for p in corners
    )
    area = (by - ay) * (cz - az) - (bz - az) * (cy - ay)
    if area == 0.0:
        return
    for i in range(math.ceil(min(ay, by, cy)), math.floor(max(ay, by, cy)) + 1):
        for j in range(math.ceil(min(az, bz, cz)), math.floor(max(az, bz, cz)) + 1):
            u = ((by - i) * (cz - j) - (bz - j) * (cy - i)) / area
            v = ((cy - i) * (az - j) - (cz - j) * (ay - i)) / area
            w = 1.0 - u - v
            if u >= 0.0 and v >= 0.0 and w >= 0.0:
                x = u * corners[0][0] + v * corners[1][0] + w * corners[2][0]
                # A ray along x enters where the normal looks back along it.
                crossings[(i, j)].append((x, 1 if area < 0.0 else -1))


def _inside(crossings: list[tuple[float, int]]) -> float:
    """Length of a ray inside, from where it enters and leaves."""
    length, depth, entered = 0.0, 0, 0.0
    for x, step in sorted(crossings, key=lambda c: (c[0], -c[1])):
        if depth == 0 and step > 0:
            entered = x
        depth += step
        if depth == 0 and step < 0:
            length += x - entered
    return length
