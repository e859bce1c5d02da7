# SPDX-License-Identifier: MIT OR Apache-2.0
"""Triangles with labels, without FreeCAD: flat regions, faces near a surface, labelled PLY.

Lengths are in mm.  A facet is a triple of point numbers; a label is 1 for non-design, else 0.

    picked facet ──FlatRegions──► the flat region around it   (turns red in the view)
    CAD faces ────near_surface──► facets that lie on them     (references of FEM constraints)
    both ─────────write_ply─────► labelled PLY for the program
"""

from __future__ import annotations

import math
import struct
from collections import defaultdict
from dataclasses import dataclass, field
from typing import Callable, Iterable, Sequence, Tuple

Point = Tuple[float, float, float]
Facet = Tuple[int, int, int]

#: A facet belongs to a flat region if its corners are nearer to the plane than this part of
#: the mean edge.  Coordinates rounded to single precision are a thousand times nearer, the
#: bulge of a smoothed strut a few times farther.
FLATNESS = 0.05

#: ... and if its normal is turned by less than this, degrees.
FLAT_ANGLE = 10.0

#: A facet lies on a CAD face if its corners are nearer than this part of the mean edge.
TOUCH = 0.1


@dataclass
class Triangles:
    """A triangle mesh; ``labels`` has one entry a facet, or none at all."""

    points: list[Point] = field(default_factory=list)
    facets: list[Facet] = field(default_factory=list)
    labels: list[int] = field(default_factory=list)

    def append(self, other: Triangles, label: int) -> None:
        """Takes in another mesh, all of its facets with one label."""
        first = len(self.points)
        self.points.extend(other.points)
        self.facets.extend((a + first, b + first, c + first) for a, b, c in other.facets)
        self.labels.extend([label] * len(other.facets))

    def is_closed(self) -> bool:
        """Whether every edge has two facets, one on each side."""
        count: dict[tuple[int, int], int] = defaultdict(int)
        for a, b, c in self.facets:
            for u, v in ((a, b), (b, c), (c, a)):
                count[(u, v) if u < v else (v, u)] += 1 if u < v else -1
        return bool(self.facets) and not any(count.values())

    def mean_edge(self) -> float:
        """Mean length of the edges, mm."""
        total = 0.0
        for a, b, c in self.facets:
            p, q, r = self.points[a], self.points[b], self.points[c]
            total += math.dist(p, q) + math.dist(q, r) + math.dist(r, p)
        return total / (3 * len(self.facets)) if self.facets else 0.0

    def normal(self, facet: int) -> Point:
        """Unit normal of a facet; (0, 0, 0) if it has no area."""
        a, b, c = (self.points[i] for i in self.facets[facet])
        return unit(cross(minus(b, a), minus(c, a)))

    def facet_at(self, place: Point) -> int:
        """The facet a place lies on, or the nearest one; −1 if there is none."""
        best, nearest = -1, math.inf
        for i, corners in enumerate(self.facets):
            a, b, c = (self.points[j] for j in corners)
            # Nothing of a triangle is nearer than the nearest point of its bounding box.
            if all(
                min(a[k], b[k], c[k]) - nearest < place[k] < max(a[k], b[k], c[k]) + nearest
                for k in range(3)
            ):
                distance = distance_to_triangle(place, a, b, c)
                if distance < nearest:
                    best, nearest = i, distance
        return best


