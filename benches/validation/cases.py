# SPDX-License-Identifier: MIT OR Apache-2.0
"""Labelled meshes for the validation, and skeletons to draw."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path

import numpy as np


@dataclass
class Mesh:
    """Points, triangles and which of them are non-design."""

    points: np.ndarray
    triangles: np.ndarray
    non_design: np.ndarray


def read_obj(path: Path) -> Mesh:
    """Reads an OBJ of triangles with the groups `design` and `non_design`."""
    points, triangles, labels, label = [], [], [], False
    for line in path.read_text().splitlines():
        words = line.split()
        if not words:
            continue
        if words[0] == "v":
            points.append([float(w) for w in words[1:4]])
        elif words[0] in ("g", "o"):
            label = "non_design" in words[1:]
        elif words[0] == "f":
            triangles.append([int(w.split("/")[0]) - 1 for w in words[1:4]])
            labels.append(label)
    return Mesh(np.array(points), np.array(triangles), np.array(labels))


def closed_design_part(mesh: Mesh) -> tuple[np.ndarray, np.ndarray]:
    """The design part, closed by a fan over each interface section (thesis §4.3.2.2 c)."""
    design = mesh.triangles[~mesh.non_design]
    sides = {(int(t[k]), int(t[(k + 1) % 3])) for t in design for k in range(3)}
    onward = {b: a for a, b in sides if (b, a) not in sides}
    points, fans = mesh.points.tolist(), []
    while onward:
        start = next(iter(onward))
        loop, at = [], start
        while at in onward:
            loop.append(at)
            at = onward.pop(at)
        centre = len(points)
        points.append(np.mean([points[v] for v in loop], axis=0).tolist())
        fans += [[loop[i], loop[(i + 1) % len(loop)], centre] for i in range(len(loop))]
    triangles = np.array(design.tolist() + fans)
    used, renumbered = np.unique(triangles, return_inverse=True)
    return np.array(points)[used], renumbered.reshape(-1, 3)


def write_off(path: Path, points: np.ndarray, triangles: np.ndarray) -> None:
    """A mesh as OFF, each number to its last digit."""
    with path.open("w") as out:
        out.write(f"OFF\n{len(points)} {len(triangles)} 0\n")
        np.savetxt(out, points, fmt="%.17g")
        np.savetxt(out, np.c_[np.full(len(triangles), 3), triangles], fmt="%d")


def write_lines(path: Path, points: np.ndarray, segments: list[tuple[int, int]]) -> None:
    """A skeleton as OBJ lines, each number to its last digit."""
    with path.open("w") as out:
        for x, y, z in points:
            out.write(f"v {x:.17g} {y:.17g} {z:.17g}\n")
        for a, b in segments:
            out.write(f"l {a + 1} {b + 1}\n")


def read_polylines(path: Path) -> list[np.ndarray]:
    """The lines of a skeleton: our JSON, or `v` and `l` of an OBJ."""
    if path.suffix == ".json":
        content = json.loads(path.read_text())
        place = {p["id"]: p["position"] for p in content["points"]}
        return [np.array([place[i] for i in b["points"]]) for b in content["branches"]]
    points, lines = [], []
    for line in path.read_text().splitlines():
        words = line.split()
        if words[:1] == ["v"]:
            points.append([float(w) for w in words[1:4]])
        elif words[:1] == ["l"]:
            lines.append([int(w) - 1 for w in words[1:]])
    return [np.array([points[i] for i in line]) for line in lines]
