"""What the scripts that run inside FreeCAD share: samples, stand-in programs, checks, the end.

FreeCAD's console ends with 0 whatever happened, and its window does not end at all.  So a script
hands its checks to ``main``, which writes "passed" into the file named by BEAMWRIGHT_VERDICT.
"""

from __future__ import annotations

import os
import sys
import time
import traceback
from pathlib import Path
from typing import Any, Callable, Iterator

import FreeCAD as App
import Mesh

ROOT = Path(os.environ["BEAMWRIGHT_ROOT"])
MACRO = ROOT / "freecad_macro"
SAMPLES = ROOT / "samples"
ARTEFACTS = Path(os.environ["BEAMWRIGHT_ARTEFACTS"])
PROGRAM = os.environ["BEAMWRIGHT"]


def main(*checks: Callable[[], None], clean_up: Callable[[], None] = lambda: None) -> None:
    """Runs the checks one after the other, tells what failed, and ends FreeCAD.

    * ``clean_up``: after each check, passed or not
    """
    failed = []
    for check in checks:
        begin = time.monotonic()
        try:
            check()
        except BaseException:
            failed.append(check.__name__)
            traceback.print_exc()
        finally:
            clean_up()
            for name in list(App.listDocuments()):
                App.closeDocument(name)
        verdict = "FAILED" if check.__name__ in failed[-1:] else "ok"
        say(f"{verdict:6} {check.__name__} ({time.monotonic() - begin:.1f} s)")
    text = f"failed: {', '.join(failed)}" if failed else "passed"
    Path(os.environ["BEAMWRIGHT_VERDICT"]).write_text(text)
    sys.stdout.flush()
    # FreeCAD has crashed in its own clean-up; all is said by now.
    os._exit(1 if failed else 0)


def say(text: str) -> None:
    """A line on the real standard output, which FreeCAD's console takes away from ``print``."""
    # On a line of its own: FreeCAD leaves its progress without an end.
    os.write(1, f"\n{text}\n".encode())


def equal(found: Any, expected: Any, what: str) -> None:
    """Fails unless two things are equal."""
    if found != expected:
        raise AssertionError(f"{what}: {found!r} instead of {expected!r}")


def document(sample: str = "") -> Any:
    """A new document, with the mesh objects of a sample in it."""
    doc = App.newDocument("Test")
    doc.UndoMode = 1
    if sample:
        Mesh.insert(str(SAMPLES / sample), doc.Name)
        doc.clearUndos()
    return doc


def names(doc: Any) -> list[str]:
    """Internal names and labels of all objects, in order."""
    return [f"{o.Name}={o.Label}" for o in doc.Objects]


def stand_in(name: str, body: str) -> str:
    """A program in place of beamwright that answers questions like it and does ``body`` to run.

    In ``body`` the real program is ``$REAL`` and its arguments are ``"$@"``.
    """
    path = ARTEFACTS / name
    path.write_text(
        "#!/bin/sh\n"
        f'REAL="{PROGRAM}"\n'
        'case " $* " in *" --help "*|*" --version "*) exec "$REAL" "$@";; esac\n' + body
    )
    path.chmod(0o755)
    return str(path)


def temporary_folders() -> set[str]:
    """Folders of runs that are still there."""
    return {str(p) for p in Path(os.environ["TMPDIR"]).glob("beamwright-*")}


def samples() -> Iterator[str]:
    """The samples every run must manage."""
    yield from ("cantilever.obj", "four_fixings.obj", "y_form.obj")
