# SPDX-License-Identifier: MIT OR Apache-2.0
"""What a run left, how it is to be shown, and what became of it in the document."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, Mapping, Sequence

from beamwright_command import Outputs
from beamwright_input import Source
from beamwright_outcome import Outcome
from beamwright_program import Program


class ResultError(Exception):
    """The result of a run could not be taken into the document."""


SOLIDS, COMPOUND, PREVIEW = "solids", "compound", "preview"


@dataclass
class Result:
    """What a run left, and how it is to be shown.

    * ``style``: ``SOLIDS`` in a tree, one ``COMPOUND``, or a mesh as ``PREVIEW``
    * ``fuse``: whether a fused solid is wanted as well
    * ``settings``: of the panel, kept in the document for the next run
    """

    source: Source
    outputs: Outputs
    outcome: Outcome
    program: Program
    style: str = SOLIDS
    fuse: bool = False
    show_mesh: bool = True
    unit: str = ""
    chosen: Sequence[str] = ()
    settings: Mapping[str, Any] = field(default_factory=dict)


@dataclass
class Inserted:
    """What was put into the document."""

    group: Any
    beams: list[Any] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
