// What is there again after the page was left, and what cannot be.
import { readFileSync } from "node:fs";

import { draw, must, openedBlank, openedWell, out, placeOf, settled, state, task, withPage } from "./page.mjs";

/** Waits until what the browser keeps of the drawing has as many strokes. */
function kept(page, strokes) {
  return page.evaluate(async (strokes) => {
    const end = performance.now() + 20_000;
    const kept = async () => {
      try {
        return JSON.parse((await window.fairpath.loadText("drawing")) ?? "null")?.strokes.strokes.length === strokes;
      } catch {
        return false; // What is kept so far is no drawing.
      }
    };
    while (!(await kept())) {
      if (performance.now() > end) throw new Error("the drawing is not kept within 20 s");
      await new Promise((resolve) => setTimeout(resolve, 200));
    }
  }, strokes);
}

/** The drawing is there again after the page was left, and goes out by the keys for saving. */
export async function keepsTheDrawing(seen) {
  await withPage({}, async (page) => {
    await openedBlank(page);
    await draw(page, task.strokes[0]);
    await settled(page, 1);
    const strokes = await page.evaluate(() => window.fairpath.strokes());
    await kept(page, 1);
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

/** A drawing that was kept and cannot be read is told of and set aside, and what is drawn from then on is kept. */
export async function setsAside(seen) {
  const damaged = '{"format":"fairpath-drawing","strokes":';
  await withPage({}, async (page) => {
    await openedWell(page);
    await page.evaluate((text) => window.fairpath.saveText("drawing", text), damaged);
    await openedWell(page);
    seen.setAside = (await placeOf(page, /It is set aside/)).name;
    const { strokes } = await settled(page, (await state(page)).strokes);
    must(strokes > 2, "what a first start shows is not shown in place of a damaged drawing");
    await page.screenshot({ path: out("set-aside.png") });
    await page.keyboard.press("Control+a");
    await page.keyboard.press("Delete");
    await draw(page, task.strokes[0]);
    await settled(page, 1);
    await kept(page, 1);
    const aside = await page.evaluate(() => window.fairpath.loadText("drawing-damaged"));
    must(aside === damaged, `set aside is ${JSON.stringify(aside)}, and not what was kept`);
    await openedWell(page);
    await settled(page, 1);
  });
}

/** Texts of many megabytes are there again after the page was left. */
export async function keepsTexts(seen) {
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

