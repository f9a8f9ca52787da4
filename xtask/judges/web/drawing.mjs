// What is drawn becomes curves and is seen, by whatever the browser draws with and whatever becomes of the worker.
import { writeFileSync } from "node:fs";

import { SOFTWARE_WEBGPU, draw, must, openedBlank, out, settled, task, wait, withPage } from "./page.mjs";
import { exportedSvg } from "./files.mjs";

/** How far the recorded strokes are from those that were drawn, in px; where in the drawing the view is does not matter. */
function recordedWithin(drawn, recorded, pixelSize) {
  must(recorded.length === drawn.length, `${drawn.length} strokes were drawn and ${recorded.length} recorded`);
  let worst = 0;
  drawn.forEach((points, i) => {
    const kept = recorded[i].points;
    // The last point comes twice: by the last move and by the lifting.
    must(kept.length >= points.length && kept.length <= points.length + 1,
      `stroke ${i + 1} was drawn with ${points.length} points and recorded with ${kept.length}`);
    points.forEach(([x, y], k) => {
      const from = (i, start, place) => (kept[k][i] - kept[0][i]) / pixelSize - (place - start);
      const off = [from(0, points[0][0], x), from(1, points[0][1], y)];
      worst = Math.max(worst, Math.hypot(...off));
      must(k === 0 || kept[k][2] >= kept[k - 1][2], `time runs backwards in stroke ${i + 1}`);
    });
  });
  return worst;
}

/** How many pixels differ visibly between two pictures, given as PNG. */
function changed(page, before, after) {
  return page.evaluate(async (pictures) => {
    const pixels = async (png) => {
      const image = new Image();
      image.src = "data:image/png;base64," + png;
      await image.decode();
      const { width, height } = image;
      const context = new OffscreenCanvas(width, height).getContext("2d");
      context.drawImage(image, 0, 0);
      return context.getImageData(0, 0, width, height).data;
    };
    const [a, b] = await Promise.all(pictures.map(pixels));
    let count = 0;
    for (let i = 0; i < a.length; i += 4) {
      if ([0, 1, 2].some((k) => Math.abs(a[i + k] - b[i + k]) > 30)) count += 1;
    }
    return count;
  }, [before, after].map((png) => png.toString("base64")));
}

/** Fails unless at least half of the strokes' length left its mark, a pixel wide. */
async function mustShow(seen, page, before, after) {
  const step = ([x, y], [u, v]) => Math.hypot(u - x, v - y);
  const lengths = task.strokes.map((points) => points.slice(1).reduce((sum, point, i) => sum + step(points[i], point), 0));
  const drawn = lengths.reduce((sum, length) => sum + length, 0);
  seen.changedPixels = await changed(page, before, after);
  must(seen.changedPixels > drawn / 2, `${drawn.toFixed(0)} px were drawn, and ${seen.changedPixels} pixels look different`);
}

export async function drawsAndSaves(seen) {
  await withPage({}, async (page, log) => {
    seen.readyMs = (await openedBlank(page)).readyMs;
    const before = await page.screenshot({ path: out("ready.png") });
    for (const points of task.strokes) await draw(page, points);
    seen.state = await settled(page, task.strokes.length);
    const recorded = await page.evaluate(() => window.fairpath.strokes());
    writeFileSync(out("recorded.json"), recorded);
    seen.recordedWithinPx = recordedWithin(task.strokes, JSON.parse(recorded).strokes, seen.state.pixel_size);
    must(seen.recordedWithinPx < 1e-3, `places are recorded with an error of ${seen.recordedWithinPx} px`);
    await mustShow(seen, page, before, await page.screenshot({ path: out("drawn.png") }));
    seen.savedAs = await exportedSvg(page, out("saved.svg"));
    must(log.errors.length === 0, `the page complains: ${log.errors.join("; ")}`);
    must(log.elsewhere.length === 0, `the page asks other hosts: ${log.elsewhere.join(" ")}`);
  });
}

/** Where the browser has WebGPU it is what the page draws with; screenshots are blank there, so the canvas itself is read. */
export async function drawsByWebGpu(seen) {
  await withPage({ graphics: SOFTWARE_WEBGPU }, async (page, log) => {
    await page.addInitScript(() => {
      const getContext = HTMLCanvasElement.prototype.getContext;
      window.contexts = [];
      HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
        window.contexts.push(kind);
        return getContext.call(this, kind, ...rest);
      };
    });
    await openedBlank(page);
    seen.webGpu = await page.evaluate(async () => Boolean(await navigator.gpu?.requestAdapter()));
    if (!seen.webGpu) return console.log("draws by WebGPU: this browser has none here");
    const contexts = await page.evaluate(() => window.contexts);
    must(contexts.length === 1 && contexts[0] === "webgpu", `with WebGPU there the page draws by ${contexts}`);
    const canvas = async (name) => {
      const url = await page.evaluate(() => new Promise((resolve) => {
        // A frame is asked for by a move over the canvas, and read before the browser takes it away.
        const target = document.getElementById("canvas");
        target.dispatchEvent(new MouseEvent("mousemove", { clientX: 5, clientY: 350, bubbles: true }));
        requestAnimationFrame(() => requestAnimationFrame(() => resolve(target.toDataURL("image/png"))));
      }));
      const png = Buffer.from(url.split(",")[1], "base64");
      writeFileSync(out(name), png);
      return png;
    };
    const before = await canvas("webgpu-ready.png");
    for (const points of task.strokes) await draw(page, points);
    await settled(page, task.strokes.length);
    await mustShow({}, page, before, await canvas("webgpu-drawn.png"));
    must(log.errors.length === 0, `the page complains: ${log.errors.join("; ")}`);
  });
}

/** A worker that dies is replaced, and what is drawn afterwards still becomes a curve. */
export async function survivesItsWorker(seen) {
  await withPage({ dark: true }, async (page) => {
    await page.addInitScript(() => {
      window.workers = [];
      window.Worker = class extends window.Worker {
        constructor(...args) {
          super(...args);
          window.workers.push(this);
        }
      };
    });
    await openedBlank(page);
    await draw(page, task.strokes[0]);
    await settled(page, 1);
    // No job at all: the program's own door refuses it.
    await page.evaluate(() => window.workers[0].postMessage(["1000000", null]));
    await wait(500);
    // Far from the first, or it might be taken for a correction of it.
    await draw(page, Array.from({ length: 80 }, (_, i) => [350 + 4 * i, 540 + 40 * Math.sin(i / 9)]));
    await settled(page, 2);
    seen.workers = await page.evaluate(() => window.workers.length);
    must(seen.workers === 2, `${seen.workers} workers were made; the first was killed, so there must be two`);
    await page.screenshot({ path: out("dark.png") });
  });
}

