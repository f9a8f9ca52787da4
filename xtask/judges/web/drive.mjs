// Drives the page in a browser: node drive.mjs TASK.json, in a folder where the package playwright-core is installed. The task says
// {url, brokenUrl, browser, strokes, examples, out}; `strokes` is a list of lists of points, `examples` a folder of files. What was seen is
// written to OUT/seen.json, with the recorded strokes, the saved drawing and pictures beside it. Goes on after a step in which something is
// not as it must be, and ends with 1 then.
import { writeFileSync } from "node:fs";

import { drawsAndSaves, drawsByWebGpu, survivesItsWorker } from "./drawing.mjs";
import { takesFiles } from "./files.mjs";
import { drawsByPen, drawsByTouch, keepsGesturesOff } from "./hands.mjs";
import { keepsTexts, keepsTheDrawing, setsAside } from "./keeping.mjs";
import { keepsPace } from "./pace.mjs";
import { NO_GRAPHICS, out, task } from "./page.mjs";
import { saysSo, saysSoLater, showsItsProgress } from "./trouble.mjs";

const seen = {};
const steps = [
  ["draws and saves", () => drawsAndSaves(seen)],
  ["draws by WebGPU", () => drawsByWebGpu(seen)],
  ["keeps pace", () => keepsPace(seen)],
  ["takes files", () => takesFiles(seen)],
  ["draws by touch", () => drawsByTouch(seen)],
  ["draws by pen", () => drawsByPen(seen)],
  ["shows its progress", () => showsItsProgress(seen)],
  ["survives its worker", () => survivesItsWorker(seen)],
  ["keeps the drawing", () => keepsTheDrawing(seen)],
  ["sets aside", () => setsAside(seen)],
  ["keeps texts", () => keepsTexts(seen)],
  ["keeps gestures off", () => keepsGesturesOff()],
  ["damaged program", () => saysSo(seen, "damaged", "could not be loaded", { dark: true }, undefined, task.brokenUrl)],
  ["no graphics", () => saysSo(seen, "no-graphics", "No graphics", { graphics: NO_GRAPHICS })],
  ["panic", () => saysSoLater(seen)],
  ["no WebAssembly", () => saysSo(seen, "no-wasm", "cannot run", {}, (page) => page.addInitScript(() => delete window.WebAssembly))],
];
for (const [name, step] of steps) {
  if (task.only && task.only !== name) continue;
  const begun = Date.now();
  try {
    await step();
    console.log(`${name}: as it must be, ${((Date.now() - begun) / 1000).toFixed(1)} s`);
  } catch (error) {
    console.log(`FAULT in "${name}": ${error.message ?? error}`);
    process.exitCode = 1;
  }
}
writeFileSync(out("seen.json"), JSON.stringify(seen, null, 1));
