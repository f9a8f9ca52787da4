// Drives the page in a browser: node drive.mjs TASK.json, in a folder where the package playwright-core is installed. The task says
// {url, brokenUrl, browser, strokes, out}; `strokes` is a list of lists of points. What was seen is written to OUT/seen.json, with the
// recorded strokes, the saved drawing and pictures beside it. Ends with 1 at the first thing that is not as it must be.
import { readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";

const { chromium } = createRequire(join(process.cwd(), "package.json"))("playwright-core");
const task = JSON.parse(readFileSync(process.argv[2], "utf8"));
const out = (name) => join(task.out, name);

const READY_WITHIN_MS = 60_000;
const FIT_WITHIN_MS = 60_000;
// WebGL 2 by a renderer in software: the same pictures on every machine, with or without a graphics card.
const SOFTWARE_GRAPHICS = ["--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"];
const SOFTWARE_WEBGPU = [
  "--enable-unsafe-webgpu", "--use-webgpu-adapter=swiftshader", "--use-vulkan=swiftshader", "--disable-vulkan-surface",
  "--enable-features=Vulkan", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist",
];
const NO_GRAPHICS = ["--disable-gpu", "--disable-software-rasterizer", "--disable-3d-apis"];
const QUIET = [
  "--no-sandbox", "--disable-gpu-sandbox", "--disable-quic", "--no-first-run", "--disable-background-networking",
  "--disable-component-update", "--disable-sync",
];

function must(condition, what) {
  if (!condition) throw new Error(what);
}

/** Runs `body` with a page of a fresh browser, which is closed whatever happens. */
async function withPage({ graphics = SOFTWARE_GRAPHICS, dark = false }, body) {
  const browser = await chromium.launch({ executablePath: task.browser, args: [...QUIET, ...graphics] });
  try {
    const context = await browser.newContext({
      viewport: { width: 1000, height: 700 }, colorScheme: dark ? "dark" : "light", acceptDownloads: true,
    });
    const page = await context.newPage();
    const log = { errors: [], elsewhere: [] };
    page.on("pageerror", (error) => log.errors.push(String(error)));
    page.on("console", (message) => message.type() === "error" && log.errors.push(message.text()));
    page.on("request", (request) => {
      const to = new URL(request.url());
      if (to.protocol.startsWith("http") && to.host !== new URL(task.url).host && to.host !== new URL(task.brokenUrl).host) {
        log.elsewhere.push(request.url());
      }
    });
    return await body(page, log);
  } finally {
    await browser.close();
  }
}

const state = (page) => page.evaluate(() => JSON.parse(window.fairpath.state() ?? "null"));

async function open(page, url = task.url) {
  await page.goto(url, { waitUntil: "commit" });
  await page.waitForFunction(() => window.fairpath?.ready || window.fairpath?.trouble, undefined, { timeout: READY_WITHIN_MS });
  return page.evaluate(() => ({ readyMs: window.fairpath.readyMs, trouble: window.fairpath.trouble }));
}

async function openedWell(page, url) {
  const opened = await open(page, url);
  must(!opened.trouble, `the page says: ${JSON.stringify(opened.trouble)}`);
  return opened;
}

/** The page with an empty drawing: what it begins with is deleted, as a person would. */
async function openedBlank(page) {
  const opened = await openedWell(page);
  const begun = await state(page);
  must(begun.strokes > 0, "there is nothing to see at a first start");
  await settled(page, begun.strokes);
  await page.keyboard.press("Control+a");
  await page.keyboard.press("Delete");
  await settled(page, 0);
  return opened;
}

/** Draws one stroke with the mouse, every point an event of its own, all sent at once as a quick device does. */
async function draw(page, points) {
  await page.mouse.move(...points[0]);
  await page.mouse.down();
  await Promise.all(points.slice(1).map((point) => page.mouse.move(...point)));
  await page.mouse.up();
}

/** Waits until as many curves are there as strokes. */
async function settled(page, strokes) {
  const done = (count) => {
    const state = JSON.parse(window.fairpath.state() ?? "null");
    return state && state.strokes === count && !state.busy;
  };
  try {
    await page.waitForFunction(done, strokes, { timeout: FIT_WITHIN_MS });
  } catch {
    throw new Error(`${strokes} strokes were drawn, and the page stays at ${JSON.stringify(await state(page))}`);
  }
  return state(page);
}

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

async function drawsAndSaves(seen) {
  await withPage({}, async (page, log) => {
    seen.readyMs = (await openedBlank(page)).readyMs;
    const before = await page.screenshot({ path: out("ready.png") });
    for (const points of task.strokes) await draw(page, points);
    seen.state = await settled(page, task.strokes.length);
    const recorded = await page.evaluate(() => window.fairpath.strokes());
    writeFileSync(out("recorded.json"), recorded);
    seen.recordedWithinPx = recordedWithin(task.strokes, JSON.parse(recorded).strokes, seen.state.pixel_size);
    must(seen.recordedWithinPx < 1e-3, `places are recorded with an error of ${seen.recordedWithinPx} px`);
    const [download] = await Promise.all([page.waitForEvent("download", { timeout: 10_000 }), page.evaluate(() => window.fairpath.saveSvg())]);
    await download.saveAs(out("saved.svg"));
    seen.savedAs = download.suggestedFilename();
    must(seen.savedAs.endsWith(".svg"), `the drawing is saved as ${seen.savedAs}`);
    await mustShow(seen, page, before, await page.screenshot({ path: out("drawn.png") }));
    must(log.errors.length === 0, `the page complains: ${log.errors.join("; ")}`);
    must(log.elsewhere.length === 0, `the page asks other hosts: ${log.elsewhere.join(" ")}`);
  });
}

/** Where the browser has WebGPU it is what the page draws with; screenshots are blank there, so the canvas itself is read. */
async function drawsByWebGpu(seen) {
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

/** While it loads the page says how much of how much it has. */
async function showsItsProgress(seen) {
  await withPage({}, async (page) => {
    const session = await page.context().newCDPSession(page);
    await session.send("Network.enable");
    await session.send("Network.emulateNetworkConditions", { offline: false, latency: 20, downloadThroughput: 1e6, uploadThroughput: 1e6 });
    await page.goto(task.url, { waitUntil: "commit" });
    await page.waitForFunction(() => document.getElementById("progress")?.value > 0.4, undefined, { timeout: READY_WITHIN_MS });
    seen.loading = await page.textContent("#amount");
    must(/^\d+\.\d of \d+\.\d MB$/.test(seen.loading), `while it loads the page says "${seen.loading}"`);
    must(await page.isVisible("#progress"), "no progress is shown");
    await page.screenshot({ path: out("loading.png") });
    await page.waitForFunction(() => window.fairpath?.ready, undefined, { timeout: READY_WITHIN_MS });
    must(!(await page.isVisible("#curtain")), "the loading page stays in front of the application");
  });
}

/** A worker that dies is replaced, and what is drawn afterwards still becomes a curve. */
async function survivesItsWorker(seen) {
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
    await page.evaluate(() => new Promise((resolve) => setTimeout(resolve, 500)));
    // Far from the first, or it might be taken for a correction of it.
    await draw(page, Array.from({ length: 80 }, (_, i) => [350 + 4 * i, 540 + 40 * Math.sin(i / 9)]));
    await settled(page, 2);
    seen.workers = await page.evaluate(() => window.workers.length);
    must(seen.workers === 2, `${seen.workers} workers were made; the first was killed, so there must be two`);
    await page.screenshot({ path: out("dark.png") });
  });
}

