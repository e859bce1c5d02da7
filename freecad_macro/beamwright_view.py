# SPDX-License-Identifier: MIT OR Apache-2.0
"""What the macro does in the 3D view: picking flat faces of a mesh, showing a place."""

from __future__ import annotations

import contextlib
from typing import Any, Callable, Iterable, Sequence

import FreeCADGui as Gui
from beamwright_input import triangles_of
from beamwright_mesh import FlatRegions, Point, distance_to_triangle
from pivy import coin
from PySide import QtCore


class FacePicker:
    """Clicks on flat regions of meshes mark them red.

    Shift+click takes them away again; Ctrl+click goes no farther than what is marked reaches.

    ``faces`` holds the marked facets by the internal name of their mesh object.
    """

    def __init__(self, changed: Callable[[], None] = lambda: None) -> None:
        self.faces: dict[str, set[int]] = {}
        self._changed = changed
        self._regions: dict[str, FlatRegions] = {}
        self._objects: dict[str, Any] = {}
        self._view: Any = None
        self._callback: Any = None

    @property
    def is_active(self) -> bool:
        """Whether clicks go to the picker."""
        return self._view is not None

    @property
    def count(self) -> int:
        """Number of marked facets."""
        return sum(len(f) for f in self.faces.values())

    def set_objects(self, objects: Sequence[Any]) -> None:
        """The meshes whose faces can be picked; marks on others are forgotten."""
        self._objects = {o.Name: o for o in objects if o.isDerivedFrom("Mesh::Feature")}
        self._regions = {n: r for n, r in self._regions.items() if n in self._objects}
        self.faces = {n: f for n, f in self.faces.items() if n in self._objects}

    def start(self, view: Any) -> None:
        """Takes the left clicks in a view."""
        self.stop()
        Gui.Selection.clearSelection()
        self._view = view
        self._callback = view.addEventCallbackPivy(
            coin.SoMouseButtonEvent.getClassTypeId(), self._clicked
        )
        Gui.Selection.addObserver(self)
        self.paint()

    def stop(self) -> None:
        """Gives the clicks back; the marks stay."""
        if self._view is not None:
            Gui.Selection.removeObserver(self)
            # The view may have been closed.
            with contextlib.suppress(RuntimeError, ReferenceError):
                self._view.removeEventCallbackPivy(
                    coin.SoMouseButtonEvent.getClassTypeId(), self._callback
                )
        self._view = self._callback = None

    def clear(self) -> None:
        """Forgets all marks."""
        self.faces = {}
        self.paint()
        self._changed()

    def restore(self, faces: dict[str, list[int]]) -> None:
        """Takes over marks of an earlier run."""
        self.faces = {n: set(f) for n, f in faces.items() if n in self._objects}

    def paint(self) -> None:
        """Shows the marked facets red."""
        for name, obj in self._objects.items():
            obj.ViewObject.clearSelection()
            if self.faces.get(name):
                obj.ViewObject.setSelection(sorted(self.faces[name]))

    def unpaint(self) -> None:
        """Shows the meshes as they were."""
        for obj in self._objects.values():
            try:
                obj.ViewObject.clearSelection()
            except (RuntimeError, ReferenceError, AttributeError):
                continue  # the object has been deleted

    def pick(self, place: Point, take_away: bool = False, within: bool = False) -> bool:
        """Marks the flat region at a place in the document, mm; False if no mesh is there.

        * ``take_away``: takes the marks away instead
        * ``within``: the region ends where what is marked already ends
        """
        found = self._mesh_at(place)
        if found is None:
            return False
        name, facet = found
        marked = self.faces.setdefault(name, set())
        region = self._regions_of(name).around(facet, marked if within else None)
        if take_away:
            marked -= region
        else:
            marked |= region
        self.paint()
        self._changed()
        return True

    def _mesh_at(self, place: Point) -> tuple[str, int] | None:
        best, nearest = None, float("inf")
        for name in self._objects:
            mesh = self._regions_of(name).mesh
            facet = mesh.facet_at(place)
            if facet < 0:
                continue
            distance = distance_to_triangle(place, *(mesh.points[i] for i in mesh.facets[facet]))
            if distance < nearest:
                best, nearest = (name, facet), distance
        return best

    def _regions_of(self, name: str) -> FlatRegions:
        if name not in self._regions:
            self._regions[name] = FlatRegions(triangles_of(self._objects[name]))
        return self._regions[name]

    def _clicked(self, node: Any) -> None:
        event = node.getEvent()
        if event.getButton() != coin.SoMouseButtonEvent.BUTTON1:
            return
        info = self._view.getObjectInfo(tuple(event.getPosition().getValue()))
        if not info or self._of_info(info) is None:
            return
        node.setHandled()
        if event.getState() == coin.SoMouseButtonEvent.DOWN:
            place = (info["x"], info["y"], info["z"])
            self.pick(place, bool(event.wasShiftDown()), bool(event.wasCtrlDown()))

    def addSelection(self, doc: str, name: str, *_: Any) -> None:  # noqa: N802
        """What FreeCAD calls when the click has been let go: it selects the mesh nevertheless."""
        if name in self._objects:
            # All of the mesh would turn green, the marks with it.
            QtCore.QTimer.singleShot(0, Gui.Selection.clearSelection)

    def _of_info(self, info: dict[str, Any]) -> str | None:
        parts = [str(info.get("Object", "")), *str(info.get("Component", "")).split(".")]
        parts += [p for key in ("SubName", "ParentObject") for p in _words(info.get(key))]
        return next((name for name in self._objects if name in parts), None)


