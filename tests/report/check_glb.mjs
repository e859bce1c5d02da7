// SPDX-License-Identifier: MIT OR Apache-2.0
// Holds the 3D scenes of three samples against the Khronos glTF validator: no error, no warning.
//
//     node check_glb.mjs PROGRAM SAMPLES
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import validator from "gltf-validator";

const [program, samples] = process.argv.slice(2);
const folder = mkdtempSync(join(tmpdir(), "beamwright-"));
let faults = 0;
try {
  for (const sample of ["single_bar", "cantilever", "quadpod"]) {
    const scene = join(folder, `${sample}.glb`);
    const step = join(folder, `${sample}.step`);
    const mesh = join(samples, `${sample}.obj`);
    execFileSync(program, ["reconstruct", mesh, "-o", step, "--export", scene, "-q"]);
    const { issues, info } = await validator.validateBytes(readFileSync(scene), { maxIssues: 20 });
    const { numErrors, numWarnings, messages } = issues;
    console.log(`${sample}: ${info.totalTriangleCount} triangles, ${numErrors} errors, ${numWarnings} warnings`);
    for (const { pointer, message } of messages) console.log(`  ${pointer}: ${message}`);
    faults += numErrors + numWarnings;
  }
} finally {
  rmSync(folder, { recursive: true });
}
process.exit(faults > 0 ? 1 : 0);