/** The drawing is there again after the page was left, and goes out by the keys for saving. */
async function keepsTheDrawing(seen) {
  await withPage({}, async (page) => {
    await openedBlank(page);
    await draw(page, task.strokes[0]);
    await settled(page, 1);
    const strokes = await page.evaluate(() => window.fairpath.strokes());
    await page.evaluate(async () => {
      const end = performance.now() + 20_000;
      const kept = async () => JSON.parse((await window.fairpath.loadText("drawing")) ?? "null")?.strokes.strokes.length === 1;
      while (!(await kept())) {
        if (performance.now() > end) throw new Error("the drawing is not kept within 20 s");
        await new Promise((resolve) => setTimeout(resolve, 200));
      }
    });
    await openedWell(page);
    await settled(page, 1);
    must((await page.evaluate(() => window.fairpath.strokes())) === strokes, "the drawing that is back is another one");
    const [download] = await Promise.all([page.waitForEvent("download", { timeout: 10_000 }), page.keyboard.press("Control+s")]);
    await download.saveAs(out("saved.json"));
    const saved = JSON.parse(readFileSync(out("saved.json"), "utf8"));
    must(JSON.stringify(saved.strokes) === JSON.stringify(JSON.parse(strokes)), "the saved drawing is another one");
    seen.savedDrawing = download.suggestedFilename();
  });
}

