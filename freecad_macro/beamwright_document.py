# SPDX-License-Identifier: MIT OR Apache-2.0
"""Between a FreeCAD document and the program; works without the GUI.

====================  =====================================================================
``prepare``           mesh objects or a file, and what is non-design, to files for the program
``insert_result``     the files of a run to objects in the document, in one transaction
``reconstruct``       both, with the run between them: the macro without its panel
====================  =====================================================================

Lengths are in mm, as everywhere in FreeCAD.
"""

from __future__ import annotations

import importlib
import json
import shutil
import tempfile
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, Callable, Iterable, Mapping, Sequence

import beamwright_program as bp
import beamwright_result as br
import FreeCAD as App
import Mesh
import MeshPart
import Part
from beamwright_mesh import (
    TOUCH,
    Triangles,
    file_stem,
    is_non_design_name,
    near_surface,
    union_volume,
    write_ply,
)

PREFERENCES = "User parameter:BaseApp/Preferences/Mod/Beamwright"

#: Above this many beams a tree of solids makes FreeCAD slow.
MANY_BEAMS = 300

#: Meshes that ``Mesh.Mesh`` reads, so that they can be shown beside the beams.
SHOWN_MESHES = (".off", ".obj", ".ply", ".stl")

MILLIMETRES = {"mm": 1.0, "cm": 10.0, "m": 1000.0, "in": 25.4}

# Where non-design comes from.
LABELS, FACES, REGIONS, FEM, NONE = "labels", "faces", "regions", "fem", "none"


class InputError(Exception):
    """What was chosen cannot be used; the text says why and what to do."""


class ResultError(Exception):
    """The result of a run could not be taken into the document."""


# ---------------------------------------------------------------------------------------------
# from the document to files
# ---------------------------------------------------------------------------------------------


@dataclass
class NonDesign:
    """What the optimiser had to keep.

    * ``mode``: ``LABELS`` (names of objects, labels in the file), ``FACES``, ``REGIONS``,
      ``FEM`` or ``NONE``
    * ``faces``: picked facets by the internal name of their mesh object
    * ``objects``: regions, or FEM constraints; for ``FEM`` an empty list means all of them
    * ``depth``: mm; with ``FEM``, how far below a referenced face the material is kept
    """

    mode: str = LABELS
    faces: dict[str, list[int]] = field(default_factory=dict)
    objects: list[Any] = field(default_factory=list)
    depth: float = 0.0


@dataclass
class Source:
    """Where the mesh is: objects of the document, or a file."""

    objects: list[Any] = field(default_factory=list)
    file: str = ""

    @property
    def label(self) -> str:
        """What the result is named after."""
        if self.file:
            return Path(self.file).stem
        kept = [o for o in self.objects if not is_non_design_name(o.Label)]
        return str((kept or self.objects)[0].Label)

    @property
    def key(self) -> str:
        """What is the same when the same mesh is run again."""
        if self.file:
            return str(Path(self.file).resolve())
        return ",".join(sorted(o.Name for o in self.objects))


@dataclass
class Job:
    """Files for one run of the program, and what they say in words."""

    mesh: str
    stem: str
    regions: list[str] = field(default_factory=list)
    unit: str = ""
    notes: list[str] = field(default_factory=list)


def is_mesh(obj: Any) -> bool:
    """Whether an object holds triangles, or a FEM mesh whose surface can be taken."""
    return bool(obj.isDerivedFrom("Mesh::Feature") or obj.isDerivedFrom("Fem::FemMeshObject"))


def triangles_of(obj: Any) -> Triangles:
    """The triangles of a mesh object where it stands in the document."""
    if obj.isDerivedFrom("Fem::FemMeshObject"):
        mesh = _skin_of_fem_mesh(obj)
        local = App.Placement()
    else:
        mesh = obj.Mesh
        local = obj.Placement
    return _triangles(mesh, _global(obj).multiply(local.inverse()))


def _skin_of_fem_mesh(obj: Any) -> Any:
    from femmesh import femmesh2mesh

    return Mesh.Mesh(femmesh2mesh.femmesh_2_mesh(obj.FemMesh))


def _global(obj: Any) -> Any:
    return obj.getGlobalPlacement() if hasattr(obj, "getGlobalPlacement") else obj.Placement


def _triangles(mesh: Any, placement: Any) -> Triangles:
    points, facets = mesh.Topology
    if not placement.isIdentity():
        points = [placement.multVec(p) for p in points]
    return Triangles([(p.x, p.y, p.z) for p in points], [tuple(f) for f in facets])


