"""Imports STEP files into FreeCAD and compares the document with what was meant.

    BEAMWRIGHT_STEP_OUT=FOLDER freecadcmd check_freecad.py

For each NAME.step of the folder beside a NAME.json (both written by
tests/step_occt.rs): the tree of groups, one solid for each part, valid, at its
place and near its volume, under the name of its product (FreeCAD numbers
repeated names).  Prints a line for each file; the last line is `OK` or `FAULTS`.

FreeCAD's own volume is a rough one: it is up to 10 % off for the twisted and smooth
B-spline sides here that OCCT's adaptive integration gets right to ten digits.
"""

from __future__ import annotations

import json
import os
import sys
from pathlib import Path
from typing import Any, Iterator

import FreeCAD
import Import

ROUGH_VOLUME = 0.15
PLACE = 1e-6


def leaves(item: Any, path: list[str]) -> Iterator[tuple[list[str], Any]]:
    """(path, object) of all solids below a group, in order."""
    if item.TypeId != "App::Part":
        yield path, item
        return
    for child in item.Group:
        yield from leaves(child, [*path, item.Label])


def same_name(label: str, name: str) -> bool:
    """Whether FreeCAD may have made the label from the name by numbering it."""
    stem = name.rstrip("0123456789")
    return label == name or (label.startswith(stem) and label[len(stem) :].isdigit())


def faults_of(path: list[str], item: Any, meant: dict[str, Any]) -> Iterator[str]:
    """How a part of the document differs from what was meant."""
    shape = item.Shape
    if shape.ShapeType != "Solid" or not shape.isValid():
        yield f"{shape.ShapeType}, valid: {shape.isValid()}"
    if not same_name(item.Label, meant["product"]):
        yield f"named {item.Label!r}, not {meant['product']!r}"
    if path != meant["path"]:
        yield f"in {path}, not {meant['path']}"
    if abs(shape.Volume / meant["volume"] - 1) > ROUGH_VOLUME:
        yield f"volume {shape.Volume}, not {meant['volume']}"
    at = item.getGlobalPlacement().Base
    off = max(abs(a - b) for a, b in zip(at, meant["placement"][3::4]))
    if off > PLACE * max(1.0, *map(abs, meant["placement"])):
        yield f"at {tuple(at)}, not {meant['placement'][3::4]}"


def check(path: Path) -> tuple[list[str], int]:
    """All faults of one file, as lines, and the number of its parts."""
    parts = json.loads(path.with_suffix(".json").read_text(encoding="utf-8"))["parts"]
    document = FreeCAD.newDocument()
    Import.insert(name=str(path), docName=document.Name, merge=False, useLinkGroup=False)
    found = [leaf for root in document.RootObjects for leaf in leaves(root, [])]
    faults = [] if len(found) == len(parts) else [f"{len(found)} parts, not {len(parts)}"]
    for (where, item), meant in zip(found, parts):
        faults += [f"{meant['name']!r}: {fault}" for fault in faults_of(where, item, meant)]
    FreeCAD.closeDocument(document.Name)
    return faults, len(found)


wrong = 0
for file in sorted(Path(os.environ["BEAMWRIGHT_STEP_OUT"]).glob("*.step")):
    if file.with_suffix(".json").exists():
        found_faults, count = check(file)
        wrong += len(found_faults)
        print(f"{file.name}: {count} parts, {len(found_faults) or 'no'} faults")
        for fault in found_faults:
            print(f"    {fault}")
print("FAULTS" if wrong else "OK")
sys.stdout.flush()
os._exit(1 if wrong else 0)  # FreeCAD 0.20 crashes when it takes down its documents
