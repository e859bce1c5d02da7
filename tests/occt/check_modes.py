#!/usr/bin/env python3
"""Runs the program in its modes and reads every STEP file with OCCT.

    check_modes.py PROGRAM

A mode is a --profile with a --loft and a --joints, on a mesh: a sample, or a ladder of round
members whose rungs end in saddles.  All of them together would be 576 runs; what goes wrong goes
wrong where two of the four meet, so that the 48 runs of an orthogonal array do, in which every two
values of different columns meet at least once.

Every solid must be valid, closed and the right side out, and have the volume the file states, which
the program has from a formula: to 1e-9 where nothing is cut oblique, else to what OCCT's own edges
allow.  Without joints and tapers that volume is area times length, both from the list of
properties.

Needs the PyPI package cadquery-ocp, and the folder freecad_macro on the path: the macro offers the
same profiles, lofts and joints.  Exit code 1 if anything is wrong.
"""

from __future__ import annotations

import csv
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Iterator, NamedTuple

import beamwright_command
from beamwright_command import JOINTS, LOFTS
from check_step import Leaf, Reader, below, faults_of_shape, property_of, volume
from OCP.TopAbs import TopAbs_SOLID

PROFILES = [
    *(family for family in beamwright_command.PROFILES if family != "catalogue"),
    "catalogue:CHS",
    "catalogue:IPE,L,RHS",
]
MESHES = [
    "samples/y_form.obj",
    "tests/data/ladder.obj",
    "samples/four_fixings.obj",
    "samples/cantilever.obj",
]
ROOT = Path(__file__).resolve().parents[2]

# Nothing is cut oblique: OCCT integrates the very surfaces of the formula.
EXACT = 1e-9
# OCCT lays oblique cuts of cones and bores through points, and integrates up to there; corners of
# non-design parts are those of a mesh, off their planes by single precision.
CUT = 1e-6


class Mode(NamedTuple):
    """A row of the array."""

    profile: str
    loft: str
    joints: str
    mesh: str


def modes() -> Iterator[Mode]:
    """The rows of the array: 12 × 4 for the two longest columns, the others turned over them."""
    for p, profile in enumerate(PROFILES):
        for j, joints in enumerate(JOINTS):
            yield Mode(profile, LOFTS[(p + j + 1) % 3], joints, MESHES[(p + j) % 4])


def are_all_pairs_there(rows: list[Mode]) -> bool:
    """Whether every two values of different columns meet in a row."""
    columns = [PROFILES, LOFTS, JOINTS, MESHES]
    met = {(a, b, row[a], row[b]) for row in rows for a in range(4) for b in range(a)}
    return len(met) == sum(len(columns[a]) * len(columns[b]) for a in range(4) for b in range(a))


def faults_of_leaf(leaf: Leaf, mode: Mode) -> Iterator[str]:
    """What is wrong with one part of a file."""
    yield from faults_of_shape(leaf)
    found = sum(volume(solid) for solid in below(leaf.shape, TopAbs_SOLID))
    if leaf.stated_volume is None:
        yield "no stated volume"
        return
    off = abs(found / leaf.stated_volume - 1)
    is_square_beam = mode.joints == "none" and (leaf.name or "").startswith("B")
    if off > (EXACT if is_square_beam else CUT):
        yield f"volume {found}, {off:.1e} off the stated one"
    if mode.loft == "constant" and is_square_beam:
        meant = measure(leaf, "area") * measure(leaf, "length")
        if abs(found / meant - 1) > EXACT:
            yield f"volume {found}, but area times length is {meant}"


def measure(leaf: Leaf, name: str) -> float:
    """A property that is a number."""
    value = property_of(leaf, name)
    return value if isinstance(value, float) else float("nan")


def run(program: Path, folder: Path, number: int, mode: Mode) -> tuple[Path, str]:
    """Writes the file of a mode; what the program said if it failed."""
    step = folder / f"{number:02}.step"
    command = [str(program), "reconstruct", str(ROOT / mode.mesh), "-o", str(step), "-q"]
    choices = ["--profile", mode.profile, "--loft", mode.loft, "--joints", mode.joints]
    done = subprocess.run([*command, *choices], capture_output=True, text=True, check=False)
    return step, "" if done.returncode == 0 else done.stderr.strip() or "no word why"


def saddles(step: Path) -> int:
    """Kinds of pieces with a saddle, by the cut list beside a STEP file."""
    with step.with_suffix(".csv").open(encoding="utf-8", newline="") as table:
        rows = list(csv.reader(table))
    columns = [rows[0].index(name) for name in ("saddle_1_mm", "saddle_2_mm")]
    pieces = [row for row in rows[1:] if row and row[0].startswith("P")]
    return sum(any(float(row[column]) > 0 for column in columns) for row in pieces)


def main() -> int:
    if len(sys.argv) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    program = Path(sys.argv[1]).resolve()
    rows = list(modes())
    assert are_all_pairs_there(rows), "a pair of values is missing"
    wrong = parts = coped = 0
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor() as pool:
        jobs = [pool.submit(run, program, Path(folder), i, row) for i, row in enumerate(rows)]
        for mode, job in zip(rows, jobs):
            step, said = job.result()
            faults = [said] if said else []
            leaves = [] if said else Reader(step).model().leaves
            for leaf in leaves:
                faults += [f"{leaf.name!r}: {fault}" for fault in faults_of_leaf(leaf, mode)]
            if not said and not leaves:
                faults.append("no parts")
            coped += 0 if said else saddles(step)
            parts += len(leaves)
            wrong += len(faults)
            for fault in faults:
                print(f"{' '.join(mode)}: {fault}", flush=True)
    if not coped:
        wrong += 1
        print("no piece has a saddle")
    print(
        f"{len(rows)} modes, {parts} parts, {coped} kinds of pieces with saddles, "
        f"{wrong or 'no'} fault{'s' if wrong != 1 else ''}"
    )
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