def shape_of(obj: Any) -> Any:
    """The shape of an object where it stands in the document."""
    shape = obj.Shape.copy()
    shape.Placement = _global(obj).multiply(obj.Placement.inverse()).multiply(shape.Placement)
    return shape


def prepare(source: Source, non_design: NonDesign, folder: str, unit: str = "") -> Job:
    """Writes what the program needs into ``folder``.

    * ``unit``: of length in a file: mm, cm, m or in; "" is the program's choice
    """
    if not source.file and not source.objects:
        raise InputError("nothing to work on: select a mesh object, or name a file")
    if source.file and not Path(source.file).is_file():
        raise InputError(f"there is no file {source.file}")
    stem = file_stem(source.label)
    job = Job(mesh=str(Path(folder) / (stem + ".ply")), stem=stem)
    if source.file and non_design.mode in (LABELS, REGIONS):
        job.mesh, job.unit = source.file, unit
    if non_design.mode == REGIONS:
        parts = _write_regions(non_design.objects, folder, job)
        if source.file and parts.facets:
            raise InputError("an open region mesh cannot be joined to a file; import the file")
        if not source.file:
            merged = _merged(source, non_design, parts)
            _write_labelled(job, merged)
        return job
    if job.mesh == source.file:
        return job
    mesh = _of_file(source.file, unit) if source.file else _merged(source, non_design, None)
    if non_design.mode == FEM:
        _label_by_fem(mesh, source, non_design, job)
    elif non_design.mode == NONE:
        mesh.labels = []
    elif non_design.mode == FACES and not any(mesh.labels):
        raise InputError("no face is picked: click flat faces of the mesh, they turn red")
    _write_labelled(job, mesh)
    return job


def _write_labelled(job: Job, mesh: Triangles) -> None:
    marked = sum(1 for label in mesh.labels if label)
    if marked:
        job.notes.append(f"{marked} of {len(mesh.facets)} faces are marked non-design")
    else:
        mesh.labels = []
    write_ply(job.mesh, mesh)


def _merged(source: Source, non_design: NonDesign, parts: Triangles | None) -> Triangles:
    """All mesh objects as one mesh, with a label where names, picks or region meshes say so."""
    merged = Triangles()
    for obj in source.objects:
        if not is_mesh(obj):
            raise InputError(f"{obj.Label} is no mesh")
        mesh = triangles_of(obj)
        first = len(merged.facets)
        by_name = non_design.mode == LABELS and is_non_design_name(obj.Label)
        merged.append(mesh, 1 if by_name else 0)
        if non_design.mode == FACES:
            for facet in non_design.faces.get(obj.Name, ()):
                merged.labels[first + facet] = 1
    if parts is not None and parts.facets:
        merged.append(parts, 1)
    return merged


def _of_file(path: str, unit: str) -> Triangles:
    if Path(path).suffix.lower() not in SHOWN_MESHES:
        raise InputError(
            f"FreeCAD cannot read {Path(path).name} as a mesh; with such a file non-design comes "
            "from the labels in it or from selected solids"
        )
    mesh = _triangles(Mesh.Mesh(path), App.Placement())
    scale = MILLIMETRES[unit or "mm"]
    mesh.points = [(x * scale, y * scale, z * scale) for x, y, z in mesh.points]
    mesh.labels = [0] * len(mesh.facets)
    return mesh


def _write_regions(objects: Sequence[Any], folder: str, job: Job) -> Triangles:
    """Writes each solid and closed mesh to a file of its own; returns the open meshes."""
    if not objects:
        raise InputError("no region is chosen: select solids or mesh objects that are non-design")
    rest = Triangles()
    for obj in objects:
        if is_mesh(obj):
            closed = [triangles_of(obj)]
            if not closed[0].is_closed():
                rest.append(closed.pop(), 1)
        elif hasattr(obj, "Shape") and obj.Shape.Solids:
            closed = [triangles_of_shape(solid) for solid in shape_of(obj).Solids]
        else:
            raise InputError(f"{obj.Label} is neither a solid nor a mesh")
        for region in closed:
            path = str(Path(folder) / f"region_{len(job.regions) + 1}.ply")
            write_ply(path, region)
            job.regions.append(path)
    if job.regions and rest.facets:
        raise InputError(
            "some regions are closed bodies, others open meshes that are a part of the surface; "
            "choose regions of one kind"
        )
    if job.regions:
        job.notes.append(f"{len(job.regions)} closed region(s) are non-design")
    return rest


