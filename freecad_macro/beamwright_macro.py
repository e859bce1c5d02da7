# SPDX-License-Identifier: MIT OR Apache-2.0
"""The macro without its panel: look up the program, write its input, run it, take the result in."""

from __future__ import annotations

import shutil
import tempfile
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Callable, Sequence

import FreeCAD as App
from beamwright_command import Options, Outputs, command_line
from beamwright_document import insert_result
from beamwright_input import InputError, Job, NonDesign, Source, prepare
from beamwright_outcome import Outcome, run_to_end
from beamwright_program import (
    NOT_FOUND,
    Program,
    ProgramError,
    find_program,
    probe,
    refusal_of_input,
)
from beamwright_report import kept_files
from beamwright_result import COMPOUND, SOLIDS, Inserted, Result

PREFERENCES = "User parameter:BaseApp/Preferences/Mod/Beamwright"

#: Above this many beams a tree of solids makes FreeCAD slow.
MANY_BEAMS = 300


def preferred_program() -> str | None:
    """The program by preference, then ``$BEAMWRIGHT``, then PATH."""
    return find_program(App.ParamGet(PREFERENCES).GetString("Executable", ""))


def remember_program(path: str) -> None:
    """Stores the program in the preferences."""
    App.ParamGet(PREFERENCES).SetString("Executable", path)


def keep_files(outputs: Outputs, folder: str) -> list[str]:
    """Copies the files of a run to a folder of the user; returns where they are."""
    kept = []
    for path in kept_files(outputs.folder, outputs.stem):
        kept.append(str(shutil.copy(path, folder)))
    return kept


@dataclass(frozen=True)
class Ready:
    """A run that can start: its input is written.

    * ``arguments``: for the program; ``notes``: what is to be said before
    """

    program: Program
    source: Source
    non_design: NonDesign
    options: Options
    job: Job
    outputs: Outputs
    arguments: Sequence[str]
    notes: Sequence[str]

    def result(
        self, outcome: Outcome, style: str, *, fuse: bool = False, show_mesh: bool = True
    ) -> Result:
        """What there is to take into the document after the run."""
        return Result(
            self.source,
            self.outputs,
            outcome,
            self.program,
            style,
            fuse,
            show_mesh,
            unit=self.options.unit,
            chosen=self.options.chosen(),
            settings=settings_for(self.non_design, self.options),
        )


def make_ready(
    program: Program, source: Source, non_design: NonDesign, options: Options, folder: str
) -> Ready:
    """Writes the input of a run into ``folder``.  Raises ``InputError``."""
    refusal = refusal_of_input(program, source.file) if source.file else None
    if refusal:
        raise InputError(refusal)
    job = prepare(source, non_design, folder, options.unit)
    outputs = outputs_of(job, folder)
    # The unit is that of the file which is really handed over.
    given = replace(options, unit=job.unit)
    arguments, left_out = command_line(program, job.mesh, outputs, given, job.regions)
    notes = list(job.notes)
    if left_out:
        flags = ", ".join(left_out)
        notes.append(f"left out, as beamwright {program.version_text} has none: {flags}")
    return Ready(program, source, non_design, options, job, outputs, arguments, notes)


def reconstruct(
    doc: Any,
    source: Source,
    non_design: NonDesign | None = None,
    options: Options | None = None,
    *,
    program: str = "",
    style: str = "",
    fuse: bool = False,
    keep: str = "",
    on_event: Callable[[Any], None] = lambda event: None,
) -> Inserted:
    """The macro without its panel.

    * ``program``: path of beamwright; "" looks it up
    * ``style``: ``SOLIDS``, ``COMPOUND`` or ``PREVIEW``; "" takes solids up to ``MANY_BEAMS``
    * ``keep``: a folder for copies of the files; "" keeps none

    Raises ``ProgramError``, ``InputError`` or ``ResultError``; the document is then as it was.
    """
    path = program or preferred_program()
    if not path:
        raise ProgramError(NOT_FOUND)
    found = probe(path)
    with tempfile.TemporaryDirectory(prefix="beamwright-") as folder:
        ready = make_ready(found, source, non_design or NonDesign(), options or Options(), folder)
        for note in ready.notes:
            on_event(note)
        outcome = run_to_end(found, ready.arguments, on_event)
        if not outcome.ok:
            raise ProgramError(ready.job.in_words(outcome.message))
        if not style:
            style = SOLIDS if outcome.beams <= MANY_BEAMS else COMPOUND
        inserted = insert_result(doc, ready.result(outcome, style, fuse=fuse))
        if keep:
            inserted.notes += [f"kept {p}" for p in keep_files(ready.outputs, keep)]
        return inserted


def outputs_of(job: Job, folder: str) -> Outputs:
    """Where a run writes: a folder of its own below ``folder``, so that nothing is in the way."""
    below = Path(folder) / "out"
    below.mkdir(exist_ok=True)
    return Outputs(str(below), job.stem)


def settings_for(non_design: NonDesign, options: Options) -> dict[str, Any]:
    """What the next run on the same mesh starts from."""
    return {
        "mode": non_design.mode,
        "faces": non_design.faces,
        "objects": [o.Name for o in non_design.objects],
        "depth": non_design.depth,
        "profile": options.profile,
        "loft": options.loft,
        "joints": options.joints,
        "density": options.density,
        "max_deviation": options.max_deviation,
        "unit": options.unit,
        "strict": options.strict,
    }
