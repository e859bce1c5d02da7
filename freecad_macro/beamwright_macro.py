# SPDX-License-Identifier: MIT OR Apache-2.0
"""The macro without its panel: look up the program, write its input, run it, take the result in."""

from __future__ import annotations

import shutil
import tempfile
from dataclasses import replace
from pathlib import Path
from typing import Any, Callable

import FreeCAD as App
from beamwright_command import Options, Outputs, command_line
from beamwright_document import insert_result
from beamwright_input import InputError, Job, NonDesign, Source, prepare
from beamwright_outcome import run_to_end
from beamwright_program import NOT_FOUND, ProgramError, find_program, probe, refusal_of_input
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
    non_design = non_design or NonDesign()
    options = options or Options()
    path = program or preferred_program()
    if not path:
        raise ProgramError(NOT_FOUND)
    found = probe(path)
    if source.file:
        refusal = refusal_of_input(found, source.file)
        if refusal:
            raise InputError(refusal)
    with tempfile.TemporaryDirectory(prefix="beamwright-") as folder:
        job = prepare(source, non_design, folder, options.unit)
        for note in job.notes:
            on_event(note)
        outputs = outputs_of(job, folder)
        arguments, left_out = command_line(
            found, job.mesh, outputs, with_unit(options, job.unit), job.regions
        )
        if left_out:
            on_event(f"beamwright {found.version_text} has no {', '.join(left_out)}; left out")
        outcome = run_to_end(found, arguments, on_event)
        if not outcome.ok:
            raise ProgramError(job.in_words(outcome.message))
        if not style:
            style = SOLIDS if outcome.beams <= MANY_BEAMS else COMPOUND
        result = Result(
            source,
            outputs,
            outcome,
            found,
            style,
            fuse,
            unit=options.unit,
            chosen=options.chosen(),
            settings=settings_for(non_design, options),
        )
        inserted = insert_result(doc, result)
        if keep:
            inserted.notes += [f"kept {p}" for p in keep_files(outputs, keep)]
        return inserted


def outputs_of(job: Job, folder: str) -> Outputs:
    """Where a run writes: a folder of its own below ``folder``, so that nothing is in the way."""
    below = Path(folder) / "out"
    below.mkdir(exist_ok=True)
    return Outputs(str(below), job.stem)


def with_unit(options: Options, unit: str) -> Options:
    """The options with the unit of the file that is really handed over."""
    return replace(options, unit=unit)


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
