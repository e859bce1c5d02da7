#!/usr/bin/env python3
# SPDX-License-Identifier: MIT OR Apache-2.0
"""Writes docs/validation.md: our skeletons against those of two other methods.

    benches/validation/run        brings the tools and calls this

Meshes are the labelled samples.  Every skeleton passes the same evaluation; those of the other
methods are post-processed as §4.3.1.3 of the thesis says.
"""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import cases
import laplacian
import numpy as np
import picture

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = ROOT / "target/release/beamwright"
OUT = ROOT / "target/validation"

#: Sample, its name in the thesis, and what the thesis prints for E_center, compactness and points
#: outside of its own method, method 1 (mean curvature flow) and method 2 (Laplacian).
CASES: list[tuple[str, str, list[tuple[float, int, int]]]] = [
    (
        "cantilever",
        "table 4.1, 4.4: cantilever 1.6 mm",
        [(0.0120, 38, 0), (0.0134, 753, 0), (0.0165, 116, 1)],
    ),
    (
        "cantilever_14mm",
        "table 4.4: cantilever 1.4 mm",
        [(0.0118, 55, 0), (0.0125, 715, 0), (0.0153, 133, 0)],
    ),
    ("y_form", "table 4.5: Y form", [(0.0093, 13, 0), (0.0110, 344, 0), (0.0135, 37, 0)]),
    (
        "monster_lite",
        "table 4.6: Monster lite",
        [(0.0097, 20, 0), (0.0118, 470, 0), (0.0132, 90, 0)],
    ),
    (
        "four_fixings",
        "table 4.7: four fixings",
        [(0.0074, 90, 0), (0.0089, 1316, 0), (0.0113, 199, 1)],
    ),
    ("single_bar", "known truth: one bar", []),
    ("quadpod", "known truth: four legs and a column", []),
]

#: Ours, by the options that make them.
OURS = {
    "local, axes": ["--junctions", "axes"],
    "local, centred": ["--junctions", "centred"],
    "global": ["--orientation", "global"],
}

METHODS = [*OURS, "mean curvature flow", "Laplacian"]

#: w_H and w_M of the thesis (§4.3.1.2).
FLOW = ["0.8", "0.2"]


def skeletons(sample: str, flow: Path) -> dict[str, Path]:
    """Makes the skeletons of one sample by all methods."""
    mesh_file = ROOT / "samples" / f"{sample}.obj"
    made = {}
    for method, options in OURS.items():
        made[method] = OUT / f"{sample}.{method}.json"
        run(PROGRAM, "skeleton", mesh_file, *options, "-o", made[method])
    mesh = cases.read_obj(mesh_file)
    off = OUT / f"{sample}.off"
    cases.write_off(off, mesh.points, mesh.triangles)
    made["mean curvature flow"] = OUT / f"{sample}.flow.obj"
    run(flow, off, made["mean curvature flow"], *FLOW)
    made["Laplacian"] = OUT / f"{sample}.laplacian.obj"
    cases.write_lines(made["Laplacian"], *laplacian.skeleton(*cases.closed_design_part(mesh)))
    return made


def default_method(sample: str, made: dict[str, Path]) -> str:
    """Which of the methods the program takes by itself."""
    path = OUT / f"{sample}.json"
    run(PROGRAM, "skeleton", ROOT / "samples" / f"{sample}.obj", "-o", path)
    return next(m for m in OURS if made[m].read_bytes() == path.read_bytes())


def run(*command: object) -> str:
    """What a command prints; ends the program where the command fails."""
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(str(c) for c in command)}\n{done.stderr}")
    return done.stdout


def evaluations(sample: str, made: dict[str, Path]) -> dict[str, dict[str, Any]]:
    """Figures of every skeleton; others are made comparable first."""
    mesh_file = ROOT / "samples" / f"{sample}.obj"
    figures = {}
    for method, path in made.items():
        comparable = [] if method in OURS else ["--post-process"]
        text = run(PROGRAM, "evaluate", mesh_file, path, "--json", *comparable)
        figures[method] = json.loads(text)["skeletons"][0]
    return figures


def junction_error(sample: str, path: Path) -> str:
    """Distance of true junctions from the nearest of the skeleton, in strut radii: mean / worst."""
    truth_file = ROOT / "samples" / f"{sample}.truth.json"
    if not truth_file.exists():
        return "–"
    truth = json.loads(truth_file.read_text())
    struts = truth["struts"]
    lines = cases.read_polylines(path)
    ends = np.array([p for line in lines for p in (line[0], line[-1])])
    errors = []
    for i, node in enumerate(truth["nodes"]):
        at = [s for s in struts if i in s["nodes"]]
        if len(at) < 3 or str(i) in truth["interface_nodes"]:
            continue
        radius = np.mean([np.sqrt(s["area"] / np.pi) for s in at])
        errors.append(np.linalg.norm(ends - node, axis=1).min() / radius)
    return f"{np.mean(errors):.2f} / {np.max(errors):.2f}" if errors else "–"


