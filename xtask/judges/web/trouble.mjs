// What the page says while it loads, and where it cannot work.
import { READY_WITHIN_MS, must, open, openedWell, out, task, withPage } from "./page.mjs";

/** While it loads the page says how much of how much it has. */
export async function showsItsProgress(seen) {
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

/** Where the page cannot work it says so, under a title with these words. */
export async function saysSo(seen, name, words, options, prepare, url = task.url) {
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
export async function saysSoLater(seen) {
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

