# SPDX-License-Identifier: MIT OR Apache-2.0
"""The small widgets the task panel is built of."""

from __future__ import annotations

from typing import Any

from PySide import QtCore, QtGui


def group_box(title: str) -> tuple[Any, Any]:
    """A box with a title, and the grid in it."""
    box = QtGui.QGroupBox(title)
    grid = QtGui.QGridLayout(box)
    grid.setContentsMargins(6, 4, 6, 4)
    grid.setVerticalSpacing(3)
    return box, grid


def tab_page() -> tuple[Any, Any]:
    """A page of a tab widget, and the grid in it."""
    page = QtGui.QWidget()
    grid = QtGui.QGridLayout(page)
    grid.setContentsMargins(6, 4, 6, 4)
    grid.setVerticalSpacing(3)
    return page, grid


def page(widgets: list[Any]) -> Any:
    """Widgets one below the other."""
    page = QtGui.QWidget()
    layout = QtGui.QVBoxLayout(page)
    layout.setContentsMargins(0, 0, 0, 0)
    for widget in widgets:
        layout.addWidget(widget)
    layout.addStretch(1)
    return page


def row(widgets: list[Any], stretch: int | None = None) -> Any:
    """Widgets side by side; ``stretch`` is the number of the one that takes the room, None: all."""
    row = QtGui.QWidget()
    layout = QtGui.QHBoxLayout(row)
    layout.setContentsMargins(0, 0, 0, 0)
    for i, widget in enumerate(widgets):
        layout.addWidget(widget, 1 if stretch in (None, i) else 0)
    return row


def text_label(text: str) -> Any:
    """Text that wraps and can be copied."""
    label = QtGui.QLabel(text)
    label.setWordWrap(True)
    label.setTextInteractionFlags(QtCore.Qt.TextInteractionFlag.TextSelectableByMouse)
    return label


def small_button(text: str) -> Any:
    """A button as wide as its text."""
    button = QtGui.QToolButton()
    button.setText(text)
    return button


def number_box(low: float, high: float, digits: int, suffix: str) -> Any:
    """A box for a number."""
    box = QtGui.QDoubleSpinBox()
    box.setRange(low, high)
    box.setDecimals(digits)
    box.setSuffix(suffix)
    return box


def chosen_of(box: Any) -> str:
    """What a choice says to the program: "" for its default."""
    if not box.isEnabled():
        return ""
    index = box.currentIndex()
    if index >= 0 and box.itemText(index) == box.currentText():
        return str(box.itemData(index) or "")
    return str(box.currentText().strip())


def choose_in(box: Any, value: str) -> None:
    """Chooses a value by what it says to the program, or by its text; "" is the default."""
    index = max(box.findData(value), box.findText(value)) if value else 0
    if index >= 0:
        box.setCurrentIndex(index)
    elif box.isEditable():
        box.setEditText(value)


def html(text: str) -> str:
    """Text as it is written in rich text."""
    return text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
