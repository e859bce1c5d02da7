# SPDX-License-Identifier: MIT OR Apache-2.0
"""A run in words, and the files it leaves; without FreeCAD."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Mapping, Sequence


@dataclass
class ReportText:
    """Lines about a run, as shown in the document and in the log."""

    lines: list[str] = field(default_factory=list)

    @classmethod
    def of(cls, summary: Mapping[str, Any], version: str, extra: Sequence[str] = ()) -> ReportText:
        """The summary of a run in words."""
        frame, skeleton = summary.get("frame") or {}, summary.get("skeleton") or {}
        labels, mesh = summary.get("labels") or {}, summary.get("mesh") or {}
        lines = [f"beamwright {version}: {summary.get('input', '')}", ""]
        if mesh:
            lines.append(
                f"mesh: {mesh.get('triangles', 0)} triangles, genus {mesh.get('genus', 0)}, "
                f"{mesh.get('volume', 0.0):.0f} mm³"
            )
        if labels.get("source"):
            lines.append(
                f"non-design: {labels.get('non_design_faces', 0)} faces in "
                f"{labels.get('sets', 0)} set(s) by {labels['source']}, "
                f"{len(labels.get('interfaces') or ())} interface section(s)"
            )
        else:
            lines.append("non-design: none; the whole mesh is design")
        if skeleton:
            lines.append(
                f"skeleton: {skeleton.get('branches', 0)} branches, "
                f"{skeleton.get('junctions', 0)} junctions, {skeleton.get('length', 0.0):.1f} mm; "
                f"cycles {skeleton.get('cycles', 0)} of {skeleton.get('expected_cycles', 0)}"
            )
        if frame:
            lines.append(
                f"frame: {frame.get('beams', 0)} beams, {frame.get('nodes', 0)} nodes, "
                f"{frame.get('length', 0.0):.1f} mm; {frame.get('volume', 0.0):.0f} mm³ of "
                f"{frame.get('design_volume', 0.0):.0f} mm³ design"
            )
        findings = summary.get("findings") or ()
        lines.append("")
        lines.append(f"{len(findings)} finding(s)" + (":" if findings else ""))
        for finding in findings:
            place = finding.get("place")
            where = " at ({:.2f}, {:.2f}, {:.2f}) mm".format(*place) if place else ""
            kind = "BREACH" if finding.get("breach") else "note"
            lines.append(f"{kind}: {finding.get('text', '')}{where}")
        if extra:
            lines += ["", *extra]
        return cls(lines)

    def __str__(self) -> str:
        return "\n".join(self.lines) + "\n"


def kept_files(folder: str, stem: str) -> list[str]:
    """Files of a run that are there, by their full paths."""
    return sorted(str(p) for p in Path(folder).glob(glob_escape(stem) + ".*"))


def glob_escape(text: str) -> str:
    """A text as itself in a pattern of ``Path.glob``."""
    return re.sub(r"([*?\[])", r"[\1]", text)
