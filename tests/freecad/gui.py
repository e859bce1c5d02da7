"""The macro in FreeCAD's window: the panel is used as a user would, a picture of each step."""

from __future__ import annotations

import functools
import os
import time
from pathlib import Path
from typing import Any, Callable

import beamwright_macro
import beamwright_panel
import FreeCAD as App
import FreeCADGui as Gui
import Mesh
from beamwright_input import FACES, FEM, NONE, is_mesh, triangles_of
from beamwright_result import COMPOUND, PREVIEW
from PySide import QtCore, QtGui
from scene import (
    ARTEFACTS,
    MACRO,
    PROGRAM,
    SAMPLES,
    document,
    equal,
    main,
    names,
    say,
    stand_in,
    temporary_folders,
)

#: Seconds to wait for something that should come at once on any machine.
PATIENCE = 60.0

#: Longest gap between two ticks of a timer of 10 Hz, seconds: a few ticks may be missed on a
#: machine that is busy with other things.
LONGEST_GAP = 0.8

#: Pictures that are kept smaller for the README, with their names in freecad_macro/pictures.
FOR_README = {
    "2-running": "running",
    "4-beams-on-mesh": "beams",
    "6-cut-list": "cut_list",
    "9-open-mesh": "failure",
    "11-picked-faces": "picked_faces",
}

SMOOTH = QtCore.Qt.TransformationMode.SmoothTransformation
CONTAINS = QtCore.Qt.MatchFlag.MatchContains
RECURSIVE = QtCore.Qt.MatchFlag.MatchRecursive

#: Two seconds of progress, then the real run: long enough to look at.
SLOWLY = """
for done in 1 2 3 4 5 6 7 8; do
    echo '{"stage":"skeleton","done":'$done',"total":10}' >&2; sleep 0.25
done
exec "$REAL" "$@"
"""

#: A run without an end.
NEVER = """
echo '{"stage":"skeleton","done":1,"total":3}' >&2
echo "marching" >&2
exec sleep 600
"""

#: A run that keeps no promise, with its place as the program gives it.
BREACH = """
cat <<'JSON'
{"findings": [{"kind": "points-outside", "breach": true, "place": [42.9, 25.6, 25.05],
"text": "B001 leaves the material over 2.1 mm; give --max-deviation a smaller number"}]}
JSON
echo "error: a promise does not hold: B001 leaves the material over 2.1 mm" >&2
exit 3
"""


# -- the hands and eyes of the test ----------------------------------------------------------------