def triangles_of_shape(shape: Any, deviation: float = 0.0) -> Triangles:
    """A shape as triangles, no farther from it than ``deviation`` mm (0: a fine default)."""
    deviation = deviation or shape.BoundBox.DiagonalLength / 2000.0
    mesh = MeshPart.meshFromShape(
        Shape=shape, LinearDeflection=deviation, AngularDeflection=0.1, Relative=False
    )
    return _triangles(mesh, App.Placement())


def fem_constraints(doc: Any) -> list[Any]:
    """The FEM constraints of a document that refer to something."""
    return [o for o in doc.Objects if o.isDerivedFrom("Fem::Constraint") and o.References]


def _label_by_fem(mesh: Triangles, source: Source, non_design: NonDesign, job: Job) -> None:
    """Marks the facets on the faces, and on the solids, that FEM constraints refer to."""
    constraints = non_design.objects
    if not constraints and source.objects:
        constraints = fem_constraints(source.objects[0].Document)
    elif not constraints and App.ActiveDocument:
        constraints = fem_constraints(App.ActiveDocument)
    if not constraints:
        raise InputError("the document has no FEM constraint with references")
    touch = TOUCH * mesh.mean_edge()
    for constraint in constraints:
        marked: set[int] = set()
        for obj, names in constraint.References:
            for name in (names,) if isinstance(names, str) else names:
                marked |= _on_reference(mesh, obj, name, touch, non_design.depth, job)
        job.notes.append(f"{constraint.Label}: {len(marked)} faces")
        for facet in marked:
            mesh.labels[facet] = 1
    if not any(mesh.labels):
        raise InputError(
            "the faces of the FEM constraints touch no face of the mesh; does the mesh stand "
            "where the analysed part stands?"
        )


def _on_reference(
    mesh: Triangles, obj: Any, name: str, touch: float, depth: float, job: Job
) -> set[int]:
    shape = shape_of(obj)
    part = shape.getElement(name) if name else shape
    if not part.Faces:
        job.notes.append(f"{obj.Label}.{name} is neither a face nor a solid and was passed over")
        return set()
    surface = triangles_of_shape(part, touch / 4.0)
    reach = touch if part.Solids else touch + depth
    return near_surface(mesh, surface, reach)


# ---------------------------------------------------------------------------------------------
# from files to the document
# ---------------------------------------------------------------------------------------------

SOLIDS, COMPOUND, PREVIEW = "solids", "compound", "preview"


@dataclass
class Result:
    """What a run left, and how it is to be shown.

    * ``style``: ``SOLIDS`` in a tree, one ``COMPOUND``, or a mesh as ``PREVIEW``
    * ``fuse``: whether a fused solid is wanted as well
    * ``settings``: of the panel, kept in the document for the next run
    """

    source: Source
    outputs: bp.Outputs
    outcome: bp.Outcome
    program: bp.Program
    style: str = SOLIDS
    fuse: bool = False
    show_mesh: bool = True
    unit: str = ""
    chosen: Sequence[str] = ()
    settings: Mapping[str, Any] = field(default_factory=dict)


@dataclass
class Inserted:
    """What was put into the document."""

    group: Any
    beams: list[Any] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)


def find_group(doc: Any, source: Source) -> Any | None:
    """The group with the result of an earlier run on the same mesh."""
    for obj in doc.Objects:
        if "BeamwrightSource" in obj.PropertiesList and obj.BeamwrightSource == source.key:
            return obj
    return None


def settings_of(group: Any) -> dict[str, Any]:
    """The settings of the run that made a group."""
    try:
        settings = json.loads(group.BeamwrightSettings)
    except (AttributeError, ValueError):
        return {}
    return settings if isinstance(settings, dict) else {}


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
        _remove(doc, [o.Name for o in doc.Objects if o.Name not in before])
        raise ResultError(f"the result could not be taken in: {error}") from error
    doc.commitTransaction()
    return inserted


