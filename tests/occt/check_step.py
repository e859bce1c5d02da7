#!/usr/bin/env python3
"""Reads STEP files with OCCT and compares what it finds with what was meant.

    check_step.py FILE.step...     each file, beside FILE.json if there is one
    check_step.py FOLDER           all STEP files of a folder

Every solid must be valid, closed, the right side out, named and coloured.  With
a FILE.json (written by tests/step_occt.rs) the tree, the names, the placements,
the colours, the properties and the volumes must be those listed there, and
parts that are alike must share one product.

Needs the PyPI package cadquery-ocp.  Exit code 1 if anything is wrong.
"""

from __future__ import annotations

import json
import sys
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Iterator

from OCP.BRep import BRep_Tool
from OCP.BRepCheck import BRepCheck_Analyzer
from OCP.BRepGProp import BRepGProp
from OCP.GProp import GProp_GProps
from OCP.IFSelect import IFSelect_RetDone
from OCP.Quantity import Quantity_Color, Quantity_TypeOfColor
from OCP.STEPCAFControl import STEPCAFControl_Reader
from OCP.TCollection import TCollection_ExtendedString
from OCP.TDataStd import TDataStd_Name, TDataStd_NamedData
from OCP.TDF import TDF_Label
from OCP.TDocStd import TDocStd_Document
from OCP.TopAbs import TopAbs_EDGE, TopAbs_SHELL, TopAbs_SOLID
from OCP.TopExp import TopExp_Explorer
from OCP.TopoDS import TopoDS
from OCP.XCAFApp import XCAFApp_Application
from OCP.XCAFDoc import XCAFDoc_ColorType, XCAFDoc_DocumentTool, XCAFDoc_ShapeTool, XCAFDoc_Volume

# OCCT's adaptive integration stops at about a thousand times what it is asked for.
INTEGRATION = 1e-12
# Edges whose tolerance OCCT had to widen beyond this do not lie on their faces.
WIDEST_EDGE = 1e-5
# Relative to the size of the numbers compared.
SAME = 1e-9


def static(cls: type, name: str) -> Any:
    """A static method under either of the names bindings give it."""
    return getattr(cls, name + "_s", None) or getattr(cls, name)


def sequence() -> Any:
    """An empty sequence of labels."""
    try:
        from OCP.OCP.collections import Sequence_TDF_Label

        return Sequence_TDF_Label()
    except ImportError:
        from OCP.TDF import TDF_LabelSequence

        return TDF_LabelSequence()


def attribute(label: TDF_Label, kind: type) -> Any:
    """An attribute of a label, or None."""
    found = kind()
    return found if label.FindAttribute(static(kind, "GetID")(), found) else None


def name_of(label: TDF_Label) -> str | None:
    found = attribute(label, TDataStd_Name)
    return str(found.Get().ToExtString()) if found else None


def below(shape: Any, kind: Any) -> list[Any]:
    """The shapes of a kind within a shape, in OCCT's order."""
    explorer, found = TopExp_Explorer(shape, kind), []
    while explorer.More():
        found.append(explorer.Current())
        explorer.Next()
    return found


@dataclass
class Leaf:
    """One placed part as OCCT has it."""

    name: str | None
    product: str | None
    path: list[str | None]
    shape: Any
    definition: TDF_Label
    colour: list[int] | None = None
    properties: TDataStd_NamedData | None = None
    stated_volume: float | None = None


@dataclass
class Model:
    """A STEP file as OCCT has it."""

    leaves: list[Leaf] = field(default_factory=list)
    roots: int = 0
    products: int = 0


class Reader:
    """Reads a file with names, colours, properties and placements."""

    def __init__(self, path: Path) -> None:
        application = static(XCAFApp_Application, "GetApplication")()
        self.document = TDocStd_Document(TCollection_ExtendedString("XmlXCAF"))
        application.NewDocument(TCollection_ExtendedString("MDTV-XCAF"), self.document)
        reader = STEPCAFControl_Reader()
        for mode in (
            "SetColorMode",
            "SetNameMode",
            "SetPropsMode",
            "SetMetaMode",
            "SetProductMetaMode",
        ):
            if hasattr(reader, mode):
                getattr(reader, mode)(True)
        if reader.ReadFile(str(path)) != IFSelect_RetDone or not reader.Transfer(self.document):
            raise ValueError("OCCT cannot read the file")
        main = self.document.Main()
        self.shapes = static(XCAFDoc_DocumentTool, "ShapeTool")(main)
        self.colours = static(XCAFDoc_DocumentTool, "ColorTool")(main)

    def model(self) -> Model:
        model, roots = Model(), sequence()
        self.shapes.GetFreeShapes(roots)
        model.roots = roots.Length()
        for i in range(1, roots.Length() + 1):
            self.walk(roots.Value(i), [name_of(roots.Value(i))], model)
        entries = {leaf.definition.Tag() for leaf in model.leaves}
        model.products = len(entries)
        return model

    def walk(self, assembly: TDF_Label, path: list[str | None], model: Model) -> None:
        components = sequence()
        static(XCAFDoc_ShapeTool, "GetComponents")(assembly, components, False)
        for i in range(1, components.Length() + 1):
            component, definition = components.Value(i), TDF_Label()
            static(XCAFDoc_ShapeTool, "GetReferredShape")(component, definition)
            if static(XCAFDoc_ShapeTool, "IsAssembly")(definition):
                self.walk(definition, [*path, name_of(component)], model)
            else:
                model.leaves.append(self.leaf(component, definition, path))

    def leaf(self, component: TDF_Label, definition: TDF_Label, path: list[str | None]) -> Leaf:
        shape = static(XCAFDoc_ShapeTool, "GetShape")(component)
        volume = attribute(definition, XCAFDoc_Volume)
        return Leaf(
            name_of(component),
            name_of(definition),
            path,
            shape,
            definition,
            self.colour(shape, definition),
            attribute(definition, TDataStd_NamedData),
            volume.Get() if volume else None,
        )

    def colour(self, shape: Any, definition: TDF_Label) -> list[int] | None:
        own = static(XCAFDoc_ShapeTool, "GetShape")(definition)
        found = Quantity_Color()
        for candidate in [shape, own, *below(own, TopAbs_SOLID)]:
            for kind in (XCAFDoc_ColorType.XCAFDoc_ColorSurf, XCAFDoc_ColorType.XCAFDoc_ColorGen):
                if self.colours.GetColor(candidate, kind, found):
                    rgb = found.Values(Quantity_TypeOfColor.Quantity_TOC_sRGB)
                    return [round(255 * c) for c in rgb]
        return None


