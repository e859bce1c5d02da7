#!/usr/bin/env python3
"""Runs the program in its modes and reads every STEP file with OCCT.

    check_modes.py PROGRAM SAMPLES

A mode is a --profile with a --loft and a --joints, on a sample.  All of them together would be 432
runs; what goes wrong goes wrong where two of the four meet, so that the 48 runs of an orthogonal
array do, in which every two values of different columns meet at least once.

Every solid must be valid, closed and the right side out, and have the volume the file states, which
the program has from a formula: to 1e-9 where nothing is cut oblique, else to what OCCT's own edges
allow.  Without joints and tapers that volume is area times length, both from the list of
properties.

Needs the PyPI package cadquery-ocp.  Exit code 1 if anything is wrong.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from check_step import Leaf, Reader, below, faults_of_shape, property_of, volume
from OCP.TopAbs import TopAbs_SOLID

PROFILES = [
    "auto",
    "round",
    "tube",
    "rectangle",
    "box",
    "ellipse",
    "i",
    "c",
    "l",
    "freeform",
    "catalogue:CHS",
    "catalogue:IPE,L,RHS",
]
LOFTS = ["constant", "taper", "multi"]
JOINTS = ["none", "sphere", "mitre", "trim"]
SAMPLES = ["y_form", "four_fixings", "cantilever"]

# Nothing is cut oblique: OCCT integrates the very surfaces of the formula.
EXACT = 1e-9
# OCCT lays oblique cuts of cones and bores through points, and integrates up to there; corners of
# non-design parts are those of a mesh, off their planes by single precision.
CUT = 1e-6


def modes():
    """The rows of the array: 12 × 4 for the two longest columns, the others turned over them."""
    for p, profile in enumerate(PROFILES):
        for j, joints in enumerate(JOINTS):
            yield profile, LOFTS[(p + j) % 3], joints, SAMPLES[(p + 2 * j) % 3]


def are_all_pairs_there(rows) -> bool:
    """Whether every two values of different columns meet in a row."""
    columns = [PROFILES, LOFTS, JOINTS, SAMPLES]
    met = {(a, b, row[a], row[b]) for row in rows for a in range(4) for b in range(a)}
    return len(met) == sum(len(columns[a]) * len(columns[b]) for a in range(4) for b in range(a))


def faults_of_leaf(leaf: Leaf, mode):
    """What is wrong with one part of a file."""
    yield from faults_of_shape(leaf)
    _, loft, joints, _ = mode
    found = sum(volume(solid) for solid in below(leaf.shape, TopAbs_SOLID))
    if leaf.stated_volume is None:
        yield "no stated volume"
        return
    off = abs(found / leaf.stated_volume - 1)
    is_exact = joints == "none" and leaf.name.startswith("B")
    if off > (EXACT if is_exact else CUT):
        yield f"volume {found}, {off:.1e} off the stated one"
    if loft == "constant" and joints == "none" and leaf.name.startswith("B"):
        meant = property_of(leaf, "area") * property_of(leaf, "length")
        if abs(found / meant - 1) > EXACT:
            yield f"volume {found}, but area times length is {meant}"


def run(program: Path, samples: Path, folder: Path, number: int, mode):
    """Writes the file of a mode; what the program said if it failed."""
    profile, loft, joints, sample = mode
    step = folder / f"{number:02}.step"
    done = subprocess.run(
        [
            program,
            "reconstruct",
            samples / f"{sample}.obj",
            "-o",
            step,
            "-q",
            "--profile",
            profile,
            "--loft",
            loft,
            "--joints",
            joints,
        ],
        capture_output=True,
        text=True,
        check=False,
    )
    return step, None if done.returncode == 0 else done.stderr.strip()


def main() -> int:
    if len(sys.argv) != 3:
        print(__doc__, file=sys.stderr)
        return 2
    program, samples = Path(sys.argv[1]).resolve(), Path(sys.argv[2])
    rows = list(modes())
    assert are_all_pairs_there(rows), "a pair of values is missing"
    wrong = parts = 0
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor() as pool:
        jobs = [
            pool.submit(run, program, samples, Path(folder), i, row) for i, row in enumerate(rows)
        ]
        for mode, job in zip(rows, jobs):
            step, said = job.result()
            faults = [said] if said else []
            leaves = [] if said else Reader(step).model().leaves
            for leaf in leaves:
                faults += [f"{leaf.name!r}: {fault}" for fault in faults_of_leaf(leaf, mode)]
            if not said and not leaves:
                faults.append("no parts")
            parts += len(leaves)
            wrong += len(faults)
            for fault in faults:
                print(f"{' '.join(mode)}: {fault}", flush=True)
    print(f"{len(rows)} modes, {parts} parts, {wrong or 'no'} fault{'s' if wrong != 1 else ''}")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
