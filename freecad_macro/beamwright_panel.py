# SPDX-License-Identifier: MIT OR Apache-2.0
"""The task panel of the macro: choices in, progress and findings out."""

from __future__ import annotations

import re
import shutil
import tempfile
from typing import Any, Callable

import FreeCAD as App
import FreeCADGui as Gui
from beamwright_command import JOINTS, LOFTS, PROFILES, Options, Outputs, command_line
from beamwright_document import insert_result
from beamwright_group import find_group, settings_of
from beamwright_input import (
    FACES,
    FEM,
    LABELS,
    NONE,
    REGIONS,
    InputError,
    Job,
    NonDesign,
    Source,
    fem_constraints,
    is_mesh,
    prepare,
)
from beamwright_macro import (
    MANY_BEAMS,
    keep_files,
    outputs_of,
    preferred_program,
    remember_program,
    settings_for,
    with_unit,
)
from beamwright_mesh import is_non_design_name
from beamwright_outcome import CANCELLED, Outcome, Progress, beam_in
from beamwright_program import NOT_FOUND, Program, ProgramError, probe, refusal_of_input
from beamwright_report import ReportText
from beamwright_result import COMPOUND, PREVIEW, SOLIDS, Inserted, Result, ResultError
from beamwright_run import Run
from beamwright_step import mark_of
from beamwright_view import FacePicker, Marker, extent
from PySide import QtCore, QtGui

# Full names, so that the same lines work with PySide2 and PySide6.
CHECKED, UNCHECKED = QtCore.Qt.CheckState.Checked, QtCore.Qt.CheckState.Unchecked
USER = QtCore.Qt.ItemDataRole.UserRole

MODES = (
    (LABELS, "By name or label in the file"),
    (FACES, "Flat faces clicked in the view"),
    (REGIONS, "Selected solids or meshes"),
    (FEM, "Faces of FEM constraints"),
    (NONE, "None"),
)

_open_panel: Any = None


def show() -> Any:
    """Opens the panel for the active document; returns it, or None if another task is open."""
    global _open_panel
    if Gui.Control.activeDialog():
        QtGui.QMessageBox.information(
            Gui.getMainWindow(), "Beamwright", "Close the open task panel first."
        )
        return None
    if App.ActiveDocument is None:
        App.newDocument()
    _open_panel = Panel(App.ActiveDocument)
    Gui.Control.showDialog(_open_panel)
    return _open_panel


