# SPDX-License-Identifier: MIT OR Apache-2.0
"""Finer meshes of the same shape: every triangle in four, as often as wanted."""

from __future__ import annotations

import struct
from pathlib import Path

Mesh = tuple[list[tuple[float, float, float]], list[tuple[int, int, int]], list[int]]


def read_obj(path: Path) -> Mesh:
    """Reads points, triangles and the group of each: 1 for `non_design`."""
    points, triangles, labels, label = [], [], [], 0
    for line in path.read_text().splitlines():
        words = line.split()
        if not words:
            continue
        if words[0] == "v":
            points.append((float(words[1]), float(words[2]), float(words[3])))
        elif words[0] in ("g", "o"):
            label = int("non_design" in words[1:])
        elif words[0] == "f":
            a, b, c = (int(w.split("/")[0]) - 1 for w in words[1:4])
            triangles.append((a, b, c))
            labels.append(label)
    return points, triangles, labels


def split(mesh: Mesh) -> Mesh:
    """Splits every triangle in four at the middles of its sides."""
    points, triangles, labels = list(mesh[0]), [], []
    middles: dict[tuple[int, int], int] = {}

    def middle(a: int, b: int) -> int:
        key = (min(a, b), max(a, b))
        if key not in middles:
            middles[key] = len(points)
            p, q = points[a], points[b]
            points.append(((p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2))
        return middles[key]

    for (a, b, c), label in zip(mesh[1], mesh[2]):
        ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
        triangles += [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
        labels += [label] * 4
    return points, triangles, labels


def write_ply(path: Path, mesh: Mesh) -> None:
    """Writes a binary PLY with the face property `non_design`."""
    points, triangles, labels = mesh
    with path.open("wb") as out:
        out.write(
            (
                "ply\nformat binary_little_endian 1.0\n"
                f"element vertex {len(points)}\n"
                "property double x\nproperty double y\nproperty double z\n"
                f"element face {len(triangles)}\n"
                "property list uchar int vertex_indices\nproperty uchar non_design\nend_header\n"
            ).encode()
        )
        for point in points:
            out.write(struct.pack("<3d", *point))
        for triangle, label in zip(triangles, labels):
            out.write(struct.pack("<B3iB", 3, *triangle, label))
