// The Khronos validator on .glb files: no error, no warning.
//
//   node check_glb.mjs FILE.glb…
import { readFileSync } from "node:fs";
import { validateBytes } from "gltf-validator";

let failed = 0;
const files = process.argv.slice(2);
for (const file of files) {
  const { issues } = await validateBytes(new Uint8Array(readFileSync(file)));
  const { numErrors, numWarnings } = issues;
  console.log(`${file}: ${numErrors} errors, ${numWarnings} warnings`);
  if (numErrors + numWarnings > 0) {
    failed += 1;
    console.error(JSON.stringify(issues.messages.slice(0, 5), null, 1));
  }
}
console.log(`${files.length - failed} passed, ${failed} failed`);
process.exitCode = failed ? 1 : 0;