class Panel:
    """Task panel: ``form`` is what FreeCAD shows."""

    def __init__(self, doc: Any) -> None:
        self.doc = doc
        self.program: Program | None = None
        self.run: Run | None = None
        self.inserted: Inserted | None = None
        self.outcome: Outcome | None = None
        self._folder = ""
        self._job: Job | None = None
        self._outputs: Outputs | None = None
        self._source = Source()
        self._left_out: list[str] = []
        self._marker = Marker()
        self.picker = FacePicker(self._show_picked)
        self._build()
        self._make_narrow()
        self._fill_meshes()
        self._fill_fem()
        self._look_for_program()
        self._restore()
        self._mode_changed()

    # -- FreeCAD's side ------------------------------------------------------------------------

    def getStandardButtons(self) -> Any:  # noqa: N802
        """A button to close the panel; running and cancelling have their own."""
        close = QtGui.QDialogButtonBox.StandardButton.Close
        try:
            return int(close)
        except TypeError:
            return close.value

    def reject(self) -> bool:
        """Closes the panel; a run that is under way is killed and leaves nothing."""
        if self.run is not None:
            self.run.ended.disconnect()
            self.run.stop_at_once()
            self.run = None
        self._forget_files()
        self.picker.stop()
        self.picker.unpaint()
        self._marker.clear()
        Gui.Control.closeDialog()
        return True

    def accept(self) -> bool:
        """As ``reject``."""
        return self.reject()

    # -- the form ------------------------------------------------------------------------------

    def _build(self) -> None:
        self.form = QtGui.QWidget()
        self.form.setObjectName("BeamwrightPanel")
        self.form.setWindowTitle("Beamwright")
        layout = QtGui.QVBoxLayout(self.form)
        layout.setContentsMargins(4, 4, 4, 4)
        layout.addWidget(self._build_input())
        layout.addWidget(self._build_non_design())
        self.tabs = QtGui.QTabWidget()
        self.tabs.addTab(self._build_beams(), "Beams")
        self.tabs.addTab(self._build_result(), "Result")
        self.tabs.addTab(self._build_log(), "Log")
        layout.addWidget(self.tabs)
        layout.addLayout(self._build_run())
        layout.addStretch(1)

    def _make_narrow(self) -> None:
        """Lets the panel fit the width of FreeCAD's combo view."""
        policy = QtGui.QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon
        for box in self.form.findChildren(QtGui.QComboBox):
            box.setSizeAdjustPolicy(policy)
            box.setMinimumContentsLength(5)
        for kind in (QtGui.QListWidget, QtGui.QLineEdit, QtGui.QDoubleSpinBox, QtGui.QPushButton):
            for widget in self.form.findChildren(kind):
                widget.setMinimumWidth(40)
        for label in (self.program_text, self.message, self.pick_text, self.label_text):
            label.setMinimumWidth(60)
        self.log.setMinimumWidth(60)

    def _build_input(self) -> Any:
        box, grid = _group("Mesh")
        self.from_document = QtGui.QRadioButton("in the document")
        self.from_file = QtGui.QRadioButton("in a file")
        self.from_document.setChecked(True)
        self.meshes = QtGui.QListWidget()
        self.meshes.setMaximumHeight(60)
        self.file = QtGui.QLineEdit()
        self.file.setPlaceholderText("mesh file")
        browse = _small_button("…", self._browse_file)
        self.unit = QtGui.QComboBox()
        self.unit.addItems(["unit", "mm", "cm", "m", "in"])
        self.unit.setToolTip("Unit of length in the file; left alone: mm, and m for glTF")
        grid.addWidget(self.from_document, 0, 0)
        grid.addWidget(self.from_file, 0, 1, 1, 3)
        grid.addWidget(self.meshes, 1, 0, 1, 4)
        grid.addWidget(self.file, 2, 0, 1, 2)
        grid.addWidget(browse, 2, 2)
        grid.addWidget(self.unit, 2, 3)
        self.from_file.toggled.connect(self._input_changed)
        self.meshes.itemChanged.connect(self._input_changed)
        self.file.textChanged.connect(self._input_changed)
        self._file_row = (self.file, browse, self.unit)
        return box

    def _build_non_design(self) -> Any:
        box, grid = _group("Non-design faces")
        self.mode = QtGui.QComboBox()
        for mode, text in MODES:
            self.mode.addItem(text, mode)
        self.pages = QtGui.QStackedWidget()
        self.label_text = _text("")
        self.pick = QtGui.QPushButton("Pick")
        self.pick.setCheckable(True)
        self.pick.setToolTip("Click flat faces in the 3D view; Shift+click takes them away")
        clear = QtGui.QPushButton("Clear")
        self.pick_text = _text("")
        self.regions = QtGui.QListWidget()
        self.regions.setMaximumHeight(56)
        take = QtGui.QPushButton("Take the selection")
        self.constraints = QtGui.QListWidget()
        self.constraints.setMaximumHeight(56)
        self.depth = QtGui.QDoubleSpinBox()
        self.depth.setRange(0.0, 1e6)
        self.depth.setSuffix(" mm")
        self.depth.setToolTip("How far below the faces the material had to be kept")
        self.pages.addWidget(_page([self.label_text]))
        self.pages.addWidget(_page([_row([self.pick, clear]), self.pick_text]))
        self.pages.addWidget(_page([self.regions, take]))
        depth = _row([QtGui.QLabel("Depth kept below"), self.depth])
        self.pages.addWidget(_page([self.constraints, depth]))
        self.pages.addWidget(
            _page(
                [_text("Branches then start at the flat ends, or failing that at the free ends.")]
            )
        )
        grid.addWidget(self.mode, 0, 0)
        grid.addWidget(self.pages, 1, 0)
        self.mode.currentIndexChanged.connect(self._mode_changed)
        self.pick.toggled.connect(self._toggle_pick)
        clear.clicked.connect(self.picker.clear)
        take.clicked.connect(self.take_selection)
        return box

    def _build_beams(self) -> Any:
        box, grid = _tab()
        self.profile = QtGui.QComboBox()
        self.profile.setEditable(True)
        self.profile.setToolTip("Also catalogue:CHS,SHS for families of a catalogue")
        self.loft = QtGui.QComboBox()
        self.joints = QtGui.QComboBox()
        self.density = _number(0.0, 1e5, 0, " kg/m³")
        self.density.setToolTip("Steel 7850, aluminium 2700")
        self.deviation = _number(0.0, 100.0, 2, " radii")
        self.deviation.setToolTip(
            "Farthest a branch may bend away from one straight beam, in section radii"
        )
        self.strict = QtGui.QCheckBox("Strict: no result if a promise does not hold")
        rows = (
            ("Profile", self.profile),
            ("Loft", self.loft),
            ("Joints", self.joints),
            ("Density", self.density),
            ("Deviation", self.deviation),
        )
        for i, (name, widget) in enumerate(rows):
            grid.addWidget(QtGui.QLabel(name), i, 0)
            grid.addWidget(widget, i, 1)
        grid.addWidget(self.strict, len(rows), 0, 1, 2)
        grid.setColumnStretch(1, 1)
        return box

    def _build_result(self) -> Any:
        box, grid = _tab()
        self.fuse = QtGui.QCheckBox("One fused solid as well")
        self.fuse.setToolTip("Seconds for each freeform beam; FreeCAD waits for it")
        self.show_mesh = QtGui.QCheckBox("Show the mesh of the file")
        self.show_mesh.setChecked(True)
        self.keep = QtGui.QLineEdit()
        self.keep.setPlaceholderText("empty: keep none")
        self.keep.setToolTip("Folder for the STEP file, cut list and skeleton")
        grid.addWidget(self.fuse, 0, 0, 1, 3)
        grid.addWidget(self.show_mesh, 1, 0, 1, 3)
        grid.addWidget(QtGui.QLabel("Keep files in"), 2, 0)
        grid.addWidget(self.keep, 2, 1)
        grid.addWidget(_small_button("…", self._browse_keep), 2, 2)
        grid.setRowStretch(3, 1)
        return box

    def _build_log(self) -> Any:
        self.log = QtGui.QPlainTextEdit()
        self.log.setReadOnly(True)
        self.log.setMaximumBlockCount(2000)
        return self.log

    def _build_run(self) -> Any:
        layout = QtGui.QVBoxLayout()
        self.program_text = _text("")
        choose = _small_button("…", self.ask_for_program)
        choose.setToolTip("Choose the program beamwright")
        layout.addWidget(_row([self.program_text, choose], stretch=0))
        self.start_button = QtGui.QPushButton("Run")
        self.cancel_button = QtGui.QPushButton("Cancel")
        self.report_button = QtGui.QPushButton("Report")
        self.cancel_button.setEnabled(False)
        self.report_button.setEnabled(False)
        layout.addWidget(_row([self.start_button, self.cancel_button, self.report_button]))
        self.bar = QtGui.QProgressBar()
        self.bar.setRange(0, 1000)
        self.message = _text("")
        self.findings = QtGui.QListWidget()
        self.findings.setMinimumHeight(60)
        self.findings.setMaximumHeight(110)
        self.findings.setWordWrap(True)
        self.findings.setVisible(False)
        self.findings.setToolTip("Click: show the place in the 3D view")
        for widget in (self.bar, self.message, self.findings):
            layout.addWidget(widget)
        self.start_button.clicked.connect(self.start)
        self.cancel_button.clicked.connect(self.cancel)
        self.report_button.clicked.connect(self.open_report)
        self.findings.itemClicked.connect(self.show_finding)
        return layout

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
            self.program_text.setText("beamwright: not found; choose it with …")
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
            _choose(widget, settings.get(key) or "")
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
            profile=_chosen(self.profile),
            loft=_chosen(self.loft),
            joints=_chosen(self.joints),
            density=number(self.density, "--density"),
            max_deviation=number(self.deviation, "--max-deviation"),
            unit=self.unit.currentText() if self.unit.currentIndex() > 0 else "",
            strict=self.strict.isEnabled() and self.strict.isChecked(),
        )

    def _input_changed(self, *_: Any) -> None:
        of_file = self.from_file.isChecked()
        self.meshes.setVisible(not of_file)
        for widget in self._file_row:
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
        hint = "Click flat faces of the mesh; Shift+click takes them away."
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

    def ask_style(self, beams: int) -> str:
        """Asks how many beams are to be shown; "" takes the result back."""
        box = QtGui.QMessageBox(self.form)
        box.setWindowTitle("Beamwright")
        box.setText(
            f"{beams} beams: FreeCAD becomes slow with so many objects. How shall they be shown?"
        )
        role = QtGui.QMessageBox.ButtonRole
        buttons = {
            box.addButton("One compound", role.AcceptRole): COMPOUND,
            box.addButton("Mesh preview", role.AcceptRole): PREVIEW,
            box.addButton("All as objects", role.AcceptRole): SOLIDS,
            box.addButton("Cancel", role.RejectRole): "",
        }
        (box.exec_ if hasattr(box, "exec_") else box.exec)()
        return next((s for b, s in buttons.items() if b is box.clickedButton()), "")

    # -- the run -------------------------------------------------------------------------------

    def start(self, *_: Any) -> None:
        """Writes the input and starts the program."""
        if self.run is not None:
            return
        self._clear_messages()
        self.tabs.setCurrentWidget(self.log)
        if self.program is None and not self.ask_for_program():
            self._fail(self.program_text.text() or NOT_FOUND)
            return
        assert self.program is not None
        self._source = self.source()
        try:
            arguments = self._prepare(self.program)
        except (InputError, OSError) as error:
            self._forget_files()
            self._fail(str(error))
            return
        if self._left_out:
            self._say(f"left out, as this beamwright has none: {', '.join(self._left_out)}")
        self.run = Run(self.program, arguments, self.form)
        self.run.progressed.connect(self._progressed)
        self.run.said.connect(self._say)
        self.run.ended.connect(self._ended)
        self.start_button.setEnabled(False)
        self.cancel_button.setEnabled(True)
        self.run.start()

    def _prepare(self, program: Program) -> list[str]:
        if self._source.file:
            refusal = refusal_of_input(program, self._source.file)
            if refusal:
                raise InputError(refusal)
        self._folder = tempfile.mkdtemp(prefix="beamwright-")
        options = self.options()
        self._job = prepare(self._source, self.non_design(), self._folder, options.unit)
        for note in self._job.notes:
            self._say(note)
        self._outputs = outputs_of(self._job, self._folder)
        options = with_unit(options, self._job.unit)
        arguments, self._left_out = command_line(
            program, self._job.mesh, self._outputs, options, self._job.regions
        )
        return arguments

    def cancel(self, *_: Any) -> None:
        """Stops the program; the document stays as it is."""
        if self.run is not None:
            self.cancel_button.setEnabled(False)
            self.bar.setFormat("cancelling")
            self.run.cancel()

    def _progressed(self, progress: Progress) -> None:
        self.bar.setFormat(f"{progress.stage} %p %")
        self.bar.setValue(int(1000 * progress.fraction))

    def _ended(self, outcome: Outcome) -> None:
        run, self.run = self.run, None
        self.outcome = outcome
        try:
            if outcome.ok and self._is_open():
                self._take_in(outcome)
            else:
                self._fail(outcome.message or "the document was closed")
            self._list_findings(outcome)
        finally:
            self._forget_files()
            self.start_button.setEnabled(True)
            self.cancel_button.setEnabled(False)
            if run is not None:
                run.deleteLater()

    def _is_open(self) -> bool:
        # A closed document is a dead object whose attributes cannot be asked.
        return any(d is self.doc or d == self.doc for d in App.listDocuments().values())

    def _take_in(self, outcome: Outcome) -> None:
        style = SOLIDS
        if outcome.beams > MANY_BEAMS:
            style = self.ask_style(outcome.beams)
            if not style:
                self._fail(CANCELLED)
                return
        assert self._outputs is not None and self.program is not None
        self.bar.setFormat("taking in %p %")
        self.bar.setValue(980)
        QtGui.QApplication.setOverrideCursor(QtGui.QCursor(QtCore.Qt.CursorShape.WaitCursor))
        try:
            self.inserted = insert_result(self.doc, self._result(outcome, style))
            kept = self.keep.text().strip()
            if kept:
                for path in keep_files(self._outputs, kept):
                    self._say(f"kept {path}")
        except (ResultError, OSError) as error:
            self._fail(str(error))
            return
        finally:
            QtGui.QApplication.restoreOverrideCursor()
        self.bar.setFormat("done")
        self.bar.setValue(1000)
        self.report_button.setEnabled(True)
        for note in self.inserted.notes:
            self._say(note)
        self._say(str(ReportText.of(outcome.summary, self.program.version_text)))
        self.message.setText(f"<b>{outcome.beams} beams.</b> One undo takes all of it back.")
        self.picker.unpaint()

    def _result(self, outcome: Outcome, style: str) -> Result:
        assert self._outputs is not None and self.program is not None
        options = self.options()
        return Result(
            self._source,
            self._outputs,
            outcome,
            self.program,
            style,
            self.fuse.isChecked(),
            self.show_mesh.isChecked(),
            unit=options.unit,
            chosen=options.chosen(),
            settings=settings_for(self.non_design(), options),
        )

    def _forget_files(self) -> None:
        if self._folder:
            shutil.rmtree(self._folder, ignore_errors=True)
            self._folder = ""

    # -- what is said --------------------------------------------------------------------------

    def _clear_messages(self) -> None:
        self.log.clear()
        self.message.setText("")
        self.findings.clear()
        self.findings.setVisible(False)
        self._marker.clear()
        self.bar.setFormat("%p %")
        self.bar.setValue(0)

    def _say(self, line: str) -> None:
        self.log.appendPlainText(line.rstrip())

    def _fail(self, text: str) -> None:
        self.bar.setFormat("no result")
        self.bar.setValue(0)
        self._say(text)
        self.message.setText(f'<b style="color:#b00000">{_html(text)}</b>')
        App.Console.PrintError(f"Beamwright: {text}\n")

    def _list_findings(self, outcome: Outcome) -> None:
        for finding in outcome.findings:
            item = QtGui.QListWidgetItem(("BREACH: " if finding.breach else "") + finding.text)
            item.setData(USER, finding.text)
            if finding.breach:
                item.setForeground(QtGui.QBrush(QtGui.QColor(176, 0, 0)))
            self.findings.addItem(item)
        self.findings.setVisible(bool(outcome.findings))
        breach = next((i for i, f in enumerate(outcome.findings) if f.breach and f.place), None)
        if breach is not None and not outcome.ok:
            self.show_finding(self.findings.item(breach))

    def show_finding(self, item: Any) -> None:
        """Turns the camera to the place of a finding and selects the beam it is about."""
        row = self.findings.row(item)
        if self.outcome is None or row < 0 or row >= len(self.outcome.findings):
            return
        finding = self.outcome.findings[row]
        self.findings.setCurrentRow(row)
        Gui.Selection.clearSelection()
        beam = self._beam_of(finding.text)
        if beam is not None:
            Gui.Selection.addSelection(beam)
        view = self._view()
        if finding.place is not None and view is not None:
            shown = extent(self._source.objects or (self.inserted.beams if self.inserted else ()))
            self._marker.show(view, finding.place, shown / 30.0)

    def _beam_of(self, text: str) -> Any | None:
        number = beam_in(text)
        if number is None or self.inserted is None:
            return None
        marks = {mark_of(b.Label): b for b in self.inserted.beams}
        return next((b for m, b in marks.items() if int(re.sub(r"\D", "", m)) == number + 1), None)

    def open_report(self, *_: Any) -> None:
        """Opens the report of the run: the page it wrote, or the text in the document."""
        if self.inserted is None:
            return
        group = self.inserted.group
        if getattr(group, "Report", ""):
            QtGui.QDesktopServices.openUrl(QtCore.QUrl.fromLocalFile(group.Report))
            return
        text = next((o for o in group.Group if o.TypeId == "App::TextDocument"), None)
        if text is not None:
            text.ViewObject.doubleClicked()

    def _view(self) -> Any | None:
        gui = Gui.getDocument(self.doc.Name) if self._is_open() else None
        found = gui.mdiViewsOfType("Gui::View3DInventor") if gui is not None else []
        return found[0] if found else None


