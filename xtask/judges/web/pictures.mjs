// The pictures of the page for the documents: node pictures.mjs TASK.json, in a folder where the package playwright-core is installed. The
// task says {url, browser, examples, out}; the pictures go into the folder `out` as web-NAME.png. All is done by mouse, keys and files.
import { readFileSync } from "node:fs";
import { join } from "node:path";

import { chooseFile, draw, inWindow, openedBlank, openedWell, out, placeOf, press, recorded, settled, state, task, wait, withPage } from "./page.mjs";

const SIZE = [1180, 740];

/** The example of a first start, all of it computed. */
async function opened(page) {
  await openedWell(page);
  await settled(page, (await state(page)).strokes);
}

/** Selects a curve as a person does, by the place where its stroke begins. */
async function select(page, index) {
  await page.keyboard.press("v");
  const { points } = (await recorded(page))[index];
  const [place] = await inWindow(page, [points[Math.floor(points.length / 3)]]);
  await page.mouse.click(...place);
  await wait(300);
}

/** Strokes of an example instead of what is there. */
async function imported(page, name, wanted = () => true) {
  const file = JSON.parse(readFileSync(join(task.examples, name), "utf8"));
  file.strokes = file.strokes.filter((stroke) => wanted(stroke.name));
  await chooseFile(page, /^Import/, { name, mimeType: "application/json", buffer: Buffer.from(JSON.stringify(file)) });
  await settled(page, file.strokes.length);
}

/** Out of everything's way, until nothing is said any more. */
async function quiet(page) {
  await page.mouse.move(SIZE[0] / 2, SIZE[1] - 90);
  await wait(7000);
}

const scenes = {
  "first-start": { scene: opened },
  combs: {
    scene: async (page) => {
      await opened(page);
      await select(page, 0);
      for (const key of ["3", "4"]) await page.keyboard.press(key);
      await page.keyboard.press("Control+0");
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
      await quiet(page);
    },
  },
  surface: {
    scene: async (page) => {
      await openedBlank(page);
      await imported(page, "duck.json");
      await select(page, 0);
      await page.keyboard.press("i");
      await placeOf(page, /triangles$/);
      await quiet(page);
    },
  },
  dark: {
    dark: true,
    scene: async (page) => {
      await opened(page);
      await select(page, 3);
      await page.keyboard.press("3");
    },
  },
};

for (const [name, { dark, scene }] of Object.entries(scenes)) {
  if (task.only && task.only !== name) continue;
  await withPage({ dark, size: SIZE }, async (page) => {
    await scene(page);
    await wait(500);
    await page.screenshot({ path: out(`web-${name}.png`) });
    console.log(`wrote docs/web-${name}.png`);
  });
}
