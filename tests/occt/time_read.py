#!/usr/bin/env python3
"""time_read.py FOLDER: CPU seconds OCCT takes to read each STEP file of a folder, best of three."""

from __future__ import annotations

import sys
import time
from pathlib import Path

from OCP.STEPControl import STEPControl_Reader
from OCP.TopAbs import TopAbs_SOLID
from OCP.TopExp import TopExp_Explorer


def read(path: Path) -> tuple[float, int]:
    """Seconds for one reading, and the number of solids found."""
    start = time.process_time()
    reader = STEPControl_Reader()
    reader.ReadFile(str(path))
    reader.TransferRoots()
    shape = reader.OneShape()
    seconds = time.process_time() - start
    explorer, solids = TopExp_Explorer(shape, TopAbs_SOLID), 0
    while explorer.More():
        solids += 1
        explorer.Next()
    return seconds, solids


for file in sorted(Path(sys.argv[1]).glob("*.step")):
    seconds, solids = min(read(file) for _ in range(3))
    print(
        f"{file.name:24} {file.stat().st_size / 1e6:7.2f} MB {solids:6} solids {seconds:7.2f} s",
        flush=True,
    )