def _insert(doc: Any, result: Result, before: set[str]) -> Inserted:
    notes: list[str] = []
    rows = br.read_cut_list(result.outputs.cut_list)
    skeleton = br.read_skeleton(result.outputs.skeleton)
    top, named = _insert_beams(doc, result)
    beams = [o for name, o in named if br.mark_of(name)]
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
    if old is not None:
        mine = [name for name in old.BeamwrightObjects if doc.getObject(name)]
        _remove(doc, _with_contents(doc, mine))
    group = old or doc.addObject("App::DocumentObjectGroup", "Beamwright")
    label = result.source.label
    group.Label, sheet.Label, text.Label = (
        f"{what} {label}" for what in ("Beamwright", "Cut list", "Report")
    )
    top[0].Label = f"Frame {label}"
    _name_beams(named)
    _fill_sheet(sheet, rows, result.source.label, beams)
    extra = [*notes, "", "Options of the run: " + (" ".join(result.chosen) or "the defaults")]
    text.Text = str(br.ReportText.of(result.outcome.summary, result.program.version_text, extra))
    group.addObjects(made)
    made_names = [o.Name for o in doc.Objects if o.Name not in before and o is not group]
    _describe(group, result, [n for n in made_names if n != group.Name])
    _show(result, group, beams, top)
    return Inserted(group, beams, notes)


def _insert_beams(doc: Any, result: Result) -> tuple[list[Any], list[tuple[str, Any]]]:
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
    return _import_step(doc, result.outputs.step)


def _preview_mesh(outputs: bp.Outputs) -> Any:
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


def _import_step(doc: Any, path: str) -> tuple[list[Any], list[tuple[str, Any]]]:
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
    return top, _names_by_place(new, br.read_occurrences(path))


def _names_by_place(
    new: Sequence[Any], occurrences: Sequence[br.Occurrence]
) -> list[tuple[str, Any]]:
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


def _misfit(placement: Any, occurrence: br.Occurrence) -> float:
    """How far a placement is from that of an occurrence: mm, and turns as chords."""
    turn = placement.Rotation
    return float(
        (placement.Base - App.Vector(*occurrence.origin)).Length
        + (turn.multVec(App.Vector(0, 0, 1)) - App.Vector(*occurrence.axis)).Length
        + (turn.multVec(App.Vector(1, 0, 0)) - App.Vector(*occurrence.x_axis)).Length
    )


def _insert_skeleton(doc: Any, skeleton: br.Skeleton) -> list[Any]:
    """The branches as wires, and the points where they meet and end."""
    wires = []
    colours: list[br.Colour] = []
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


def _name_beams(named: Iterable[tuple[str, Any]]) -> None:
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


def _fill_sheet(
    sheet: Any, rows: Iterable[br.CutListRow], parent: str, beams: Sequence[Any]
) -> None:
    """The cut list with a head, a line of totals and a legend."""
    labels = {br.mark_of(b.Label): b.Label for b in beams}
    rows = list(rows)
    cells = br.sheet_rows(rows, parent, labels)
    for column, name in enumerate(br.SHEET_COLUMNS):
        sheet.set(br.cell(0, column), br.text_cell(name))
    for i, line in enumerate(cells):
        for column, content in enumerate(line):
            if content:
                sheet.set(br.cell(i + 1, column), content)
    last = len(cells) + 1
    names = ("Length", "Quantity", "ApproxWeight")
    length, quantity, weight = (br.SHEET_COLUMNS.index(n) for n in names)
    sheet.set(br.cell(last, 1), "'Total")
    sheet.set(br.cell(last, length), f"{sum(r.length * r.quantity for r in rows):.3f} mm")
    sheet.set(br.cell(last, quantity), str(sum(r.quantity for r in rows)))
    sheet.set(br.cell(last, weight), f"{sum(r.mass * r.quantity for r in rows):.6f} kg")
    for i, text in enumerate(br.LEGEND):
        sheet.set(br.cell(last + 2 + i, 1), br.text_cell(text))
    end = br.cell(0, len(br.SHEET_COLUMNS) - 1)
    sheet.setStyle(f"A1:{end}", "bold")
    sheet.setStyle(f"A{last + 1}:{br.cell(last, len(br.SHEET_COLUMNS) - 1)}", "bold")
    for letter, width in (("A", 130), ("B", 210), ("C", 90), ("D", 110), ("E", 90), ("F", 90)):
        sheet.setColumnWidth(letter, width)


