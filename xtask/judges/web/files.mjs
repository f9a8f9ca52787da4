// Files out of the page and into it, by the page's own menu and by dropping them.
import { readFileSync } from "node:fs";
import { basename, join } from "node:path";

import { chooseFile, must, openedBlank, out, placeOf, press, recorded, settled, task, withPage } from "./page.mjs";

/** What the menu calls the export of curves for drawing programs. */
const SVG = "SVG, for drawing programs";

/** Exports the drawing to `file` as a person does, who opens the menu and its entry "Export". Its bytes are what the page says of itself. */
export async function exportedSvg(page, file) {
  await press(page, "Menu");
  await press(page, /^Export/);
  await placeOf(page, SVG);
  await page.screenshot({ path: out("menu.png") });
  const [download] = await Promise.all([page.waitForEvent("download", { timeout: 10_000 }), press(page, SVG)]);
  await download.saveAs(file);
  const name = download.suggestedFilename();
  must(name.endsWith(".svg"), `the drawing is exported as ${name}`);
  const svg = await page.evaluate(() => window.fairpath.svg());
  must(svg.includes("<path") && readFileSync(file, "utf8") === svg, "the exported drawing is another one than that of the page");
  await placeOf(page, `Saved ${name}.`);
  return name;
}

/** The places of all strokes of a file, in its order. */
const places = (strokes) => JSON.stringify(strokes.map(({ points }) => points.map(([x, y]) => [x, y])));

/** Strokes of a file that is chosen, and of one that is dropped on the window, become curves beside those that are there. */
export async function takesFiles(seen) {
  await withPage({}, async (page, log) => {
    await openedBlank(page);
    const [chosen, dropped] = ["hello.json", "duck.json"].map((name) => join(task.examples, name));
    const strokesOf = (file) => JSON.parse(readFileSync(file, "utf8")).strokes;
    await chooseFile(page, /^Import…/, chosen);
    seen.imported = (await placeOf(page, new RegExp(`from ${basename(chosen)}`))).name;
    await settled(page, strokesOf(chosen).length);
    must(places(await recorded(page)) === places(strokesOf(chosen)), "the imported strokes are not those of the file");
    await page.evaluate(([name, text]) => {
      const files = new DataTransfer();
      files.items.add(new File([text], name));
      const canvas = document.getElementById("canvas");
      for (const kind of ["dragover", "drop"]) {
        canvas.dispatchEvent(new DragEvent(kind, { dataTransfer: files, clientX: 500, clientY: 350, bubbles: true, cancelable: true }));
      }
    }, [basename(dropped), readFileSync(dropped, "utf8")]);
    const all = [...strokesOf(chosen), ...strokesOf(dropped)];
    await settled(page, all.length);
    must(places(await recorded(page)) === places(all), "the strokes of a dropped file are not those of the file");
    await chooseFile(page, /^Import…/, { name: "rubbish.json", mimeType: "application/json", buffer: Buffer.from("no strokes") });
    seen.refused = (await placeOf(page, /rubbish\.json/)).name;
    await settled(page, all.length);
    await page.screenshot({ path: out("files.png") });
    must(log.errors.length === 0, `the page complains: ${log.errors.join("; ")}`);
  });
}
