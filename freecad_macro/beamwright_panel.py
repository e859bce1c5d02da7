# SPDX-License-Identifier: MIT OR Apache-2.0
"""The task panel of the macro: choices in, progress and findings out."""

from __future__ import annotations

import re
import shutil
import tempfile
from typing import Any

import beamwright_macro
import FreeCAD as App
import FreeCADGui as Gui
from beamwright_choices import Choices
from beamwright_document import insert_result
from beamwright_form import USER
from beamwright_input import (
    InputError,
)
from beamwright_macro import (
    Ready,
    keep_files,
    make_ready,
    preferred_program,
)
from beamwright_outcome import CANCELLED, ERROR, Outcome, Progress, beam_in
from beamwright_program import NOT_FOUND, Program, is_executable
from beamwright_report import ReportText
from beamwright_result import COMPOUND, PREVIEW, SOLIDS, Inserted, ResultError
from beamwright_run import Run
from beamwright_step import mark_of
from beamwright_view import Marker, extent
from beamwright_widgets import html
from PySide import QtCore, QtGui

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
    # The dock has its new content only after FreeCAD's event loop has run.
    QtCore.QTimer.singleShot(0, _open_panel.widen_dock)
    return _open_panel


class Panel(Choices):
    """Task panel: ``form`` is what FreeCAD shows."""

    def __init__(self, doc: Any) -> None:
        super().__init__(doc)
        self.run: Run | None = None
        self.inserted: Inserted | None = None
        self.outcome: Outcome | None = None
        self._folder = ""
        self._ready: Ready | None = None
        self._marker = Marker()
        self.start_button.clicked.connect(self.start)
        self.cancel_button.clicked.connect(self.cancel)
        self.report_button.clicked.connect(self.open_report)
        self.findings.itemClicked.connect(self.show_finding)

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

    # -- the run -------------------------------------------------------------------------------

    def start(self, *_: Any) -> None:
        """Writes the input and starts the program."""
        if self.run is not None:
            return
        self._clear_messages()
        self.tabs.setCurrentWidget(self.log)
        if self.program is None and not self.ask_for_program():
            known = is_executable(preferred_program() or "")
            self._fail(self.program_text.text() if known else f"{NOT_FOUND}; choose it with …")
            return
        assert self.program is not None
        self._ready = None
        try:
            self._ready = self._make_ready(self.program)
        except (InputError, OSError) as error:
            self._forget_files()
            self._fail(str(error))
            return
        for note in self._ready.notes:
            self._say(note)
        self.run = Run(self.program, self._ready.arguments, self.form)
        self.run.progressed.connect(self._progressed)
        self.run.said.connect(self._say)
        self.run.ended.connect(self._ended)
        self.start_button.setEnabled(False)
        self.cancel_button.setEnabled(True)
        self.run.start()

    def _make_ready(self, program: Program) -> Ready:
        self._folder = tempfile.mkdtemp(prefix="beamwright-")
        source, non_design, options = self.source(), self.non_design(), self.options()
        return make_ready(program, source, non_design, options, self._folder)

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
                self._fail(self._in_words(outcome.message) or "the document was closed")
            self._list_findings(outcome)
        finally:
            self._forget_files()
            self.start_button.setEnabled(True)
            self.cancel_button.setEnabled(False)
            if run is not None:
                run.deleteLater()

    def _take_in(self, outcome: Outcome) -> None:
        style = SOLIDS
        if outcome.beams > beamwright_macro.MANY_BEAMS:
            style = self.ask_style(outcome.beams)
            if not style:
                self._fail(CANCELLED)
                return
        assert self._ready is not None
        self.bar.setFormat("taking in %p %")
        self.bar.setValue(980)
        QtGui.QApplication.setOverrideCursor(QtGui.QCursor(QtCore.Qt.CursorShape.WaitCursor))
        try:
            result = self._ready.result(
                outcome,
                style,
                fuse=self.fuse.isChecked(),
                show_mesh=self.show_mesh.isChecked(),
            )
            self.inserted = insert_result(self.doc, result)
            kept = self.keep.text().strip()
            if kept:
                for path in keep_files(self._ready.outputs, kept):
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
        self._say(str(ReportText.of(outcome.summary, self._ready.program.version_text)))
        self.message.setText(f"<b>{outcome.beams} beams.</b> One undo takes all of it back.")
        self.picker.unpaint()

    def _forget_files(self) -> None:
        if self._folder:
            shutil.rmtree(self._folder, ignore_errors=True)
            self._folder = ""

    def _clear_messages(self) -> None:
        self.log.clear()
        self.message.setText("")
        self.findings.clear()
        self.findings.setVisible(False)
        self._marker.clear()
        self.bar.setFormat("%p %")
        self.bar.setValue(0)

    def _say(self, line: str) -> None:
        self.log.appendPlainText(self._in_words(line.rstrip()))

    def _fail(self, text: str) -> None:
        self.bar.setFormat("no result")
        self.bar.setValue(0)
        if not self.log.toPlainText().endswith(text):
            self._say(text)
        self.message.setText(f'<b style="color:#b00000">{html(text)}</b>')
        # As an error it would bring up the report view, which takes the panel's room.
        App.Console.PrintMessage(f"Beamwright: {text}\n")

    def _in_words(self, message: str) -> str:
        return self._ready.job.in_words(message) if self._ready is not None else message

    def _list_findings(self, outcome: Outcome) -> None:
        for finding in outcome.findings:
            kind = "BREACH: " if finding.breach and finding.kind != ERROR else ""
            item = QtGui.QListWidgetItem(kind + self._in_words(finding.text))
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
            objects = self._ready.source.objects if self._ready else ()
            shown = extent(objects or (self.inserted.beams if self.inserted else ()))
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
