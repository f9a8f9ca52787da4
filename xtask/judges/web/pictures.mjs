// The pictures of the page for the documents: node pictures.mjs TASK.json, in a folder where the package playwright-core is installed. The
// task says {url, browser, examples, out}; the pictures go into the folder `out` as web-NAME.png. All is done by mouse, keys and files.
import { readFileSync } from "node:fs";
import { join } from "node:path";

import { chooseFile, draw, frameShown, inWindow, openedBlank, openedWell, out, placeOf, press, recorded, settled, state, task, wait, withPage } from "./page.mjs";

const SIZE = [1180, 740];

/** The example of a first start, all of it computed. */
async function opened(page) {
  await openedWell(page);
  await settled(page, (await state(page)).strokes);
}

/** Selects a curve as a person does, by pressing where its stroke was drawn; not everywhere is the curve near enough to that. */
async function select(page, index) {
  await keys(page, "v");
  // What was imported is selected, all of it.
  await page.mouse.click(110, SIZE[1] - 30);
  const { points } = (await recorded(page))[index];
  for (const place of await inWindow(page, points.filter((_, i) => i % 7 === 3))) {
    await page.mouse.click(...place);
    await frameShown(page);
    if ((await named(page)).includes("Segments")) return;
  }
  throw new Error(`curve ${index + 1} cannot be selected`);
}

/** Presses keys, each seen by a frame of its own. */
async function keys(page, ...pressed) {
  for (const key of pressed) {
    await page.keyboard.press(key);
    await frameShown(page);
  }
}

/** Everything of the interface that has a name. */
async function named(page) {
  await placeOf(page, "Menu");
  return page.evaluate(() => JSON.parse(window.fairpath.named()).map(({ name }) => name));
}

/** Strokes of an example instead of what is there. */
async function imported(page, name, wanted = () => true) {
  const file = JSON.parse(readFileSync(join(task.examples, name), "utf8"));
  file.strokes = file.strokes.filter((stroke) => wanted(stroke.name));
  await chooseFile(page, /^Import…/, { name, mimeType: "application/json", buffer: Buffer.from(JSON.stringify(file)) });
  await settled(page, file.strokes.length);
}

/** The pointer out of everything's way, and nothing said any more. */
async function quiet(page) {
  await page.mouse.move(SIZE[0] / 2, SIZE[1] - 90);
  for (let left = 60; left > 0 && (await named(page)).some((name) => / from .*json/.test(name)); left -= 1) await wait(500);
}

const scenes = {
  "first-start": { scene: opened },
  combs: {
    scene: async (page) => {
      await openedBlank(page);
      await imported(page, "hello.json", (name) => name !== "hello" && name !== "star");
      await select(page, 1);
      await quiet(page);
      await keys(page, "3", "4", "5", "Control+0");
      // A little farther away, so that no panel lies over a curve.
      await page.mouse.move(590, 260);
      await page.mouse.wheel(0, 90);
      await wait(1000);
      await page.mouse.move(590, 500);
    },
  },
  oversketch: {
    scene: async (page) => {
      await openedBlank(page);
      const wave = Array.from({ length: 101 }, (_, i) => [180 + 8 * i, 400 + 90 * Math.sin(i / 16)]);
      await draw(page, wave);
      await settled(page, 1);
      const [from, to] = [wave[34], wave[66]];
      const bulge = Array.from({ length: 41 }, (_, i) => {
        const t = i / 40;
        return [from[0] + t * (to[0] - from[0]), from[1] + t * (to[1] - from[1]) - 70 * Math.sin(Math.PI * t)];
      });
      await page.mouse.move(...bulge[0]);
      await page.mouse.down();
      for (const point of bulge.slice(1)) await page.mouse.move(...point);
      await wait(1000);
    },
  },
  "french-curves": {
    scene: async (page) => {
      await openedBlank(page);
      await press(page, "Method");
      await press(page, "French curves");
      await imported(page, "hello.json", (name) => name === "letter S" || name === "bend");
      await select(page, 0);
      await keys(page, "5", "6");
      await quiet(page);
    },
  },
  surface: {
    scene: async (page) => {
      await openedBlank(page);
      await imported(page, "duck.json");
      await select(page, 0);
      await keys(page, "i");
      await placeOf(page, /triangles$/);
      await page.keyboard.press("Control+0");
      await quiet(page);
    },
  },
  dark: {
    dark: true,
    scene: async (page) => {
      await opened(page);
      await select(page, 3);
      await keys(page, "5");
    },
  },
};

for (const [name, { dark, scene }] of Object.entries(scenes)) {
  if (task.only && task.only !== name) continue;
  await withPage({ dark, size: SIZE }, async (page) => {
    await scene(page);
    await wait(1000);
    await page.screenshot({ path: out(`web-${name}.png`) });
    console.log(`wrote docs/web-${name}.png`);
  });
}