def _describe(group: Any, result: Result, made: Sequence[str]) -> None:
    """What a later run, and a reader of the properties, needs to know."""
    properties = {
        "BeamwrightSource": ("App::PropertyString", "Mesh this was made from"),
        "BeamwrightObjects": ("App::PropertyStringList", "Objects the next run replaces"),
        "BeamwrightSettings": ("App::PropertyString", "Settings of the run, as JSON"),
        "Program": ("App::PropertyString", "Version of beamwright"),
        "Summary": ("App::PropertyString", "Summary of the run, as JSON"),
    }
    has_report = Path(result.outputs.report).is_file()
    if has_report:
        properties["Report"] = ("App::PropertyFileIncluded", "Report of the run")
    for name, (kind, tip) in properties.items():
        if name not in group.PropertiesList:
            group.addProperty(kind, name, "Beamwright", tip)
    group.BeamwrightSource = result.source.key
    group.BeamwrightObjects = list(made)
    group.BeamwrightSettings = json.dumps(dict(result.settings))
    group.Program = f"beamwright {result.program.version_text}"
    group.Summary = json.dumps(result.outcome.summary)
    if has_report:
        group.Report = result.outputs.report


def _show(result: Result, group: Any, beams: Sequence[Any], top: Sequence[Any]) -> None:
    """Lets the beams be seen through the mesh, and the skeleton through the beams."""
    if not App.GuiUp:
        return
    for obj in [*result.source.objects, *group.Group]:
        if obj.isDerivedFrom("Mesh::Feature") and obj not in top:
            obj.ViewObject.Transparency = 85
    for obj in beams or [o for o in top if hasattr(o, "Shape")]:
        if hasattr(obj.ViewObject, "Transparency"):
            obj.ViewObject.Transparency = 35


def _with_contents(doc: Any, names: Sequence[str]) -> list[str]:
    """Objects and all they contain, contents first."""
    found: list[str] = []
    for name in names:
        obj = doc.getObject(name)
        below = [o.Name for o in obj.Group] if obj is not None and hasattr(obj, "Group") else []
        for inner in [*_with_contents(doc, below), name]:
            if inner not in found:
                found.append(inner)
    return [name for name in found if name in set(names)]


def _remove(doc: Any, names: Iterable[str]) -> None:
    for name in names:
        if doc.getObject(name) is not None:
            doc.removeObject(name)


# ---------------------------------------------------------------------------------------------
# one solid of all beams
# ---------------------------------------------------------------------------------------------

#: The fused solid and the union of the beams may differ in volume by this part, measured along
#: the same rays through their triangles.
VOLUME_TOLERANCE = 0.01


def fused_feature(doc: Any, beams: Sequence[Any], top: Sequence[Any]) -> tuple[Any | None, str]:
    """A feature with all beams fused, or None; and what is to be said of it."""
    shapes = [s for b in beams for s in shape_of(b).Solids]
    shapes = shapes or [s for o in top if hasattr(o, "Shape") for s in o.Shape.Solids]
    fused, note = fuse(shapes)
    if fused is None:
        return None, note
    feature = doc.addObject("Part::Feature", "Fused")
    feature.Shape = fused
    if App.GuiUp:
        feature.ViewObject.Visibility = False
    return feature, note


def fuse(shapes: Sequence[Any]) -> tuple[Any | None, str]:
    """The union of solids, or None where OCCT does not find a sound one.

    ``isValid`` alone is not enough: OCCT has called a fuse valid that had lost nearly all of
    its volume.  The number of solids, the bounds of the volume and the volume of the union as
    measured on the triangles must agree as well.
    """
    if len(shapes) < 2:
        return None, "there is nothing to fuse"
    diagonal = Part.makeCompound(list(shapes)).BoundBox.DiagonalLength
    reason = ""
    # OCCT needs seconds for each freeform beam, so a large frame gets one try.
    for tolerance in (0.0, 1e-5 * diagonal) if len(shapes) <= 20 else (0.0,):
        try:
            fused = shapes[0].multiFuse(list(shapes[1:]), tolerance)
        except Part.OCCError as error:
            reason = str(error)
            continue
        reason = why_unsound(fused, shapes)
        if not reason:
            return fused, f"{len(shapes)} solids fused to one of {fused.Volume:.0f} mm^3"
    return None, f"the beams stay separate solids: OCCT cannot fuse them soundly ({reason})"


