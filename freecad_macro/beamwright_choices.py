# SPDX-License-Identifier: MIT OR Apache-2.0
"""What there is to choose from in the task panel, and what was chosen."""

from __future__ import annotations

from typing import Any

import FreeCAD as App
import FreeCADGui as Gui
from beamwright_command import JOINTS, LOFTS, PROFILES, Options
from beamwright_form import CHECKED, UNCHECKED, USER, Form
from beamwright_group import find_group, settings_of
from beamwright_input import (
    FACES,
    FEM,
    LABELS,
    REGIONS,
    NonDesign,
    Source,
    fem_constraints,
    is_mesh,
)
from beamwright_macro import (
    preferred_program,
    remember_program,
)
from beamwright_mesh import is_non_design_name
from beamwright_program import Program, ProgramError, probe
from beamwright_view import FacePicker
from beamwright_widgets import choose_in, chosen_of
from PySide import QtGui


class Choices(Form):
    """The panel up to the press of Run."""

    def __init__(self, doc: Any) -> None:
        super().__init__()
        self.doc = doc
        self.program: Program | None = None
        self.picker = FacePicker(self._show_picked)
        self._connect_choices()
        self._fill_meshes()
        self._fill_fem()
        self._look_for_program()
        self._restore()
        self._mode_changed()

    def _connect_choices(self) -> None:
        self.from_file.toggled.connect(self._input_changed)
        self.meshes.itemChanged.connect(self._input_changed)
        self.file.textChanged.connect(self._input_changed)
        self.browse.clicked.connect(self._browse_file)
        self.mode.currentIndexChanged.connect(self._mode_changed)
        self.pick.toggled.connect(self._toggle_pick)
        self.clear.clicked.connect(self.picker.clear)
        self.take.clicked.connect(self.take_selection)
        self.browse_keep.clicked.connect(self._browse_keep)
        self.choose.clicked.connect(self.ask_for_program)

    # -- what there is to choose from ----------------------------------------------------------

    def _fill_meshes(self) -> None:
        selected = {o.Name for o in Gui.Selection.getSelection(self.doc.Name)}
        objects = [o for o in self.doc.Objects if is_mesh(o) and not self._is_ours(o)]
        wanted = [o for o in objects if o.Name in selected] or objects
        self.meshes.blockSignals(True)
        for obj in objects:
            item = QtGui.QListWidgetItem(obj.Label)
            item.setData(USER, obj.Name)
            item.setCheckState(CHECKED if obj in wanted else UNCHECKED)
            self.meshes.addItem(item)
        self.meshes.blockSignals(False)
        if not objects:
            self.from_file.setChecked(True)
        self._input_changed()

    def _is_ours(self, obj: Any) -> bool:
        """Whether an earlier run made an object."""
        made = (getattr(o, "BeamwrightObjects", ()) for o in self.doc.Objects)
        return any(obj.Name in names for names in made)

    def _fill_fem(self) -> None:
        for obj in fem_constraints(self.doc):
            item = QtGui.QListWidgetItem(obj.Label)
            item.setData(USER, obj.Name)
            item.setCheckState(CHECKED)
            self.constraints.addItem(item)

    def _checked(self, widget: Any) -> list[Any]:
        items = [widget.item(i) for i in range(widget.count())]
        objects = [self.doc.getObject(i.data(USER)) for i in items if i.checkState() == CHECKED]
        return [o for o in objects if o is not None]

    def _look_for_program(self) -> None:
        self.set_program(preferred_program() or "", remember=False)

    def set_program(self, path: str, remember: bool = True) -> bool:
        """Takes a program, if it is one; its flags decide what can be chosen."""
        self.program = None
        if not path:
            self.program_text.setText("beamwright: not found")
        else:
            try:
                self.program = probe(path)
            except ProgramError as error:
                self.program_text.setText(str(error))
        if self.program is not None:
            self.program_text.setText(f"beamwright {self.program.version_text}")
            self.program_text.setToolTip(self.program.path)
            if remember:
                remember_program(path)
        self._offer_choices()
        return self.program is not None

    def _offer_choices(self) -> None:
        rows = (
            (self.profile, "--profile", PROFILES),
            (self.loft, "--loft", LOFTS),
            (self.joints, "--joints", JOINTS),
            (self.density, "--density", ()),
            (self.deviation, "--max-deviation", ()),
            (self.strict, "--strict", ()),
        )
        for widget, flag, otherwise in rows:
            known = self.program is not None and self.program.knows(flag)
            widget.setEnabled(known)
            if not known and self.program is not None:
                widget.setToolTip(f"beamwright {self.program.version_text} has no {flag}")
            default = self.program.defaults.get(flag, "") if self.program else ""
            if isinstance(widget, QtGui.QComboBox):
                chosen = self.program.choices.get(flag, otherwise) if self.program else otherwise
                widget.clear()
                widget.addItem(f"default ({default})" if default else "default", "")
                for choice in chosen:
                    widget.addItem(choice, choice)
            elif isinstance(widget, QtGui.QDoubleSpinBox):
                try:
                    widget.setValue(float(default))
                except ValueError:
                    continue

    def _restore(self) -> None:
        """Starts from the settings of the last run on the same mesh."""
        group = find_group(self.doc, self.source())
        if group is None:
            if self.constraints.count() and not self._has_named_parts():
                self._set_mode(FEM)
            return
        settings = settings_of(group)
        self._set_mode(settings.get("mode", LABELS))
        self.picker.restore(settings.get("faces") or {})
        for name in settings.get("objects") or ():
            if settings.get("mode") == REGIONS and self.doc.getObject(name):
                self._add_region(self.doc.getObject(name))
        for widget, key in (
            (self.density, "density"),
            (self.deviation, "max_deviation"),
            (self.depth, "depth"),
        ):
            if settings.get(key) is not None:
                widget.setValue(settings[key])
        for widget, key in (
            (self.profile, "profile"),
            (self.loft, "loft"),
            (self.joints, "joints"),
            (self.unit, "unit"),
        ):
            choose_in(widget, settings.get(key) or "")
        self.strict.setChecked(bool(settings.get("strict")))
        self._show_picked()

    def _set_mode(self, mode: str) -> None:
        self.mode.setCurrentIndex(max(self.mode.findData(mode), 0))

    def _has_named_parts(self) -> bool:
        return any(is_non_design_name(o.Label) for o in self._checked(self.meshes))

    # -- what was chosen -----------------------------------------------------------------------

    def source(self) -> Source:
        """The mesh that is chosen."""
        if self.from_file.isChecked():
            return Source(file=self.file.text().strip())
        return Source(objects=self._checked(self.meshes))

    def non_design(self) -> NonDesign:
        """What is chosen as non-design."""
        mode = self.mode.itemData(self.mode.currentIndex())
        objects: list[Any] = []
        if mode == REGIONS:
            objects = self._regions()
        elif mode == FEM:
            objects = self._checked(self.constraints)
        faces: dict[str, list[int]] = {}
        if mode == FACES:
            faces = {n: sorted(f) for n, f in self.picker.faces.items() if f}
        return NonDesign(mode, faces, objects, self.depth.value())

    def options(self) -> Options:
        """The options that differ from the program's own defaults."""
        defaults = self.program.defaults if self.program else {}

        def number(widget: Any, flag: str) -> float | None:
            value = float(widget.value())
            untouched = not widget.isEnabled() or f"{value:g}" == defaults.get(flag, "")
            return None if untouched else value

        return Options(
            profile=chosen_of(self.profile),
            loft=chosen_of(self.loft),
            joints=chosen_of(self.joints),
            density=number(self.density, "--density"),
            max_deviation=number(self.deviation, "--max-deviation"),
            unit=self.unit.currentText() if self.unit.currentIndex() > 0 else "",
            strict=self.strict.isEnabled() and self.strict.isChecked(),
        )

    def _input_changed(self, *_: Any) -> None:
        of_file = self.from_file.isChecked()
        self.meshes.setVisible(not of_file)
        for widget in (self.file, self.browse, self.unit):
            widget.setVisible(of_file)
        objects = [] if of_file else self._checked(self.meshes)
        self.picker.set_objects(objects)
        named = [o.Label for o in objects if is_non_design_name(o.Label)]
        if of_file:
            text = "Labels in the file count: groups, selection flags, red faces."
        elif named:
            text = "Non-design: " + ", ".join(named)
        else:
            text = "No chosen mesh is named non_design, fixed or keep."
        self.label_text.setText(text)
        self._show_picked()

    def _mode_changed(self, *_: Any) -> None:
        self.pages.setCurrentIndex(self.mode.currentIndex())
        picking = self.mode.itemData(self.mode.currentIndex()) == FACES
        if not picking:
            self.pick.setChecked(False)
            self.picker.unpaint()
        else:
            self.picker.paint()

    def _show_picked(self) -> None:
        count = self.picker.count
        hint = "Click flat faces; Shift takes them away, Ctrl stops at what is marked."
        self.pick_text.setText(f"{count} facets marked. {hint}" if count else hint)

    def _toggle_pick(self, on: bool) -> None:
        view = self._view()
        if on and view is not None:
            self.picker.start(view)
        else:
            self.picker.stop()

    def take_selection(self) -> None:
        """Takes the selected objects as regions in place of those taken before."""
        self.regions.clear()
        for obj in Gui.Selection.getSelection(self.doc.Name):
            if is_mesh(obj) or hasattr(obj, "Shape"):
                self._add_region(obj)

    def _add_region(self, obj: Any) -> None:
        item = QtGui.QListWidgetItem(obj.Label)
        item.setData(USER, obj.Name)
        self.regions.addItem(item)

    def _regions(self) -> list[Any]:
        names = [self.regions.item(i).data(USER) for i in range(self.regions.count())]
        return [o for o in (self.doc.getObject(n) for n in names) if o is not None]

    # -- questions -----------------------------------------------------------------------------

    def _browse_file(self) -> None:
        formats = self.program.formats if self.program else ()
        known = " ".join(f"*{e} *{e.upper()}" for e in formats) or "*"
        path, _ = QtGui.QFileDialog.getOpenFileName(
            self.form, "Mesh file", self.file.text(), f"Meshes ({known});;All files (*)"
        )
        if path:
            self.file.setText(path)

    def _browse_keep(self) -> None:
        path = QtGui.QFileDialog.getExistingDirectory(self.form, "Folder for the files")
        if path:
            self.keep.setText(path)

    def ask_for_program(self, *_: Any) -> bool:
        """Asks where the program is and remembers it."""
        path, _ = QtGui.QFileDialog.getOpenFileName(self.form, "Where is beamwright?")
        return bool(path) and self.set_program(path)

    # -- the document --------------------------------------------------------------------------

    def _is_open(self) -> bool:
        # A closed document is a dead object whose attributes cannot be asked.
        return any(d is self.doc or d == self.doc for d in App.listDocuments().values())

    def _view(self) -> Any | None:
        gui = Gui.getDocument(self.doc.Name) if self._is_open() else None
        found = gui.mdiViewsOfType("Gui::View3DInventor") if gui is not None else []
        return found[0] if found else None
