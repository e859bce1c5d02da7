# SPDX-License-Identifier: MIT OR Apache-2.0
"""A run in words, and the files it leaves; without FreeCAD."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Mapping, Sequence


def counted(count: int, one: str, many: str) -> str:
    """Say ``1 beam`` or ``2 beams``."""
    return f"{count} {one if count == 1 else many}"


def _counted(part: Mapping[str, Any], many: str, one: str) -> str:
    """Say how many of something the summary names."""
    return counted(part.get(many, 0), one, many)


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
                f"mesh: {_counted(mesh, 'triangles', 'triangle')}, "
                f"genus {mesh.get('genus', 0)}, {mesh.get('volume', 0.0):.0f} mm³"
            )
        if labels.get("source"):
            sections = len(labels.get("interfaces") or ())
            interfaces = counted(sections, "interface section", "interface sections")
            lines.append(
                f"non-design: {labels.get('non_design_faces', 0)} faces in "
                f"{_counted(labels, 'sets', 'set')} by {labels['source']}, {interfaces}"
            )
        else:
            lines.append("non-design: none; the whole mesh is design")
        if skeleton:
            lines.append(
                f"skeleton: {_counted(skeleton, 'branches', 'branch')}, "
                f"{_counted(skeleton, 'junctions', 'junction')}, "
                f"{skeleton.get('length', 0.0):.1f} mm; "
                f"cycles {skeleton.get('cycles', 0)} of {skeleton.get('expected_cycles', 0)}"
            )
        if frame:
            lines.append(
                f"frame: {_counted(frame, 'beams', 'beam')}, {_counted(frame, 'nodes', 'node')}, "
                f"{frame.get('length', 0.0):.1f} mm; {frame.get('volume', 0.0):.0f} mm³ of "
                f"{frame.get('design_volume', 0.0):.0f} mm³ design"
            )
        findings = summary.get("findings") or ()
        lines.append("")
        lines.append(counted(len(findings), "finding", "findings") + (":" if findings else ""))
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
