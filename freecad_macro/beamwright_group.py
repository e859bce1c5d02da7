# SPDX-License-Identifier: MIT OR Apache-2.0
"""The group that holds the result of a run: how it is found again, described and shown."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any, Iterable, Sequence

import FreeCAD as App
from beamwright_input import Source
from beamwright_result import Result


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


def describe(group: Any, result: Result, made: Sequence[str]) -> None:
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


def reveal(result: Result, group: Any, beams: Sequence[Any], top: Sequence[Any]) -> None:
    """Lets the beams be seen through the mesh, and the skeleton through the beams."""
    if not App.GuiUp:
        return
    for obj in [*result.source.objects, *group.Group]:
        if obj.isDerivedFrom("Mesh::Feature") and obj not in top:
            obj.ViewObject.Transparency = 85
    for obj in beams or [o for o in top if hasattr(o, "Shape")]:
        if hasattr(obj.ViewObject, "Transparency"):
            obj.ViewObject.Transparency = 35


def with_contents(doc: Any, names: Sequence[str]) -> list[str]:
    """Objects and all they contain, contents first."""
    found: list[str] = []
    for name in names:
        obj = doc.getObject(name)
        below = [o.Name for o in obj.Group] if obj is not None and hasattr(obj, "Group") else []
        for inner in [*with_contents(doc, below), name]:
            if inner not in found:
                found.append(inner)
    return [name for name in found if name in set(names)]


def remove(doc: Any, names: Iterable[str]) -> None:
    """Removes those of some objects that are still there."""
    for name in names:
        if doc.getObject(name) is not None:
            doc.removeObject(name)