def number(value: float | None) -> str:
    """Four digits, or a dash for none."""
    return "–" if value is None else f"{value:.4f}"


def row(name: str, e: dict[str, Any], junctions: str) -> str:
    """A line of the table under `HEAD`."""
    raw, even, topology = e["raw"], e["resampled"], e["topology"]
    return (
        f"| {name} | {number(raw['e_center'])} | {number(even['e_center'])} "
        f"| {number(even['e_true_shaft'])} | {number(even['offset']['shaft_mean'])} "
        f"| {raw['points']} | {raw['points_outside']} / {100 * e['outside']['fraction']:.2f} % "
        f"| {topology['cycle_rank']} / {topology['expected_cycle_rank']} "
        f"| {100 * e['coverage']['uncovered']:.1f} % | {junctions} |"
    )


HEAD = """\
| method | E_center | equal spacing | E*, shafts | offset | points | outside | cycles | uncovered | junctions |
|---|---|---|---|---|---|---|---|---|---|
"""

INTRODUCTION = """\
# Validation

*Written by `benches/validation/run`; do not edit.*

Skeletons of the samples by the march in the local frame with junctions where axes meet or in the
middle of the material (the default, in bold, is the first for frames of straight bars and the second
for other parts), the march in the global frame (the thesis as written), mean curvature flow (CGAL, w_H 0.8, w_M 0.2) and Laplacian contraction (written
from its description in §4.3.2). All go through `beamwright evaluate`; those of the other methods are
post-processed as §4.3.1.3 says.

* **E_center**: eq. (2.2) of the thesis with the points as delivered; **equal spacing**: resampled at the
  mean strut radius, so that few points in easy places are no advantage; **E\\*, shafts**: with true rays,
  away from junctions and ends. Smaller is better.
* **offset**: mean distance from the centroid of the section over its radius, on the shafts.
* **points**: compactness. **outside**: points / share of the length. **cycles**: of the skeleton / of the
  part. **uncovered**: surface without a branch under it. **junctions**: mean / worst distance from the
  true ones, in strut radii.
* Rows in italics are printed in the thesis. Its meshes are not these: only rank and magnitude
  compare.
* Pictures: squares are junctions, points outside are black.

"""

WHERE_GLOBAL_FAILS = """\
## Where the march in the global frame fails

What §5.2.1 of the thesis says shows in the rows above. A box aligned with the axes holds more void
the farther a strut leans from them: its barycentre leaves the middle, and it widens past the ratio
where no junction is (Monster lite, the legs of the quadpod). At a thick junction from which thin
struts leave, boxes of the junction's width overlap those of its neighbours, and one junction is
taken for another (four fixings). The program says so in its findings, and ends in exit code 3 with
`--strict`.
"""


def main() -> None:
    """Writes the page and its pictures."""
    OUT.mkdir(parents=True, exist_ok=True)
    text = [INTRODUCTION]
    for sample, title, thesis in CASES:
        made = skeletons(sample, Path(sys.argv[1]))
        figures = evaluations(sample, made)
        text.append(f"## {title[0].upper()}{title[1:]} (`samples/{sample}.obj`)\n\n{HEAD}")
        default = default_method(sample, made)
        for method in METHODS:
            name = f"**{method}**" if method == default else method
            text.append(row(name, figures[method], junction_error(sample, made[method])) + "\n")
        for method, (e, points, outside) in zip(["its method", "method 1", "method 2"], thesis):
            text.append(
                f"| *thesis, {method}* | *{e:.4f}* | | | | *{points}* | *{outside}* | | | |\n"
            )
        png = f"pictures/validation_{sample}.png"
        mesh = cases.read_obj(ROOT / "samples" / f"{sample}.obj")
        picture.draw(ROOT / "docs" / png, mesh, {m: cases.read_polylines(made[m]) for m in METHODS})
        if sample == "y_form":
            near = {m: cases.read_polylines(made[m]) for m in list(OURS)[:2]}
            picture.draw_junction(ROOT / "docs/pictures/junctions.png", mesh, near)
        text.append(f"\n![{sample}: skeletons by all methods]({png})\n\n")
        print(sample, flush=True)
    text.append(WHERE_GLOBAL_FAILS)
    (ROOT / "docs/validation.md").write_text("".join(text))


if __name__ == "__main__":
    main()
