# SPDX-License-Identifier: MIT OR Apache-2.0
"""From a FreeCAD document to the files of a run: mesh objects or a file, and what is non-design.

``prepare`` writes them; all lengths are in mm.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Sequence

import FreeCAD as App
import Mesh
import MeshPart
from beamwright_mesh import (
    TOUCH,
    Triangles,
    file_stem,
    is_non_design_name,
    near_surface,
    write_ply,
)

#: Meshes that ``Mesh.Mesh`` reads, so that they can be shown beside the beams.
SHOWN_MESHES = (".off", ".obj", ".ply", ".stl")

MILLIMETRES = {"mm": 1.0, "cm": 10.0, "m": 1000.0, "in": 25.4}

# Where non-design comes from.
LABELS, FACES, REGIONS, FEM, NONE = "labels", "faces", "regions", "fem", "none"


class InputError(Exception):
    """What was chosen cannot be used; the text says why and what to do."""


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
    is_temporary: bool = True
    notes: list[str] = field(default_factory=list)

    def in_words(self, message: str) -> str:
        """A message of the program, with the name of the mesh for a file the user never saw."""
        return message.replace(self.mesh, Path(self.mesh).stem) if self.is_temporary else message


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
        job.mesh, job.unit, job.is_temporary = source.file, unit, False
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
        job.notes.append(f"non-design: {len(job.regions)} of the regions, as closed bodies")
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