/** Texts of many megabytes are there again after the page was left. */
async function keepsTexts(seen) {
  // Twenty million characters, one in ten of which takes two bytes.
  const makeText = () => {
    window.longText = () => Array.from({ length: 2_000_000 }, (_, i) => String(i).padStart(9, "0") + "é").join("");
  };
  await withPage({}, async (page) => {
    await page.addInitScript(makeText);
    await openedWell(page);
    await page.evaluate(() => {
      const { saveText } = window.fairpath;
      // Not one after the other: calls must take effect in their order all the same.
      return Promise.all([saveText("judge", "old"), saveText("judge", window.longText())]);
    });
    await openedWell(page);
    seen.keptCharacters = await page.evaluate(async () => {
      const kept = await window.fairpath.loadText("judge");
      return kept === window.longText() ? kept.length : -1;
    });
    must(seen.keptCharacters === 20_000_000, "a text is not kept as it was saved");
    const left = await page.evaluate(() => window.fairpath.removeText("judge").then(() => window.fairpath.loadText("judge")));
    must(left === undefined, "a text that was removed is still there");
  });
}

/** Gestures of the browser that would disturb drawing do nothing on the canvas. */
async function keepsGesturesOff() {
  await withPage({}, async (page) => {
    await openedWell(page);
    await settled(page, (await state(page)).strokes);
    await page.screenshot({ path: out("first.png") });
    const prevented = await page.evaluate(() => {
      const canvas = document.getElementById("canvas");
      const events = [
        new WheelEvent("wheel", { ctrlKey: true, deltaY: 100, bubbles: true, cancelable: true }),
        new MouseEvent("contextmenu", { bubbles: true, cancelable: true }),
        new DragEvent("dragstart", { bubbles: true, cancelable: true }),
      ];
      return events.map((event) => (canvas.dispatchEvent(event), event.defaultPrevented));
    });
    must(prevented.every(Boolean), `the browser's own zoom, menu or dragging is not kept off: ${prevented}`);
    const action = await page.evaluate(() => getComputedStyle(document.getElementById("canvas")).touchAction);
    must(action === "none", `touches over the canvas scroll the page: touch-action is ${action}`);
  });
}

/** Where the page cannot work it says so, under a title with these words. */
async function saysSo(seen, name, words, options, prepare, url = task.url) {
  await withPage(options, async (page) => {
    await prepare?.(page);
    const { trouble } = await open(page, url);
    must(trouble, `${name}: the page claims to be well`);
    must(trouble.title.includes(words), `${name}: the page says "${trouble.title}", not "${words}"`);
    must(await page.isVisible("#trouble-remedy"), `${name}: the message is not shown`);
    await page.screenshot({ path: out(`${name}.png`) });
    (seen.troubles ??= {})[name] = trouble;
  });
}

/** What the page shows when the program calls its last word. */
async function saysSoLater(seen) {
  await withPage({}, async (page) => {
    await openedWell(page);
    await page.evaluate(() => globalThis.fairpathPanicked("the judge says so"));
    must(await page.isVisible("#trouble-remedy"), "a panic is not told");
    must((await page.textContent("#trouble-details")) === "the judge says so", "the message of a panic is not shown");
    await page.click("summary");
    await page.screenshot({ path: out("panic.png") });
    await page.click("#reload");
    await page.waitForFunction(() => window.fairpath?.ready, undefined, { timeout: READY_WITHIN_MS });
    seen.panicTold = true;
  });
}

const seen = {};
const steps = [
  ["draws and saves", () => drawsAndSaves(seen)],
  ["draws by WebGPU", () => drawsByWebGpu(seen)],
  ["shows its progress", () => showsItsProgress(seen)],
  ["survives its worker", () => survivesItsWorker(seen)],
  ["keeps the drawing", () => keepsTheDrawing(seen)],
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
    console.log(`${name}: ${error.message ?? error}`);
    process.exitCode = 1;
  }
}
writeFileSync(out("seen.json"), JSON.stringify(seen, null, 1));