def why_unsound(fused: Any, shapes: Sequence[Any]) -> str:
    """What is wrong with a fused shape; "" if nothing."""
    if not fused.isValid():
        return "the fused shape is not valid"
    if len(fused.Solids) != 1:
        return f"the fused shape has {len(fused.Solids)} solids"
    volumes = [s.Volume for s in shapes]
    if not max(volumes) * (1 - VOLUME_TOLERANCE) <= fused.Volume:
        return f"its volume of {fused.Volume:.1f} mm^3 is below that of one beam"
    if fused.Volume > sum(volumes) * (1 + VOLUME_TOLERANCE):
        return f"its volume of {fused.Volume:.1f} mm^3 is above that of all beams"
    deviation = fused.BoundBox.DiagonalLength / 10000.0
    expected = union_volume([triangles_of_shape(s, deviation) for s in shapes])
    found = union_volume([triangles_of_shape(fused, deviation)])
    if abs(found - expected) > VOLUME_TOLERANCE * expected:
        return f"its volume is {found:.1f} mm^3 where the beams fill {expected:.1f} mm^3"
    return ""


# ---------------------------------------------------------------------------------------------
# all of it
# ---------------------------------------------------------------------------------------------


def find_program() -> str | None:
    """The program by preference, then ``$BEAMWRIGHT``, then PATH."""
    return bp.find_program(App.ParamGet(PREFERENCES).GetString("Executable", ""))


def remember_program(path: str) -> None:
    """Stores the program in the preferences."""
    App.ParamGet(PREFERENCES).SetString("Executable", path)


def keep_files(outputs: bp.Outputs, folder: str) -> list[str]:
    """Copies the files of a run to a folder of the user; returns where they are."""
    kept = []
    for path in br.kept_files(outputs.folder, outputs.stem):
        kept.append(str(shutil.copy(path, folder)))
    return kept


def reconstruct(
    doc: Any,
    source: Source,
    non_design: NonDesign | None = None,
    options: bp.Options | None = None,
    *,
    program: str = "",
    style: str = "",
    fuse: bool = False,
    keep: str = "",
    on_event: Callable[[Any], None] = lambda event: None,
) -> Inserted:
    """The macro without its panel.

    * ``program``: path of beamwright; "" looks it up
    * ``style``: ``SOLIDS``, ``COMPOUND`` or ``PREVIEW``; "" takes solids up to ``MANY_BEAMS``
    * ``keep``: a folder for copies of the files; "" keeps none

    Raises ``ProgramError``, ``InputError`` or ``ResultError``; the document is then as it was.
    """
    non_design = non_design or NonDesign()
    options = options or bp.Options()
    path = program or find_program()
    if not path:
        raise bp.ProgramError(bp.NOT_FOUND)
    found = bp.probe(path)
    if source.file:
        refusal = bp.refusal_of_input(found, source.file)
        if refusal:
            raise InputError(refusal)
    with tempfile.TemporaryDirectory(prefix="beamwright-") as folder:
        job = prepare(source, non_design, folder, options.unit)
        for note in job.notes:
            on_event(note)
        outputs = outputs_of(job, folder)
        arguments, left_out = bp.command(
            found, job.mesh, outputs, with_unit(options, job.unit), job.regions
        )
        if left_out:
            on_event(f"beamwright {found.version_text} has no {', '.join(left_out)}; left out")
        outcome = bp.run(found, arguments, on_event)
        if not outcome.ok:
            raise bp.ProgramError(outcome.message)
        if not style:
            style = SOLIDS if outcome.beams <= MANY_BEAMS else COMPOUND
        result = Result(
            source,
            outputs,
            outcome,
            found,
            style,
            fuse,
            unit=options.unit,
            chosen=options.chosen(),
            settings=settings_for(non_design, options),
        )
        inserted = insert_result(doc, result)
        if keep:
            inserted.notes += [f"kept {p}" for p in keep_files(outputs, keep)]
        return inserted


def outputs_of(job: Job, folder: str) -> bp.Outputs:
    """Where a run writes: a folder of its own below ``folder``, so that nothing is in the way."""
    below = Path(folder) / "out"
    below.mkdir(exist_ok=True)
    return bp.Outputs(str(below), job.stem)


def with_unit(options: bp.Options, unit: str) -> bp.Options:
    """The options with the unit of the file that is really handed over."""
    return replace(options, unit=unit)


def settings_for(non_design: NonDesign, options: bp.Options) -> dict[str, Any]:
    """What the next run on the same mesh starts from."""
    return {
        "mode": non_design.mode,
        "faces": non_design.faces,
        "objects": [o.Name for o in non_design.objects],
        "depth": non_design.depth,
        "profile": options.profile,
        "loft": options.loft,
        "joints": options.joints,
        "density": options.density,
        "max_deviation": options.max_deviation,
        "unit": options.unit,
        "strict": options.strict,
    }