def spin(seconds: float) -> None:
    """Lets FreeCAD's event loop run."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        QtGui.QApplication.processEvents(QtCore.QEventLoop.ProcessEventsFlag.AllEvents, 20)
        time.sleep(0.005)


def wait_for(condition: Callable[[], bool], what: str) -> None:
    """Lets the event loop run until something holds; fails when it never does."""
    end = time.monotonic() + PATIENCE
    while not condition():
        if time.monotonic() > end:
            picture("stuck")
            raise AssertionError(f"waited {PATIENCE:.0f} s for {what}")
        spin(0.02)


def picture(name: str) -> None:
    """A picture of the whole screen, kept as an artefact."""
    spin(0.3)
    shot = QtGui.QApplication.primaryScreen().grabWindow(0)
    equal(shot.save(str(ARTEFACTS / f"{name}.png")), True, f"{name}.png is written")
    if name in FOR_README:
        small = shot.toImage().scaledToWidth(900, SMOOTH)
        small.save(str(ARTEFACTS / "readme" / f"{FOR_README[name]}.png"))


def open_panel(doc: Any, program: str = PROGRAM) -> Any:
    """Starts the macro file as FreeCAD does, in a document that is looked at from an angle."""
    os.environ["BEAMWRIGHT"] = program
    Gui.ActiveDocument.ActiveView.viewIsometric()
    Gui.SendMsgToActiveView("ViewFit")
    path = MACRO / "Beamwright.FCMacro"
    exec(compile(path.read_text(), str(path), "exec"), {"__file__": str(path)})
    panel = beamwright_panel._open_panel
    equal(panel.doc.Name, doc.Name, "document of the panel")
    spin(0.2)
    return panel


def close(panel: Any) -> None:
    """Closes the panel as its button does."""
    panel.reject()
    wait_for(lambda: not Gui.Control.activeDialog(), "the panel to close")


def finish(panel: Any) -> None:
    """Presses Run and waits for the end."""
    panel.start_button.click()
    wait_for(lambda: panel.run is None, "the end of the run")
    spin(0.2)


def answer(press: Callable[[Any], None]) -> None:
    """Does something to the next dialog that comes up."""

    def look() -> None:
        dialog = QtGui.QApplication.activeModalWidget()
        if dialog is None:
            QtCore.QTimer.singleShot(50, look)
        else:
            press(dialog)

    QtCore.QTimer.singleShot(50, look)


def mesh_object(doc: Any, label: str = "design") -> Any:
    """The mesh of a document with a label."""
    return next(o for o in doc.Objects if is_mesh(o) and o.Label == label)


# -- start, run, undo, run again -------------------------------------------------------------------


def a_run_fills_the_document_while_the_window_stays_awake() -> None:
    doc = document("cantilever.obj")
    before = names(doc)
    panel = open_panel(doc, stand_in("slowly", SLOWLY))
    picture("1-start")
    equal(panel.label_text.text(), "Non-design: non_design", "what is said of the labels")
    ticks: list[float] = []
    timer = QtCore.QTimer()
    timer.timeout.connect(lambda: ticks.append(time.monotonic()))
    timer.start(100)
    panel.start_button.click()
    wait_for(lambda: panel.bar.value() > 500, "progress")
    timer.stop()
    picture("2-running")
    gaps = [b - a for a, b in zip(ticks, ticks[1:])]
    say(f"       {len(ticks)} ticks while the program runs, longest gap {max(gaps):.2f} s")
    equal(max(gaps) < LONGEST_GAP, True, f"gap of {max(gaps):.2f} s between ticks of 0.1 s")
    wait_for(lambda: panel.run is None, "the end of the run")
    equal(panel.outcome.ok, True, panel.outcome.message)
    equal(len(panel.inserted.beams), panel.outcome.beams, "beams")
    picture("3-result")
    close(panel)
    show_alone(doc)
    picture("4-beams-on-mesh")
    doc.undo()
    spin(0.2)
    equal(names(doc), before, "objects after one undo")
    picture("5-undone")
    equal(temporary_folders(), set(), "folders left behind")


def show_alone(doc: Any) -> None:
    """Fits the view to the result once the panel is gone, the tree unfolded."""
    group = next(o for o in doc.Objects if "BeamwrightSource" in o.PropertiesList)
    Gui.Selection.addSelection(group)
    Gui.SendMsgToActiveView("ViewSelection")
    Gui.Selection.clearSelection()
    for tree in Gui.getMainWindow().findChildren(QtGui.QTreeWidget):
        for _ in range(4):  # what is inside comes up only when the outside is unfolded
            tree.expandAll()
            spin(0.1)
        for item in tree.findItems("Origin", CONTAINS | RECURSIVE):
            item.setExpanded(False)
        tree.header().resizeSections(QtGui.QHeaderView.ResizeMode.ResizeToContents)
    equal(bool(group.Group), True, "objects in the group")


def the_cut_list_opens_as_a_sheet() -> None:
    doc = document("cantilever.obj")
    panel = open_panel(doc)
    finish(panel)
    sheet = next(o for o in panel.inserted.group.Group if o.TypeId == "Spreadsheet::Sheet")
    close(panel)
    sheet.ViewObject.doubleClicked()
    picture("6-cut-list")


def a_second_run_starts_from_the_settings_of_the_first_and_replaces_it() -> None:
    doc = document("y_form.obj")
    panel = open_panel(doc)
    panel.profile.setCurrentIndex(panel.profile.findData("round"))
    finish(panel)
    count = len(doc.Objects)
    close(panel)
    panel = open_panel(doc)
    equal(panel.options().profile, "round", "profile restored")
    panel.profile.setCurrentIndex(0)
    finish(panel)
    equal(len(doc.Objects), count, "objects after the second run")
    close(panel)


# -- cancel, failure, missing program --------------------------------------------------------------


def cancel_kills_the_program_and_leaves_nothing() -> None:
    doc = document("cantilever.obj")
    before = names(doc)
    panel = open_panel(doc, stand_in("never", NEVER))
    panel.start_button.click()
    wait_for(lambda: panel.bar.value() > 0, "progress")
    panel.cancel_button.click()
    wait_for(lambda: panel.run is None, "the end of the run")
    picture("7-cancelled")
    equal("cancelled" in panel.message.text(), True, panel.message.text())
    equal(names(doc), before, "objects")
    equal(doc.UndoNames, [], "undo steps")
    panel.start_button.click()
    wait_for(lambda: panel.bar.value() > 0, "progress")
    close(panel)
    equal(names(doc), before, "objects after closing the panel")
    equal(temporary_folders(), set(), "folders left behind")


def a_breach_is_told_and_shown_where_it_is() -> None:
    doc = document("cantilever.obj")
    before = names(doc)
    panel = open_panel(doc, stand_in("breach", BREACH))
    panel.strict.setChecked(True)
    finish(panel)
    picture("8-breach")
    equal("B001 leaves the material" in panel.message.text(), True, panel.message.text())
    equal(panel.findings.count(), 1, "findings")
    equal(panel._marker.is_shown, True, "the place is marked")
    focus = Gui.ActiveDocument.ActiveView.getCameraNode().focalDistance.getValue()
    equal(focus < 200.0, True, "the camera came near")
    equal(names(doc), before, "objects")
    close(panel)


def an_open_mesh_is_refused_in_the_words_of_the_program() -> None:
    doc = document()
    mesh = Mesh.Mesh(str(SAMPLES / "single_bar.obj"))
    mesh.removeFacets(list(range(mesh.CountFacets // 3)))
    doc.addObject("Mesh::Feature", "Open").Mesh = mesh
    before = names(doc)
    panel = open_panel(doc)
    finish(panel)
    picture("9-open-mesh")
    equal(
        "cannot use Open: the surface is open" in panel.message.text(), True, panel.message.text()
    )
    equal("/" in panel.log.toPlainText(), False, "paths in the log")
    equal(panel._marker.is_shown, True, "the first border edge is marked")
    equal(names(doc), before, "objects")
    close(panel)


def a_missing_program_is_asked_for_and_remembered() -> None:
    doc = document("y_form.obj")
    before = names(doc)
    path = os.environ["PATH"]
    os.environ["PATH"] = "/nowhere"
    try:
        panel = open_panel(doc, "")
    finally:
        os.environ["PATH"] = path
    answer(lambda dialog: dialog.reject())
    panel.start_button.click()
    spin(0.2)
    picture("10-missing-program")
    equal("not found" in panel.message.text(), True, panel.message.text())
    equal(names(doc), before, "objects")
    panel.set_program(PROGRAM)
    settings = App.ParamGet("User parameter:BaseApp/Preferences/Mod/Beamwright")
    equal(settings.GetString("Executable", ""), PROGRAM, "the program is remembered")
    finish(panel)
    equal(panel.outcome.ok, True, panel.outcome.message)
    settings.RemString("Executable")
    close(panel)


# -- faces -----------------------------------------------------------------------------------------


def clicks_mark_flat_faces_red() -> None:
    doc = document("cantilever.obj")
    doc.removeObject(mesh_object(doc, "non_design").Name)
    whole = Mesh.Mesh()
    for label in ("design", "non_design"):
        whole.addMesh(Mesh.Mesh(part_of(SAMPLES / "cantilever.obj", label)))
    whole.removeDuplicatedPoints()
    design = mesh_object(doc)
    design.Mesh = whole
    panel = open_panel(doc)
    panel.mode.setCurrentIndex(panel.mode.findData(FACES))
    panel.pick.setChecked(True)
    view = Gui.ActiveDocument.ActiveView
    view.viewLeft()
    Gui.SendMsgToActiveView("ViewFit")
    spin(0.3)
    box = design.Mesh.BoundBox
    click(view, App.Vector(box.XMin, box.Center.y, box.Center.z))
    equal(panel.picker.count > 100, True, f"{panel.picker.count} facets are marked")
    triangles = triangles_of(design)
    off = [
        f
        for f in panel.picker.faces[design.Name]
        if any(abs(triangles.points[p][0] - box.XMin) > 1e-3 for p in triangles.facets[f])
    ]
    equal(off, [], "marked facets off the plane")
    equal(Gui.Selection.getSelection(), [], "the mesh is not selected, which would turn it green")
    view.setViewDirection((1.0, 0.8, -0.6))
    Gui.SendMsgToActiveView("ViewFit")
    picture("11-picked-faces")
    view.viewLeft()
    Gui.SendMsgToActiveView("ViewFit")
    spin(0.3)
    place = App.Vector(box.XMin, box.Center.y, box.Center.z)
    click(view, place, QtCore.Qt.KeyboardModifier.ShiftModifier)
    equal(panel.picker.count, 0, "facets marked after Shift+click")
    close(panel)


def part_of(path: Path, group: str) -> str:
    """One group of an OBJ file as a file of its own."""
    kept, keep = [], True
    for line in path.read_text().splitlines():
        if line.startswith("g "):
            keep = line[2:].strip() == group
        if keep or line.startswith("v "):
            kept.append(line)
    target = ARTEFACTS / f"{group}.obj"
    target.write_text("\n".join(kept) + "\n")
    return str(target)


def click(view: Any, place: Any, modifier: Any = None) -> None:
    """A left click on a place of the document, through the window system's events."""
    modifier = modifier or QtCore.Qt.KeyboardModifier.NoModifier
    x, y = view.getPointOnScreen(place)
    window = next(
        w
        for w in Gui.getMainWindow().findChildren(QtGui.QAbstractScrollArea)
        if w.metaObject().className().startswith("SIM::Coin3D::Quarter")
        or w.metaObject().className() == "Gui::View3DInventorViewer"
    )
    target = window.viewport()
    at = QtCore.QPointF(x, view.getSize()[1] - 1 - y)
    left = QtCore.Qt.MouseButton.LeftButton
    none = QtCore.Qt.MouseButton.NoButton
    kinds = QtCore.QEvent.Type
    for kind, button, buttons in (
        (kinds.MouseMove, none, none),
        (kinds.MouseButtonPress, left, left),
        (kinds.MouseButtonRelease, left, none),
    ):
        where = target.mapToGlobal(at.toPoint())
        event = QtGui.QMouseEvent(kind, at, QtCore.QPointF(where), button, buttons, modifier)
        QtGui.QApplication.sendEvent(target, event)
        spin(0.1)