def minus(a: Point, b: Point) -> Point:
    """A − b."""
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def dot(a: Point, b: Point) -> float:
    """A · b."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Point, b: Point) -> Point:
    """A × b."""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(a: Point) -> Point:
    """A / |a|; (0, 0, 0) for nothing."""
    norm = math.sqrt(dot(a, a))
    return (a[0] / norm, a[1] / norm, a[2] / norm) if norm > 0.0 else (0.0, 0.0, 0.0)


class FlatRegions:
    """Finds the flat region around a facet of a mesh.

    * ``flatness``: in mean edges, see ``FLATNESS``
    * ``angle``: degrees, see ``FLAT_ANGLE``
    """

    def __init__(
        self, mesh: Triangles, flatness: float = FLATNESS, angle: float = FLAT_ANGLE
    ) -> None:
        self.mesh = mesh
        self._offset = flatness * mesh.mean_edge()
        self._cosine = math.cos(math.radians(angle))
        self._of_edge: dict[tuple[int, int], list[int]] = defaultdict(list)
        for i, (a, b, c) in enumerate(mesh.facets):
            for u, v in ((a, b), (b, c), (c, a)):
                self._of_edge[(u, v) if u < v else (v, u)].append(i)

    def around(self, facet: int, marked: set[int] | None = None) -> set[int]:
        """Facets connected with ``facet`` that lie in its plane.

        * ``marked``: the region ends where the box about these facets ends.  A strut flush with
          the side of a plate lies in the same plane, but not between the plate's other sides.
        """
        mesh = self.mesh
        is_within = self._box_of(marked) if marked else lambda _: True
        normal = mesh.normal(facet)
        height = dot(normal, mesh.points[mesh.facets[facet][0]])
        region, front = {facet}, [facet]
        while front:
            a, b, c = mesh.facets[front.pop()]
            for u, v in ((a, b), (b, c), (c, a)):
                for other in self._of_edge[(u, v) if u < v else (v, u)]:
                    if (
                        other not in region
                        and self._is_in_plane(other, normal, height)
                        and is_within(other)
                    ):
                        region.add(other)
                        front.append(other)
        return region

    def _box_of(self, marked: set[int]) -> Callable[[int], bool]:
        """Whether a facet lies in the box about others."""
        mesh = self.mesh
        corners = [mesh.points[p] for f in marked for p in mesh.facets[f]]
        low = [min(c[k] for c in corners) - self._offset for k in range(3)]
        high = [max(c[k] for c in corners) + self._offset for k in range(3)]
        return lambda facet: all(
            low[k] <= mesh.points[p][k] <= high[k] for p in mesh.facets[facet] for k in range(3)
        )

    def _is_in_plane(self, facet: int, normal: Point, height: float) -> bool:
        mesh = self.mesh
        corners = mesh.facets[facet]
        if any(abs(dot(normal, mesh.points[i]) - height) > self._offset for i in corners):
            return False
        across = mesh.normal(facet)
        return across == (0.0, 0.0, 0.0) or dot(normal, across) >= self._cosine


def near_surface(mesh: Triangles, surface: Triangles, distance: float) -> set[int]:
    """Facets all of whose corners are within ``distance`` mm of another surface."""
    near: dict[int, bool] = {}
    grid = _Grid(surface, distance)

    def is_near(point: int) -> bool:
        if point not in near:
            near[point] = grid.is_near(mesh.points[point])
        return near[point]

    return {i for i, corners in enumerate(mesh.facets) if all(is_near(p) for p in corners)}


class _Grid:
    """Triangles in boxes, each wide enough for the question "what is within ``distance``"."""

    def __init__(self, surface: Triangles, distance: float) -> None:
        self._surface, self._distance = surface, distance
        boxes = [self._box(f) for f in surface.facets]
        self._low = tuple(min((b[0][k] for b in boxes), default=0.0) for k in range(3))
        self._high = tuple(max((b[1][k] for b in boxes), default=0.0) for k in range(3))
        widest = max((h - lo for lo, h in zip(self._low, self._high)), default=0.0)
        # About as many boxes along the longest side as there are triangles along it.
        self._size = max(widest / max(1.0, math.sqrt(len(boxes))), distance, 1e-9)
        self._cells: dict[tuple[int, ...], list[int]] = defaultdict(list)
        for i, (low, high) in enumerate(boxes):
            for cell in _cells(self._cell(low), self._cell(high)):
                self._cells[cell].append(i)

    def is_near(self, p: Point) -> bool:
        if any(p[k] < self._low[k] or p[k] > self._high[k] for k in range(3)):
            return False
        surface = self._surface
        for i in self._cells.get(self._cell(p), ()):
            a, b, c = (surface.points[j] for j in surface.facets[i])
            if distance_to_triangle(p, a, b, c) <= self._distance:
                return True
        return False

    def _box(self, facet: Facet) -> tuple[Point, Point]:
        corners, d = [self._surface.points[i] for i in facet], self._distance
        x, y, z = zip(*corners)
        return (min(x) - d, min(y) - d, min(z) - d), (max(x) + d, max(y) + d, max(z) + d)

    def _cell(self, p: Point) -> tuple[int, ...]:
        return tuple(math.floor((p[k] - self._low[k]) / self._size) for k in range(3))


def _cells(low: tuple[int, ...], high: tuple[int, ...]) -> Iterable[tuple[int, int, int]]:
    return (
        (i, j, k)
        for i in range(low[0], high[0] + 1)
        for j in range(low[1], high[1] + 1)
        for k in range(low[2], high[2] + 1)
    )


def distance_to_triangle(p: Point, a: Point, b: Point, c: Point) -> float:
    """Distance of a point from a triangle, mm (Ericson, Real-Time Collision Detection, 5.1.5)."""
    ab, ac, ap = minus(b, a), minus(c, a), minus(p, a)
    d1, d2 = dot(ab, ap), dot(ac, ap)
    if d1 <= 0.0 and d2 <= 0.0:
        return math.dist(p, a)
    bp = minus(p, b)
    d3, d4 = dot(ab, bp), dot(ac, bp)
    if d3 >= 0.0 and d4 <= d3:
        return math.dist(p, b)
    cp = minus(p, c)
    d5, d6 = dot(ab, cp), dot(ac, cp)
    if d6 >= 0.0 and d5 <= d6:
        return math.dist(p, c)
    vc = d1 * d4 - d3 * d2
    if vc <= 0.0 and d1 >= 0.0 and d3 <= 0.0:
        return _distance_along(p, a, ab, d1 / (d1 - d3))
    vb = d5 * d2 - d1 * d6
    if vb <= 0.0 and d2 >= 0.0 and d6 <= 0.0:
        return _distance_along(p, a, ac, d2 / (d2 - d6))
    va = d3 * d6 - d5 * d4
    if va <= 0.0 and d4 - d3 >= 0.0 and d5 - d6 >= 0.0:
        return _distance_along(p, b, minus(c, b), (d4 - d3) / ((d4 - d3) + (d5 - d6)))
    area = va + vb + vc
    if area == 0.0:
        return min(math.dist(p, a), math.dist(p, b), math.dist(p, c))
    v, w = vb / area, vc / area
    return math.dist(p, tuple(a[k] + ab[k] * v + ac[k] * w for k in range(3)))


def _distance_along(p: Point, start: Point, edge: Point, t: float) -> float:
    return math.dist(p, tuple(start[k] + edge[k] * t for k in range(3)))


def write_ply(path: str, mesh: Triangles) -> None:
    """Binary PLY; the labels, if any, as the face property ``int non_design``."""
    labelled = bool(mesh.labels)
    if labelled and len(mesh.labels) != len(mesh.facets):
        raise ValueError(f"{len(mesh.labels)} labels for {len(mesh.facets)} facets")
    header = [
        "ply",
        "format binary_little_endian 1.0",
        "comment lengths in mm; non_design: 1 where the optimiser had to keep the face",
        f"element vertex {len(mesh.points)}",
        *(f"property double {c}" for c in "xyz"),
        f"element face {len(mesh.facets)}",
        "property list uchar int vertex_indices",
        *(["property int non_design"] if labelled else []),
        "end_header\n",
    ]
    pack_point = struct.Struct("<3d").pack
    pack_facet = struct.Struct("<B4i" if labelled else "<B3i").pack
    with open(path, "wb") as out:
        out.write("\n".join(header).encode("ascii"))
        out.write(b"".join(pack_point(*p) for p in mesh.points))
        if labelled:
            faces = zip(mesh.facets, mesh.labels)
            out.write(b"".join(pack_facet(3, *corners, label) for corners, label in faces))
        else:
            out.write(b"".join(pack_facet(3, *corners) for corners in mesh.facets))


def is_non_design_name(name: str, patterns: Sequence[str] = ()) -> bool:
    """Whether a name says non-design, by the rule of the program's ``--non-design-name``."""
    plain = _plain(name)
    return any(_matches(plain, _plain(p)) for p in patterns or DEFAULT_NAMES)


#: The program's defaults.
DEFAULT_NAMES = ("*non_design*", "*nondesign*", "fixed*", "keep*")


def _plain(name: str) -> str:
    return "".join(c for c in name.lower() if c not in "-_ ")


def _matches(name: str, pattern: str) -> bool:
    first, *rest = pattern.split("*")
    if not rest:
        return name == first
    if not name.startswith(first):
        return False
    at = len(first)
    for part in rest[:-1]:
        found = name.find(part, at)
        if found < 0:
            return False
        at = found + len(part)
    return len(name) - at >= len(rest[-1]) and name.endswith(rest[-1])


def file_stem(label: str) -> str:
    """A file name without its ending from any label: no separators, not empty."""
    kept = "".join(c if c.isalnum() or c in "-_." else "_" for c in label).strip("._")
    return kept[:80] or "mesh"
