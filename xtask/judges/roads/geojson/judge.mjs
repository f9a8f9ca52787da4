// Checks a GeoJSON file: node judge.mjs FILE. `fault:` lines are for people, the `note:` line comes last; ends with 1 if there is a fault.
// Run in a folder where the package @placemarkio/check-geojson is installed.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";

const { check } = createRequire(join(process.cwd(), "package.json"))("@placemarkio/check-geojson");
let faults = [];
let note = "not read to its end";
try {
  const object = check(readFileSync(process.argv[2], "utf8"));
  const features = object.type === "FeatureCollection" ? object.features : [object];
  const kinds = {};
  for (const feature of features) {
    const kind = feature.geometry?.type ?? feature.type;
    kinds[kind] = (kinds[kind] ?? 0) + 1;
  }
  if (features.length === 0) faults.push("no feature in it");
  note = Object.entries(kinds).map(([kind, count]) => `${count} ${kind}`).join(", ") || "empty";
} catch (error) {
  faults = (error.issues ?? [{ message: String(error) }]).map((issue) => `${issue.message} (byte ${issue.from ?? "?"})`);
}
for (const fault of faults) console.log(`fault: ${fault.replaceAll("\n", " ")}`);
console.log(`note: ${note}`);
process.exitCode = faults.length === 0 ? 0 : 1;