def each_page_of_the_panel_can_be_seen() -> None:
    doc = document("cantilever.obj")
    panel = open_panel(doc)
    for mode in (FEM, NONE):
        panel.mode.setCurrentIndex(panel.mode.findData(mode))
    for i in range(panel.tabs.count()):
        panel.tabs.setCurrentIndex(i)
        picture(f"12-tab-{panel.tabs.tabText(i).lower()}")
    panel.from_file.setChecked(True)
    panel.file.setText(str(SAMPLES / "y_form.obj"))
    panel.mode.setCurrentIndex(0)
    picture("13-from-file")
    finish(panel)
    equal(panel.outcome.ok, True, panel.outcome.message)
    picture("14-from-file-result")
    close(panel)


# -- many beams ------------------------------------------------------------------------------------


def many_beams_are_offered_as_one_compound_or_a_mesh() -> None:
    many = beamwright_macro.MANY_BEAMS
    beamwright_macro.MANY_BEAMS = 5
    try:
        for button, kind, style in (
            ("One compound", "Part::Feature", COMPOUND),
            ("Mesh preview", "Mesh::Feature", PREVIEW),
            ("Cancel", "", ""),
        ):
            doc = document("cantilever.obj")
            before = names(doc)
            panel = open_panel(doc)
            answer(functools.partial(press, button))
            finish(panel)
            if style:
                equal(panel.inserted.group.Group[0].TypeId, kind, f"what {style} makes")
            else:
                equal(names(doc), before, "objects after Cancel")
            close(panel)
            App.closeDocument(doc.Name)
    finally:
        beamwright_macro.MANY_BEAMS = many


