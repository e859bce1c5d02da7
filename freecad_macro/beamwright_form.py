# SPDX-License-Identifier: MIT OR Apache-2.0
"""The widgets of the task panel and how they are laid out; they do nothing by themselves."""

from __future__ import annotations

from typing import Any

from beamwright_input import FACES, FEM, LABELS, NONE, REGIONS
from beamwright_widgets import group_box, number_box, page, row, small_button, tab_page, text_label
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


class Form:
    """Task panel without behaviour: ``form`` is what FreeCAD shows."""

    def __init__(self) -> None:
        self._build()
        self._make_narrow()

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

    def widen_dock(self) -> None:
        """Gives the dock the panel stands in the width the panel needs; never makes it narrower."""
        dock = self.form.parentWidget()
        while dock is not None and not isinstance(dock, QtGui.QDockWidget):
            dock = dock.parentWidget()
        if dock is None:
            return
        margin = self.form.mapTo(dock, QtCore.QPoint(0, 0)).x()
        bar = dock.style().pixelMetric(QtGui.QStyle.PixelMetric.PM_ScrollBarExtent)
        wanted = self.form.minimumSizeHint().width() + 2 * margin + bar
        if dock.width() < wanted:
            window = dock.parentWidget()
            window.resizeDocks([dock], [wanted], QtCore.Qt.Orientation.Horizontal)

    def _build_input(self) -> Any:
        box, grid = group_box("Mesh")
        self.from_document = QtGui.QRadioButton("in the document")
        self.from_file = QtGui.QRadioButton("in a file")
        self.from_document.setChecked(True)
        self.meshes = QtGui.QListWidget()
        self.meshes.setMaximumHeight(60)
        self.file = QtGui.QLineEdit()
        self.file.setPlaceholderText("mesh file")
        self.browse = small_button("…")
        self.unit = QtGui.QComboBox()
        self.unit.addItems(["unit", "mm", "cm", "m", "in"])
        self.unit.setToolTip("Unit of length in the file; left alone: mm, and m for glTF")
        grid.addWidget(self.from_document, 0, 0)
        grid.addWidget(self.from_file, 0, 1, 1, 3)
        grid.addWidget(self.meshes, 1, 0, 1, 4)
        grid.addWidget(self.file, 2, 0, 1, 2)
        grid.addWidget(self.browse, 2, 2)
        grid.addWidget(self.unit, 2, 3)
        return box

    def _build_non_design(self) -> Any:
        box, grid = group_box("Non-design faces")
        self.mode = QtGui.QComboBox()
        for mode, text in MODES:
            self.mode.addItem(text, mode)
        self.pages = QtGui.QStackedWidget()
        self.label_text = text_label("")
        self.pick = QtGui.QPushButton("Pick")
        self.pick.setCheckable(True)
        self.pick.setToolTip(
            "Click flat faces in the 3D view; Shift+click takes them away; "
            "Ctrl+click where a strut is flush: no farther than what is marked reaches"
        )
        self.clear = QtGui.QPushButton("Clear")
        self.pick_text = text_label("")
        self.regions = QtGui.QListWidget()
        self.regions.setMaximumHeight(56)
        self.take = QtGui.QPushButton("Take the selection")
        self.constraints = QtGui.QListWidget()
        self.constraints.setMaximumHeight(56)
        self.depth = QtGui.QDoubleSpinBox()
        self.depth.setRange(0.0, 1e6)
        self.depth.setSuffix(" mm")
        self.depth.setToolTip("How far below the faces the material had to be kept")
        self.pages.addWidget(page([self.label_text]))
        self.pages.addWidget(page([row([self.pick, self.clear]), self.pick_text]))
        self.pages.addWidget(page([self.regions, self.take]))
        depth = row([QtGui.QLabel("Depth kept below"), self.depth])
        self.pages.addWidget(page([self.constraints, depth]))
        self.pages.addWidget(
            page(
                [
                    text_label(
                        "Branches then start at the flat ends, or failing that at the free ends."
                    )
                ]
            )
        )
        grid.addWidget(self.mode, 0, 0)
        grid.addWidget(self.pages, 1, 0)
        return box

    def _build_beams(self) -> Any:
        box, grid = tab_page()
        self.profile = QtGui.QComboBox()
        self.profile.setEditable(True)
        self.profile.setToolTip("Also catalogue:CHS,SHS for families of a catalogue")
        self.loft = QtGui.QComboBox()
        self.joints = QtGui.QComboBox()
        self.density = number_box(0.0, 1e5, 0, " kg/m³")
        self.density.setToolTip("Steel 7850, aluminium 2700")
        self.deviation = number_box(0.0, 100.0, 2, " radii")
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
        box, grid = tab_page()
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
        self.browse_keep = small_button("…")
        grid.addWidget(self.browse_keep, 2, 2)
        grid.setRowStretch(3, 1)
        return box

    def _build_log(self) -> Any:
        self.log = QtGui.QPlainTextEdit()
        self.log.setReadOnly(True)
        self.log.setMaximumBlockCount(2000)
        return self.log

    def _build_run(self) -> Any:
        layout = QtGui.QVBoxLayout()
        self.program_text = text_label("")
        self.choose = small_button("…")
        self.choose.setToolTip("Choose the program beamwright")
        layout.addWidget(row([self.program_text, self.choose], stretch=0))
        self.start_button = QtGui.QPushButton("Run")
        self.cancel_button = QtGui.QPushButton("Cancel")
        self.report_button = QtGui.QPushButton("Report")
        self.cancel_button.setEnabled(False)
        self.report_button.setEnabled(False)
        layout.addWidget(row([self.start_button, self.cancel_button, self.report_button]))
        self.bar = QtGui.QProgressBar()
        self.bar.setRange(0, 1000)
        self.message = text_label("")
        self.findings = QtGui.QListWidget()
        self.findings.setMinimumHeight(60)
        self.findings.setMaximumHeight(110)
        self.findings.setWordWrap(True)
        self.findings.setVisible(False)
        self.findings.setToolTip("Click: show the place in the 3D view")
        for widget in (self.bar, self.message, self.findings):
            layout.addWidget(widget)
        return layout
