// Validates glTF files: node judge.mjs FILE… A line for each file with its numbers of errors, warnings and hints; ends with 1 if any
// file has an error or a warning. Run in a folder where the package gltf-validator is installed.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { basename, join } from "node:path";

const validator = createRequire(join(process.cwd(), "package.json"))("gltf-validator");
const files = process.argv.slice(2);
let faults = files.length === 0 ? 1 : 0;
for (const file of files) {
  try {
    const { issues, info } = await validator.validateBytes(new Uint8Array(readFileSync(file)), { maxIssues: 100 });
    faults += issues.numErrors + issues.numWarnings;
    const counts = `${issues.numErrors} errors, ${issues.numWarnings} warnings, ${issues.numInfos + issues.numHints} hints`;
    console.log(`${basename(file)}: ${counts}; ${info.drawCallCount} meshes, ${info.totalTriangleCount} triangles`);
    for (const m of issues.messages.slice(0, 10)) console.log(`  ${m.code} ${m.pointer ?? ""} ${m.message}`);
  } catch (error) {
    faults += 1;
    console.log(`${basename(file)}: not glTF: ${error}`);
  }
}
process.exitCode = faults === 0 ? 0 : 1;
