# SPDX-License-Identifier: MIT OR Apache-2.0
"""One solid of all beams, where OCCT finds a sound one."""

from __future__ import annotations

from typing import Any, Sequence

import FreeCAD as App
import Part
from beamwright_input import shape_of, triangles_of_shape
from beamwright_volume import union_volume

#: The fused solid and the union of the beams may differ in volume by this part, measured along
#: the same rays through their triangles.
VOLUME_TOLERANCE = 0.01


def fused_feature(doc: Any, beams: Sequence[Any], top: Sequence[Any]) -> tuple[Any | None, str]:
    """A feature with all beams fused, or None; and what is to be said of it."""
    shapes = [s for b in beams for s in shape_of(b).Solids]
    shapes = shapes or [s for o in top if hasattr(o, "Shape") for s in o.Shape.Solids]
    fused, note = fuse(shapes)
    if fused is None:
        return None, note
    feature = doc.addObject("Part::Feature", "Fused")
    feature.Shape = fused
    if App.GuiUp:
        feature.ViewObject.Visibility = False
    return feature, note


def fuse(shapes: Sequence[Any]) -> tuple[Any | None, str]:
    """The union of solids, or None where OCCT does not find a sound one.

    ``isValid`` alone is not enough: OCCT has called a fuse valid that had lost nearly all of
    its volume.  The number of solids, the bounds of the volume and the volume of the union as
    measured on the triangles must agree as well.
    """
    if len(shapes) < 2:
        return None, "there is nothing to fuse"
    diagonal = Part.makeCompound(list(shapes)).BoundBox.DiagonalLength
    reason = ""
    # OCCT needs seconds for each freeform beam, so a large frame gets one try.
    for tolerance in (0.0, 1e-5 * diagonal) if len(shapes) <= 20 else (0.0,):
        try:
            fused = shapes[0].multiFuse(list(shapes[1:]), tolerance)
        except Part.OCCError as error:
            reason = str(error)
            continue
        reason = why_unsound(fused, shapes)
        if not reason:
            return fused, f"{len(shapes)} solids fused to one of {fused.Volume:.0f} mm³"
    return None, f"the beams stay separate solids: OCCT cannot fuse them soundly ({reason})"


def why_unsound(fused: Any, shapes: Sequence[Any]) -> str:
    """What is wrong with a fused shape; "" if nothing."""
    if not fused.isValid():
        return "the fused shape is not valid"
    if len(fused.Solids) != 1:
        return f"the fused shape has {len(fused.Solids)} solids"
    volumes = [s.Volume for s in shapes]
    if not max(volumes) * (1 - VOLUME_TOLERANCE) <= fused.Volume:
        return f"its volume of {fused.Volume:.1f} mm³ is below that of one beam"
    if fused.Volume > sum(volumes) * (1 + VOLUME_TOLERANCE):
        return f"its volume of {fused.Volume:.1f} mm³ is above that of all beams"
    deviation = fused.BoundBox.DiagonalLength / 10000.0
    expected = union_volume([triangles_of_shape(s, deviation) for s in shapes])
    found = union_volume([triangles_of_shape(fused, deviation)])
    if abs(found - expected) > VOLUME_TOLERANCE * expected:
        return f"its volume is {found:.1f} mm³ where the beams fill {expected:.1f} mm³"
    return ""