def _words(value: Any) -> list[str]:
    if value is None:
        return []
    return str(getattr(value, "Name", value)).split(".")


class Marker:
    """A red ball at a place in the 3D view, gone when ``clear`` is called."""

    def __init__(self) -> None:
        self._node: Any = None
        self._scene: Any = None

    @property
    def is_shown(self) -> bool:
        """Whether a ball is in a view."""
        return self._node is not None

    def show(self, view: Any, place: Point, size: float) -> None:
        """Puts the ball, of ``size`` mm, at a place and turns the camera to it."""
        self.clear()
        # Drawn over everything else: the place may be inside the part.
        self._node = coin.SoAnnotation()
        material = coin.SoMaterial()
        material.diffuseColor = (0.85, 0.05, 0.05)
        material.emissiveColor = (0.35, 0.0, 0.0)
        shift = coin.SoTranslation()
        shift.translation = tuple(place)
        ball = coin.SoSphere()
        ball.radius = size / 2.0
        for child in (material, shift, ball):
            self._node.addChild(child)
        self._scene = view.getSceneGraph()
        self._scene.addChild(self._node)
        zoom_to(view, place, 8.0 * size)

    def clear(self) -> None:
        """Takes the ball away."""
        if self._node is not None:
            # The view may have been closed.
            with contextlib.suppress(RuntimeError, ReferenceError):
                self._scene.removeChild(self._node)
        self._node = self._scene = None


def zoom_to(view: Any, place: Point, width: float) -> None:
    """Lets a cube of ``width`` mm about a place fill the view."""
    half = width / 2.0
    low, high = [c - half for c in place], [c + half for c in place]
    camera = view.getCameraNode()
    window = view.getSize()
    aspect = window[0] / max(window[1], 1)
    camera.viewBoundingBox(coin.SbBox3f(*low, *high), aspect, 1.0)


def extent(objects: Iterable[Any]) -> float:
    """Diagonal of the box about some objects, mm."""
    points: list[Point] = []
    for obj in objects:
        box = getattr(getattr(obj, "Mesh", None) or getattr(obj, "Shape", None), "BoundBox", None)
        if box is not None and box.isValid():
            points += [(box.XMin, box.YMin, box.ZMin), (box.XMax, box.YMax, box.ZMax)]
    if not points:
        return 100.0
    spans = [max(c) - min(c) for c in zip(*points)]
    return sum(s * s for s in spans) ** 0.5 or 100.0
