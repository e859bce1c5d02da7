"""Runs a script inside FreeCAD, with a home of its own, and ends with 0 if its checks passed.

    run.py headless.py ARTEFACTS       in freecadcmd
    run.py gui.py ARTEFACTS            in freecad under Xvfb

BEAMWRIGHT names the program; pictures, documents and FreeCAD's log are left in ARTEFACTS.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent

#: Seconds after which a script is taken for hung.
PATIENCE = 240

#: FreeCAD starts with an empty page of Part, as the start page would need a browser engine, and
#: before a white ground, which keeps the pictures small.
USER_CFG = """<?xml version="1.0" encoding="UTF-8" standalone="no" ?>
<FCParameters><FCParamGroup Name="Root"><FCParamGroup Name="BaseApp">
<FCParamGroup Name="Preferences"><FCParamGroup Name="General">
<FCText Name="AutoloadModule">PartWorkbench</FCText>
</FCParamGroup>
<FCParamGroup Name="View">
<FCBool Name="Simple" Value="1"/><FCBool Name="Gradient" Value="0"/>
<FCUInt Name="BackgroundColor" Value="4294967295"/>
</FCParamGroup>
</FCParamGroup></FCParamGroup></FCParamGroup></FCParameters>
"""


def main(script: str, artefacts: str) -> int:
    """Runs one script; its exit code."""
    folder = Path(artefacts).resolve()
    folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix="freecad-home-") as home:
        environment, verdict = _environment(Path(home), folder), Path(home) / "verdict"
        environment["BEAMWRIGHT_SCRIPT"] = Path(script).stem
        command = [*_freecad(script, Path(home)), str(HERE / "inside.py")]
        log = folder / (Path(script).stem + ".log")
        code = _run(command, environment, log)
        passed = verdict.is_file() and verdict.read_text() == "passed"
    if passed:
        return 0
    print(log.read_text(errors="replace")[-8000:], file=sys.stderr)
    print(f"error: {script} did not pass (FreeCAD ended with {code})", file=sys.stderr)
    return 1


def _environment(home: Path, artefacts: Path) -> dict[str, str]:
    temporary = home / "tmp"
    temporary.mkdir()
    return {
        **os.environ,
        "HOME": str(home),
        "TMPDIR": str(temporary),
        "XDG_RUNTIME_DIR": str(home),
        "BEAMWRIGHT_ROOT": str(HERE.parents[1]),
        "PYTHONDONTWRITEBYTECODE": "1",
        "BEAMWRIGHT_ARTEFACTS": str(artefacts),
        "BEAMWRIGHT_VERDICT": str(home / "verdict"),
        "QTWEBENGINE_DISABLE_SANDBOX": "1",
        "LIBGL_ALWAYS_SOFTWARE": "1",
    }


def _freecad(script: str, home: Path) -> list[str]:
    if not script.startswith("gui"):
        return ["freecadcmd"]
    settings = home / "user.cfg"
    settings.write_text(USER_CFG)
    screen = "-screen 0 1600x1000x24 -dpi 96"
    return ["xvfb-run", "-a", "-s", screen, "freecad", "-u", str(settings)]


def _run(command: list[str], environment: dict[str, str], log: Path) -> int:
    """Exit code of a command whose output goes to a log; the checks' lines are shown as well."""
    log.unlink(missing_ok=True)
    with log.open("a") as out:
        process = subprocess.Popen(
            command, env=environment, stdout=out, stderr=subprocess.STDOUT, start_new_session=True
        )
        try:
            code = process.wait(PATIENCE)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, 9)
            code = process.wait()
            print(f"error: no end within {PATIENCE} s", file=sys.stderr)
    for line in log.read_text(errors="replace").splitlines():
        if line.startswith(("ok ", "FAILED", "       ")) and line.strip():
            print(line)
    return code


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
