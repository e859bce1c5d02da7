# SPDX-License-Identifier: MIT OR Apache-2.0
"""Draws skeletons over the mesh, points outside of it in black (figures 4.21, 4.31, 4.36, 4.40)."""

from __future__ import annotations

from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from cases import Mesh
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure

#: How far round a junction is drawn, mm.
REACH = 20.0

#: A direction that no face of the samples lies along.
RAY = np.array([0.36787944, 0.57721566, 0.7291532])


def draw(path: Path, mesh: Mesh, skeletons: dict[str, list[np.ndarray]]) -> None:
    """Two panels a row, seen along the shortest side of the part."""
    extent = np.ptp(mesh.points, axis=0)
    a, b = sorted(np.argsort(-extent, kind="stable")[:2])
    rows = (len(skeletons) + 1) // 2
    height = 5.5 * extent[b] / extent[a] + 0.4
    figure, axes = plt.subplots(rows, 2, figsize=(11, rows * min(height, 9)), squeeze=False)
    for axis in axes.ravel()[len(skeletons) :]:
        axis.axis("off")
    for axis, (name, lines) in zip(axes.ravel(), skeletons.items()):
        shadow(axis, mesh, a, b)
        points = np.concatenate(lines)
        for line in lines:
            axis.plot(line[:, a], line[:, b], "-", color="#c0392b", lw=1.2, marker=".", ms=3)
        for p in junctions(lines):
            axis.plot(p[a], p[b], "s", color="#1f4e79", ms=4)
        out = points[outside(mesh, points)]
        axis.plot(out[:, a], out[:, b], "o", color="black", ms=5)
        axis.set(title=name, aspect="equal")
        axis.axis("off")
    figure.tight_layout()
    save(figure, path)


def draw_junction(path: Path, mesh: Mesh, skeletons: dict[str, list[np.ndarray]]) -> None:
    """The only junction of a flat part, near by, with the planes across the points beside it."""
    figure, axes = plt.subplots(1, len(skeletons), figsize=(11, 6))
    for axis, (name, lines) in zip(axes, skeletons.items()):
        shadow(axis, mesh, 0, 1)
        (centre,) = junctions(lines)
        for line in lines:
            axis.plot(line[:, 0], line[:, 1], "-", color="#c0392b", lw=1.5, marker=".", ms=8)
            way = line if np.array_equal(line[0], centre) else line[::-1]
            along = (way[2] - way[0])[:2]
            across = np.array([-along[1], along[0]]) / np.linalg.norm(along)
            ends = way[1][:2] + np.outer([-REACH, REACH], across)
            axis.plot(ends[:, 0], ends[:, 1], "--", color="#1f4e79", lw=1)
        axis.plot(centre[0], centre[1], "s", color="#1f4e79", ms=7)
        axis.set(title=name, aspect="equal")
        axis.set_xlim(centre[0] - REACH, centre[0] + REACH)
        axis.set_ylim(centre[1] - REACH, centre[1] + REACH)
        axis.axis("off")
    figure.tight_layout()
    save(figure, path)


def save(figure: Figure, path: Path) -> None:
    """Writes a figure without what would differ from run to run."""
    figure.savefig(path, dpi=72, metadata={"Software": None}, pil_kwargs={"optimize": True})
    plt.close(figure)


def shadow(axis: Axes, mesh: Mesh, a: int, b: int) -> None:
    """The mesh, flat: the design part grey, the non-design parts orange."""
    for of, colour in [(~mesh.non_design, "#dfe6ec"), (mesh.non_design, "#f3d9c0")]:
        faces = mesh.points[mesh.triangles[of]][:, :, [a, b]]
        axis.add_collection(PolyCollection(faces, facecolor=colour, edgecolor=colour, lw=0.3))
    axis.autoscale_view()


def junctions(lines: list[np.ndarray]) -> list[np.ndarray]:
    """Places where three or more segments meet."""
    count: dict[tuple[float, ...], int] = {}
    for line in lines:
        for i, p in enumerate(line):
            at_end = i in (0, len(line) - 1)
            count[tuple(p)] = count.get(tuple(p), 0) + (1 if at_end else 2)
    return [np.array(p) for p, n in count.items() if n > 2]


def outside(mesh: Mesh, points: np.ndarray) -> np.ndarray:
    """Whether a ray from each point crosses the surface an even number of times."""
    p, q, r = (mesh.points[mesh.triangles[:, k]] for k in range(3))
    u, v = q - p, r - p
    across = np.cross(RAY, v)
    det = np.einsum("ij,ij->i", u, across)
    even = np.empty(len(points), dtype=bool)
    for i, point in enumerate(points):
        t = point - p
        x = np.einsum("ij,ij->i", t, across) / det
        w = np.cross(t, u)
        y = w @ RAY / det
        along = np.einsum("ij,ij->i", v, w) / det
        even[i] = np.count_nonzero((x >= 0) & (y >= 0) & (x + y <= 1) & (along > 0)) % 2 == 0
    return even
