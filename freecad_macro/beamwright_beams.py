# SPDX-License-Identifier: MIT OR Apache-2.0
"""The beams of a STEP assembly as objects of the document, named as in the cut list."""

from __future__ import annotations

import importlib
from pathlib import Path
from typing import Any, Iterable, Sequence

import FreeCAD as App
import Mesh
import MeshPart
import Part
from beamwright_command import Outputs
from beamwright_result import COMPOUND, PREVIEW, Result, ResultError
from beamwright_step import Occurrence, read_occurrences


def insert_beams(doc: Any, result: Result) -> tuple[list[Any], list[tuple[str, Any]]]:
    """The objects at the top of the result, and those inside with their names."""
    if result.style == COMPOUND:
        feature = doc.addObject("Part::Feature", "Beams")
        shape = Part.Shape()
        shape.read(result.outputs.step)
        feature.Shape = shape
        return [feature], []
    if result.style == PREVIEW:
        feature = doc.addObject("Mesh::Feature", "BeamsMesh")
        feature.Mesh = _preview_mesh(result.outputs)
        return [feature], []
    return import_step(doc, result.outputs.step)


def _preview_mesh(outputs: Outputs) -> Any:
    if Path(outputs.beams_mesh).is_file():
        return Mesh.Mesh(outputs.beams_mesh)
    shape = Part.Shape()
    shape.read(outputs.step)
    return MeshPart.meshFromShape(
        Shape=shape,
        LinearDeflection=shape.BoundBox.DiagonalLength / 1000.0,
        AngularDeflection=0.5,
        Relative=False,
    )


def import_step(doc: Any, path: str) -> tuple[list[Any], list[tuple[str, Any]]]:
    """Imports the assembly as App::Part with one feature a solid."""
    before = {o.Name for o in doc.Objects}
    # The defaults would merge everything into one nameless compound, and crash without a GUI.
    importer = importlib.import_module("ImportGui" if App.GuiUp else "Import")
    importer.insert(name=path, docName=doc.Name, merge=False, useLinkGroup=False)
    new = [o for o in doc.Objects if o.Name not in before]
    inside = {o.Name for part in new if hasattr(part, "Group") for o in part.Group}
    kinds = ("App::Part", "Part::Feature", "App::Link", "App::LinkGroup")
    top = [o for o in new if o.TypeId in kinds and o.Name not in inside]
    if not top:
        raise ResultError(f"FreeCAD found no solid in {Path(path).name}")
    return top, _names_by_place(new, read_occurrences(path))


def _names_by_place(new: Sequence[Any], occurrences: Sequence[Occurrence]) -> list[tuple[str, Any]]:
    """The name of each object: that of the occurrence that stands where the object stands."""
    free = [o for o in new if o.isDerivedFrom("Part::Feature") or o.TypeId == "App::Link"]
    named = []
    for occurrence in occurrences:
        # FreeCAD keeps the order of the file; where it does not, the whole list is searched.
        best = next((o for o in free if _misfit(o.Placement, occurrence) < 1e-4), None)
        if best is not None:
            free.remove(best)
            named.append((occurrence.name, best))
    return named


def _misfit(placement: Any, occurrence: Occurrence) -> float:
    """How far a placement is from that of an occurrence: mm, and turns as chords."""
    turn = placement.Rotation
    return float(
        (placement.Base - App.Vector(*occurrence.origin)).Length
        + (turn.multVec(App.Vector(0, 0, 1)) - App.Vector(*occurrence.axis)).Length
        + (turn.multVec(App.Vector(1, 0, 0)) - App.Vector(*occurrence.x_axis)).Length
    )


def name_beams(named: Iterable[tuple[str, Any]]) -> None:
    """Gives each solid the name it has in the STEP file and in the cut list."""
    preferences = App.ParamGet("User parameter:BaseApp/Preferences/Document")
    allowed = preferences.GetBool("DuplicateLabels", False)
    # A second mesh in the document has a B001 as well; numbers behind it would part the labels
    # from the cut list.
    preferences.SetBool("DuplicateLabels", True)
    try:
        for name, obj in named:
            obj.Label = name
    finally:
        preferences.SetBool("DuplicateLabels", allowed)
