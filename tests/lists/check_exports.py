#!/usr/bin/env python3
# SPDX-License-Identifier: MIT OR Apache-2.0
"""Checks the exports of the samples with the programs they are meant for.

    check_exports.py PROGRAM SAMPLES

DXF: ezdxf finds no error and as many lines as beams.  IFC: ifcopenshell finds it valid, express
rules included, with as many members as beams, none twice.  CalculiX: a bar bends as P L³ / 3 E I
says, and a whole cantilever is solved.
"""

from __future__ import annotations

import json
import math
import subprocess
import sys
import tempfile
from pathlib import Path

import ezdxf
import ifcopenshell
import ifcopenshell.validate

STEP = """\
*INCLUDE, INPUT={model}
*STEP
*STATIC
*BOUNDARY
NON_DESIGN_1, 1, 6
*CLOAD
NON_DESIGN_2, 3, -{force}
*NODE PRINT, NSET=NON_DESIGN_2
U
*END STEP
"""


def check(good: bool, what: str) -> None:
    if not good:
        sys.exit(f"failed: {what}")
    print("ok:", what)


def export(program: Path, sample: Path, folder: Path, *options: str) -> int:
    """Writes all exports of a sample; the number of its beams."""
    files = [folder / f"{sample.stem}.{e}" for e in ("dxf", "ifc", "inp")]
    exports = [word for f in files for word in ("--export", str(f))]
    step = folder / f"{sample.stem}.step"
    command = [str(program), "reconstruct", str(sample), "-o", str(step), "--json"]
    done = subprocess.run([*command, *exports, *options], capture_output=True, check=True)
    return int(json.loads(done.stdout)["frame"]["beams"])


def check_dxf(path: Path, beams: int) -> None:
    drawing = ezdxf.readfile(path)
    check(not drawing.audit().errors, f"{path.name}: no error found")
    lines = drawing.modelspace().query("LINE")
    check(len(lines) == beams, f"{path.name}: {beams} lines")
    check(all(line.dxf.layer in drawing.layers for line in lines), f"{path.name}: on its layers")


def check_ifc(path: Path, beams: int) -> None:
    model = ifcopenshell.open(path)
    log = ifcopenshell.validate.json_logger()
    ifcopenshell.validate.validate(model, log, express_rules=True)
    check(not log.statements, f"{path.name}: valid {log.statements[:2]}")
    members = model.by_type("IfcMember")
    check(len(members) == beams, f"{path.name}: {beams} members")
    guids = [e.GlobalId for e in model.by_type("IfcRoot")]
    check(len(set(guids)) == len(guids), f"{path.name}: no identifier twice")


def solve(model: Path, force: float) -> float:
    """Largest displacement of the loaded nodes, mm."""
    job = model.with_name(f"{model.stem}_step")
    job.with_suffix(".inp").write_text(STEP.format(model=model.name, force=force))
    done = subprocess.run(["ccx", job.name], cwd=model.parent, capture_output=True, text=True)
    check("Job finished" in done.stdout, f"{model.name}: solved")
    rows = [line.split() for line in job.with_suffix(".dat").read_text().splitlines()]
    moves = [[float(x) for x in r[1:]] for r in rows if len(r) == 4 and r[0].isdigit()]
    return max(math.hypot(*move) for move in moves)


#: An element of a page, the end of a string and of a section in an IFC file, and a formula.
HOSTILE = "=1+1<img src=x onerror=alert(1)>');ENDSEC;"


def hostile(program: Path, samples: Path, folder: Path) -> None:
    """Names that would do harm come through to each program as text."""
    mesh = folder / f"*STEP {HOSTILE}.obj"
    mesh.write_text((samples / "single_bar.obj").read_text())
    profiles = folder / "profiles.csv"
    profiles.write_text(f"# family: mine\nname,shape,d\n{HOSTILE},round,8\n")
    options = ["--catalogue", str(profiles), "--profile", "catalogue:mine", "--material", HOSTILE]
    check(export(program, mesh, folder, *options) == 1, "hostile names: one beam")
    check_dxf(mesh.with_suffix(".dxf"), 1)
    check_ifc(mesh.with_suffix(".ifc"), 1)
    model = ifcopenshell.open(mesh.with_suffix(".ifc"))
    materials = [m.Name for m in model.by_type("IfcMaterial")]
    check(materials == [HOSTILE], f"hostile names: the material is {materials}")
    plain = mesh.with_suffix(".inp").rename(folder / "hostile.inp")
    check(0 < solve(plain, 100) < 1, "hostile names: solved")


def main() -> None:
    program, samples = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for sample, options in [
            ("single_bar", []),
            ("quadpod", ["--profile", "catalogue:ipe,upe,l,shs,chs", "--joints", "trim"]),
            ("cantilever", []),
            ("four_fixings", ["--profile", "freeform", "--joints", "sphere"]),
        ]:
            beams = export(program, samples / f"{sample}.obj", folder, *options)
            check_dxf(folder / f"{sample}.dxf", beams)
            check_ifc(folder / f"{sample}.ifc", beams)
        # A round bar of radius 4 and length 80 mm, E 210 GPa; the solid elements a beam is expanded
        # to are a few per cent off.
        exact = 100 * 80**3 / (3 * 210_000 * math.pi * 4**4 / 4)
        found = solve(folder / "single_bar.inp", 100)
        check(
            abs(found / exact - 1) < 0.03, f"bar bends by {found:.4f} mm, beam theory {exact:.4f}"
        )
        found = solve(folder / "cantilever.inp", 1)
        check(0 < found < 1, f"cantilever gives way by {found:.2e} mm under 1 N")
        hostile(program, samples, folder)


if __name__ == "__main__":
    main()
