// A page of the application in a browser, and what a person does there: opening it, drawing, pressing what has a name. The task is the file
// that the command line names; the package playwright-core is installed in the folder where node runs.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";

const { chromium } = createRequire(join(process.cwd(), "package.json"))("playwright-core");
/** What is to be done: at least {url, browser, out}. */
export const task = JSON.parse(readFileSync(process.argv[2], "utf8"));
export const out = (name) => join(task.out, name);

export const READY_WITHIN_MS = 60_000;
const FIT_WITHIN_MS = 60_000;
const SHOWN_WITHIN_MS = 15_000;
// WebGL 2 by a renderer in software: the same pictures on every machine, with or without a graphics card.
const SOFTWARE_GRAPHICS = ["--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"];
export const SOFTWARE_WEBGPU = [
  "--enable-unsafe-webgpu", "--use-webgpu-adapter=swiftshader", "--use-vulkan=swiftshader", "--disable-vulkan-surface",
  "--enable-features=Vulkan", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist",
];
export const NO_GRAPHICS = ["--disable-gpu", "--disable-software-rasterizer", "--disable-3d-apis"];
const QUIET = [
  "--no-sandbox", "--disable-gpu-sandbox", "--disable-quic", "--no-first-run", "--disable-background-networking",
  "--disable-component-update", "--disable-sync",
];

export function must(condition, what) {
  if (!condition) throw new Error(what);
}

/** Runs `body` with a page of a fresh browser, which is closed whatever happens. */
export async function withPage({ graphics = SOFTWARE_GRAPHICS, dark = false, touch = false, size = [1000, 700] }, body) {
  const browser = await chromium.launch({ executablePath: task.browser, args: [...QUIET, ...graphics] });
  try {
    const context = await browser.newContext({
      viewport: { width: size[0], height: size[1] }, colorScheme: dark ? "dark" : "light", hasTouch: touch, acceptDownloads: true,
    });
    const page = await context.newPage();
    const log = { errors: [], elsewhere: [] };
    page.on("pageerror", (error) => log.errors.push(String(error)));
    page.on("console", (message) => message.type() === "error" && log.errors.push(message.text()));
    page.on("request", (request) => {
      const to = new URL(request.url());
      const own = [task.url, task.brokenUrl].some((url) => url && new URL(url).host === to.host);
      if (to.protocol.startsWith("http") && !own) log.elsewhere.push(request.url());
    });
    return await body(page, log);
  } finally {
    await browser.close();
  }
}

export const wait = (ms) => new Promise((resolve) => setTimeout(resolve, ms));

export const state = (page) => page.evaluate(() => JSON.parse(window.fairpath.state() ?? "null"));

export async function open(page, url = task.url) {
  await page.goto(url, { waitUntil: "commit" });
  await page.waitForFunction(() => window.fairpath?.ready || window.fairpath?.trouble, undefined, { timeout: READY_WITHIN_MS });
  return page.evaluate(() => ({ readyMs: window.fairpath.readyMs, trouble: window.fairpath.trouble }));
}

export async function openedWell(page, url) {
  const opened = await open(page, url);
  must(!opened.trouble, `the page says: ${JSON.stringify(opened.trouble)}`);
  return opened;
}

/** The page with an empty drawing: what it begins with is deleted, as a person would. */
export async function openedBlank(page) {
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
export async function draw(page, points) {
  await page.mouse.move(...points[0]);
  await page.mouse.down();
  await Promise.all(points.slice(1).map((point) => page.mouse.move(...point)));
  await page.mouse.up();
}

/** Waits until as many curves are there as strokes. */
export async function settled(page, strokes) {
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

/** The strokes as the page recorded them. */
export const recorded = async (page) => JSON.parse(await page.evaluate(() => window.fairpath.strokes())).strokes;

/** Waits until what was done so far has been taken by a frame. */
export const frameShown = (page) => page.evaluate(() => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))));

/** Where something lies that is called so, or whose name matches; waits until it is there and stands still. */
export async function placeOf(page, wanted) {
  const isIt = ({ name }) => (wanted instanceof RegExp ? wanted.test(name) : name.trim() === wanted);
  const end = Date.now() + SHOWN_WITHIN_MS;
  for (let before = null; ; ) {
    const named = await page.evaluate(() => JSON.parse(window.fairpath.named()));
    const found = named.find(isIt);
    if (found && before && JSON.stringify(found) === before) return found;
    before = JSON.stringify(found);
    must(Date.now() < end, `nothing is called ${wanted}, but there are: ${named.map(({ name }) => name).join(", ")}`);
    await wait(60);
  }
}

/** Presses what is called so, with the mouse. */
export async function press(page, wanted) {
  const { x, y, width, height } = await placeOf(page, wanted);
  await page.mouse.click(x + width / 2, y + height / 2);
}

/** Chooses a file by an entry of the menu. */
export async function chooseFile(page, entry, file) {
  await press(page, "Menu");
  await placeOf(page, entry);
  const [chooser] = await Promise.all([page.waitForEvent("filechooser", { timeout: SHOWN_WITHIN_MS }), press(page, entry)]);
  await chooser.setFiles(file);
}

/** Where places of the drawing are in the window. */
export async function inWindow(page, points) {
  const { corner, pixel_size } = await state(page);
  return points.map(([x, y]) => [(x - corner[0]) / pixel_size, (y - corner[1]) / pixel_size]);
}
