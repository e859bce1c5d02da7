# SPDX-License-Identifier: MIT OR Apache-2.0
"""From the files of a run to objects in the document: one transaction, one undo.

``insert_result`` does it; all lengths are in mm.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import FreeCAD as App
import Mesh
import Part
from beamwright_beams import insert_beams, name_beams
from beamwright_cut_list import fill_sheet, read_cut_list
from beamwright_fuse import fused_feature
from beamwright_group import describe, find_group, remove, reveal, with_contents
from beamwright_input import MILLIMETRES, SHOWN_MESHES
from beamwright_report import ReportText
from beamwright_result import Inserted, Result, ResultError
from beamwright_skeleton import Colour, Skeleton, read_skeleton
from beamwright_step import mark_of


def insert_result(doc: Any, result: Result) -> Inserted:
    """Puts the result of a run into a document: one transaction, one undo.

    The result of an earlier run on the same mesh is replaced.  If anything fails the document
    is left as it was and ``ResultError`` says why.
    """
    before = {o.Name for o in doc.Objects}
    doc.openTransaction("Beamwright")
    try:
        inserted = _insert(doc, result, before)
        doc.recompute()
    except Exception as error:
        doc.abortTransaction()
        # Without undo nothing was rolled back; nothing old has been touched so far.
        remove(doc, [o.Name for o in doc.Objects if o.Name not in before])
        raise ResultError(f"the result could not be taken in: {error}") from error
    doc.commitTransaction()
    return inserted


def _insert(doc: Any, result: Result, before: set[str]) -> Inserted:
    notes: list[str] = []
    rows = read_cut_list(result.outputs.cut_list)
    skeleton = read_skeleton(result.outputs.skeleton, result.outputs.sections)
    top, named = insert_beams(doc, result)
    beams = [o for name, o in named if mark_of(name)]
    old = find_group(doc, result.source)
    skeleton_objects = _insert_skeleton(doc, skeleton)
    sheet = doc.addObject("Spreadsheet::Sheet", "CutList")
    text = doc.addObject("App::TextDocument", "Report")
    made = [*top, *skeleton_objects, sheet, text]
    if result.fuse:
        fused, note = fused_feature(doc, beams, top)
        notes.append(note)
        made += [fused] if fused else []
    if result.source.file and result.show_mesh:
        made += _insert_mesh(doc, result.source.file, result.unit)

    # From here on what was there before is changed: nothing below reads files any more.
    group = _emptied(doc, old) or doc.addObject("App::DocumentObjectGroup", "Beamwright")
    for obj, what in ((group, "Beamwright"), (top[0], "Frame"), (sheet, "Cut list")):
        obj.Label = f"{what} {result.source.label}"
    text.Label = f"Report {result.source.label}"
    name_beams(named)
    fill_sheet(sheet, rows, result.source.label, beams)
    extra = [*notes, "", "Options of the run: " + (" ".join(result.chosen) or "the defaults")]
    text.Text = str(ReportText.of(result.outcome.summary, result.program.version_text, extra))
    group.addObjects(made)
    made_names = [o.Name for o in doc.Objects if o.Name not in before and o is not group]
    describe(group, result, [n for n in made_names if n != group.Name])
    reveal(result, group, beams, top)
    return Inserted(group, beams, notes)


def _emptied(doc: Any, group: Any | None) -> Any | None:
    """The group of an earlier run, without what that run made."""
    if group is not None:
        mine = [name for name in group.BeamwrightObjects if doc.getObject(name)]
        remove(doc, with_contents(doc, mine))
    return group


def _insert_skeleton(doc: Any, skeleton: Skeleton) -> list[Any]:
    """The branches as wires, and the points where they meet and end."""
    wires = []
    colours: list[Colour] = []
    at = iter(skeleton.segment_colours())
    for branch in skeleton.branches:
        points = [App.Vector(*skeleton.points[i].position) for i in branch]
        kept = points[:1]
        for point in points[1:]:
            colour = next(at)
            # A wire has no edges without length.
            if (point - kept[-1]).Length > 1e-7:
                kept.append(point)
                colours.append(colour)
        if len(kept) > 1:
            wires.append(Part.makePolygon(kept))
    objects = []
    if wires:
        feature = doc.addObject("Part::Feature", "Skeleton")
        feature.Shape = Part.makeCompound(wires)
        if App.GuiUp:
            feature.ViewObject.LineWidth = 4.0
            feature.ViewObject.LineColorArray = [(*c, 0.0) for c in colours]
        objects.append(feature)
    for name, kinds, colour in (
        ("Junctions", ("junction",), (0.85, 0.10, 0.10)),
        ("Ends", ("interface", "end"), (0.10, 0.10, 0.10)),
    ):
        places = skeleton.places(*kinds)
        if places:
            feature = doc.addObject("Part::Feature", name)
            feature.Shape = Part.makeCompound([Part.Vertex(*p) for p in places])
            if App.GuiUp:
                feature.ViewObject.PointSize = 9.0
                feature.ViewObject.PointColor = colour
            objects.append(feature)
    return objects


def _insert_mesh(doc: Any, path: str, unit: str) -> list[Any]:
    """The mesh of a file, so that it is seen what the beams were made from."""
    if Path(path).suffix.lower() not in SHOWN_MESHES:
        return []
    feature = doc.addObject("Mesh::Feature", "Mesh")
    mesh = Mesh.Mesh(path)
    scale = MILLIMETRES[unit or "mm"]
    if scale != 1.0:
        matrix = App.Matrix()
        matrix.scale(scale, scale, scale)
        mesh.transform(matrix)
    feature.Mesh = mesh
    feature.Label = Path(path).stem
    return [feature]
