#!/usr/bin/env python3
# SPDX-License-Identifier: MIT OR Apache-2.0
"""How time and memory grow with the number of triangles.

    cargo build --release
    python3 benches/growth.py                     # samples/single_bar.obj, split 0, 1, 2, … times
    python3 benches/growth.py samples/cantilever.obj --to 1000000

Every triangle is split in four, again and again, so that the shape and its skeleton stay the same
while the mesh grows.  The mesh goes to the program as a labelled binary PLY.  One row a mesh:
processor time and peak memory of the whole process, per triangle, and the exponent of the growth
from row to row (1 is linear).
"""

from __future__ import annotations

import argparse
import math
import subprocess
import sys
import tempfile
from pathlib import Path

from finer import read_obj, split, write_ply

ROOT = Path(__file__).resolve().parent.parent


def measure(command: list[str]) -> tuple[float, float]:
    """Processor seconds and peak megabytes of one run, in a process of its own."""
    run = (
        "import resource, subprocess, sys\n"
        "code = subprocess.run(sys.argv[1:], stdout=subprocess.DEVNULL).returncode\n"
        "used = resource.getrusage(resource.RUSAGE_CHILDREN)\n"
        "print(used.ru_utime + used.ru_stime, used.ru_maxrss / 1024)\n"
        "sys.exit(code)\n"
    )
    done = subprocess.run([sys.executable, "-c", run, *command], capture_output=True, text=True)
    if done.returncode != 0:
        raise SystemExit(f"{' '.join(command)}\n{done.stderr}")
    seconds, megabytes = done.stdout.split()
    return float(seconds), float(megabytes)


def main() -> None:
    """Prints one line for each size of the mesh, from that of the file up."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("mesh", type=Path, nargs="?", default=ROOT / "samples/single_bar.obj")
    parser.add_argument(
        "--to", type=int, default=1_000_000, help="about how many triangles at most"
    )
    parser.add_argument(
        "--program", type=Path, default=ROOT / "target/release/beamwright", help="the binary"
    )
    wanted = parser.parse_args()
    mesh = read_obj(wanted.mesh)
    columns = [("triangles", 10), ("cpu s", 8), ("us/tri", 8), ("peak MB", 8)]
    columns += [("bytes/tri", 10), ("growth", 7)]
    print(*(f"{name:>{width}}" for name, width in columns))
    before = None
    with tempfile.TemporaryDirectory() as folder:
        while len(mesh[1]) <= 1.5 * wanted.to:
            path, count = Path(folder, "mesh.ply"), len(mesh[1])
            write_ply(path, mesh)
            out = str(Path(folder, "skeleton.json"))
            seconds, megabytes = min(
                measure([str(wanted.program), "-q", "skeleton", str(path), "-o", out])
                for _ in range(3)
            )
            growth = ""
            if before:
                growth = f"{math.log(seconds / before[1]) / math.log(count / before[0]):.2f}"
            print(
                f"{count:>10,} {seconds:>8.3f} {1e6 * seconds / count:>8.3f} {megabytes:>8.0f} "
                f"{megabytes * 1048576 / count:>10.0f} {growth:>7}"
            )
            before = (count, seconds)
            mesh = split(mesh)


if __name__ == "__main__":
    main()