def volume(solid: Any) -> float:
    properties = GProp_GProps()
    static(BRepGProp, "VolumeProperties")(solid, properties, INTEGRATION, True, False)
    return float(properties.Mass())


def faults_of_shape(leaf: Leaf) -> Iterator[str]:
    """What is wrong with a part, whatever it was meant to be."""
    solids = below(leaf.shape, TopAbs_SOLID)
    if len(solids) != 1:
        yield f"{len(solids)} solids"
        return
    solid = solids[0]
    if not BRepCheck_Analyzer(solid).IsValid():
        yield "not valid"
    if not all(static(BRep_Tool, "IsClosed")(shell) for shell in below(solid, TopAbs_SHELL)):
        yield "not closed"
    if not volume(solid) > 0:
        yield "inside out or empty"
    if not leaf.name or not leaf.product:
        yield "no name"
    if leaf.colour is None:
        yield "no colour"


def faults_against(leaf: Leaf, meant: dict[str, Any]) -> Iterator[str]:
    """How a part differs from what was meant."""
    for what, found in (
        ("name", leaf.name),
        ("product", leaf.product),
        ("path", leaf.path),
        ("colour", leaf.colour),
    ):
        if found != meant[what]:
            yield f"{what} {found!r}, not {meant[what]!r}"
    off = volume(leaf.shape) / meant["volume"] - 1
    if not abs(off) <= meant["accuracy"]:
        yield f"volume off by {off:.1e}"
    if leaf.stated_volume is None or abs(leaf.stated_volume / meant["volume"] - 1) > SAME:
        yield f"stated volume {leaf.stated_volume}, not {meant['volume']}"
    placed = leaf.shape.Location().Transformation()
    at = [placed.Value(row, column) for row in (1, 2, 3) for column in (1, 2, 3, 4)]
    size = max(1.0, *(abs(x) for x in meant["placement"]))
    if any(abs(a - b) > SAME * size for a, b in zip(at, meant["placement"])):
        yield f"placed at {at}, not {meant['placement']}"
    widest = max(
        (
            static(BRep_Tool, "Tolerance")(static(TopoDS, "Edge")(edge))
            for edge in below(leaf.shape, TopAbs_EDGE)
        ),
        default=0.0,
    )
    if widest > max(WIDEST_EDGE, 10 * meant["accuracy"] * meant["volume"] ** (1 / 3)):
        yield f"an edge is {widest:.1e} mm off its face"
    for name, value in meant["properties"].items():
        own = property_of(leaf, name)
        if own != value:
            yield f"property {name!r} is {own!r}, not {value!r}"


def property_of(leaf: Leaf, name: str) -> str | float | None:
    """The value of a property; OCCT keeps the UTF-8 bytes of texts as if they were characters."""
    data, key = leaf.properties, TCollection_ExtendedString(name, True)
    if data is None:
        return None
    data.LoadDeferredData()
    if data.HasString(key):
        return str(data.GetString(key).ToExtString()).encode("latin-1").decode()
    return float(data.GetReal(key)) if data.HasReal(key) else None


def check(path: Path) -> tuple[list[str], Model]:
    """All faults of one file, as lines, and the model."""
    model = Reader(path).model()
    faults = [] if model.roots == 1 else [f"{model.roots} roots"]
    if not model.leaves:
        faults.append("no parts")
    for leaf in model.leaves:
        faults += [f"{leaf.name!r}: {fault}" for fault in faults_of_shape(leaf)]
    beside = path.with_suffix(".json")
    if beside.exists():
        parts = json.loads(beside.read_text(encoding="utf-8"))["parts"]
        if len(parts) != len(model.leaves):
            faults.append(f"{len(model.leaves)} parts, not {len(parts)}")
        for leaf, meant in zip(model.leaves, parts):
            faults += [f"{leaf.name!r}: {fault}" for fault in faults_against(leaf, meant)]
        distinct = {
            json.dumps([p["product"], p["colour"], p["volume"], p["properties"]]) for p in parts
        }
        if model.products != len(distinct):
            faults.append(f"{model.products} products, not {len(distinct)}")
    return faults, model


def main() -> int:
    paths = [
        p
        for a in map(Path, sys.argv[1:])
        for p in (sorted(a.glob("*.step")) if a.is_dir() else [a])
    ]
    if not paths:
        print(__doc__, file=sys.stderr)
        return 2
    wrong = 0
    for path in paths:
        try:
            faults, model = check(path)
        except (ValueError, OSError) as error:
            faults, model = [str(error)], Model()
        wrong += len(faults)
        print(
            f"{path.name}: {len(model.leaves)} parts of {model.products} products, "
            f"{len(faults) or 'no'} fault{'s' if len(faults) != 1 else ''}"
        )
        for fault in faults:
            print(f"    {fault}")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