# ---------------------------------------------------------------------------------------------
# small widgets
# ---------------------------------------------------------------------------------------------


def _group(title: str) -> tuple[Any, Any]:
    box = QtGui.QGroupBox(title)
    grid = QtGui.QGridLayout(box)
    grid.setContentsMargins(6, 4, 6, 4)
    grid.setVerticalSpacing(3)
    return box, grid


def _tab() -> tuple[Any, Any]:
    page = QtGui.QWidget()
    grid = QtGui.QGridLayout(page)
    grid.setContentsMargins(6, 4, 6, 4)
    grid.setVerticalSpacing(3)
    return page, grid


def _page(widgets: list[Any]) -> Any:
    page = QtGui.QWidget()
    layout = QtGui.QVBoxLayout(page)
    layout.setContentsMargins(0, 0, 0, 0)
    for widget in widgets:
        layout.addWidget(widget)
    layout.addStretch(1)
    return page


def _row(widgets: list[Any], stretch: int | None = None) -> Any:
    row = QtGui.QWidget()
    layout = QtGui.QHBoxLayout(row)
    layout.setContentsMargins(0, 0, 0, 0)
    for i, widget in enumerate(widgets):
        layout.addWidget(widget, 1 if stretch in (None, i) else 0)
    return row


def _text(text: str) -> Any:
    label = QtGui.QLabel(text)
    label.setWordWrap(True)
    label.setTextInteractionFlags(QtCore.Qt.TextInteractionFlag.TextSelectableByMouse)
    return label


def _small_button(text: str, clicked: Callable[..., Any]) -> Any:
    button = QtGui.QToolButton()
    button.setText(text)
    button.clicked.connect(clicked)
    return button


def _number(low: float, high: float, digits: int, suffix: str) -> Any:
    box = QtGui.QDoubleSpinBox()
    box.setRange(low, high)
    box.setDecimals(digits)
    box.setSuffix(suffix)
    return box


def _chosen(box: Any) -> str:
    """What a choice says to the program: "" for its default."""
    if not box.isEnabled():
        return ""
    index = box.currentIndex()
    if index >= 0 and box.itemText(index) == box.currentText():
        return str(box.itemData(index) or "")
    return str(box.currentText().strip())


def _choose(box: Any, value: str) -> None:
    index = max(box.findData(value), box.findText(value)) if value else 0
    if index >= 0:
        box.setCurrentIndex(index)
    elif box.isEditable():
        box.setEditText(value)


def _html(text: str) -> str:
    return text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