def press(text: str, dialog: Any) -> None:
    """Presses the button of a dialog with a text."""
    picture("15-many-beams")
    next(b for b in dialog.findChildren(QtGui.QPushButton) if text in b.text()).click()


def clean_up() -> None:
    """Closes a panel that a failed check left open."""
    if Gui.Control.activeDialog():
        beamwright_panel._open_panel.reject()
        spin(0.1)


def begin() -> None:
    """Runs the checks once the window stands."""
    (ARTEFACTS / "readme").mkdir(exist_ok=True)
    window = Gui.getMainWindow()
    window.showNormal()
    window.setGeometry(QtGui.QApplication.primaryScreen().geometry())
    for name in ("Report view", "Python console"):
        for dock in window.findChildren(QtGui.QDockWidget):
            if dock.objectName() == name:
                dock.hide()
    spin(0.5)
    main(
        a_run_fills_the_document_while_the_window_stays_awake,
        the_cut_list_opens_as_a_sheet,
        a_second_run_starts_from_the_settings_of_the_first_and_replaces_it,
        cancel_kills_the_program_and_leaves_nothing,
        a_breach_is_told_and_shown_where_it_is,
        an_open_mesh_is_refused_in_the_words_of_the_program,
        a_missing_program_is_asked_for_and_remembered,
        clicks_mark_flat_faces_red,
        each_page_of_the_panel_can_be_seen,
        many_beams_are_offered_as_one_compound_or_a_mesh,
        clean_up=clean_up,
    )


QtCore.QTimer.singleShot(500, begin)
