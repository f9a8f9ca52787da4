// How much time the page's own work takes while strokes are drawn: told, not judged, since machines differ. That enough was timed is judged.
import { must, openedBlank, recorded, settled, wait, withPage } from "./page.mjs";

const LENGTH_PX = 1000;
const STEP_PX = 4;
const RATES_HZ = [60, 240];
// Each pixel costs time where software draws, and only with many frames is the slowest in a hundred of them known.
const SIZE = [720, 440];
const FRAMES = 60;
const MOST_STROKES = 24;

/** A wave of that length, a point every so many px. */
function wave() {
  const at = (t) => [90 + 540 * t, 220 + 120 * Math.sin(4 * Math.PI * t)];
  const points = [at(0)];
  let last = at(0), gone = 0, due = STEP_PX;
  for (let t = 0; due <= LENGTH_PX; t += 1e-5) {
    const next = at(t);
    gone += Math.hypot(next[0] - last[0], next[1] - last[1]);
    last = next;
    if (gone >= due) {
      points.push(next);
      due += STEP_PX;
    }
  }
  return points;
}

/** Draws with the mouse, so many points a second; how many it were. */
async function drawAt(page, points, rateHz) {
  await page.mouse.move(...points[0]);
  await page.mouse.down();
  const begun = performance.now();
  const sent = [];
  for (const [i, point] of points.slice(1).entries()) {
    const due = begun + ((i + 1) * 1000) / rateHz;
    if (performance.now() < due) await wait(due - performance.now());
    sent.push(page.mouse.move(...point));
  }
  await Promise.all(sent);
  const seconds = (performance.now() - begun) / 1000;
  await page.mouse.up();
  return (points.length - 1) / seconds;
}

/** Times everything that the page does for an animation frame in which it draws: the interface, its triangles, the graphics commands. */
function timeFrames() {
  const request = window.requestAnimationFrame.bind(window);
  const drawn = () => window.fairpath?.frames?.() ?? 0;
  window.framesMs = [];
  window.requestAnimationFrame = (callback) =>
    request((now) => {
      const [begun, before] = [performance.now(), drawn()];
      callback(now);
      if (drawn() > before) window.framesMs.push(performance.now() - begun);
    });
}

/** What matters of a list of times. */
function times(list) {
  const sorted = [...list].sort((a, b) => a - b);
  const at = (share) => sorted[Math.min(Math.floor(sorted.length * share), sorted.length - 1)];
  return { count: sorted.length, median: at(0.5), p99: at(0.99), longest: at(1) };
}

const told = ({ count, median, p99, longest }) =>
  `${String(count).padStart(5)} ${[median, p99, longest].map((ms) => ms.toFixed(1).padStart(8)).join(" ")}`;

/** While strokes are drawn point by point, as many as it takes to see enough frames. */
export async function keepsPace(seen) {
  const points = wave();
  await withPage({ size: SIZE }, async (page) => {
    await page.addInitScript(timeFrames);
    await openedBlank(page);
    seen.pace = {};
    for (const rate of RATES_HZ) {
      await page.evaluate(() => (window.fairpath.forgetPace(), (window.framesMs.length = 0)));
      let strokes = 0, reached = 0, pace;
      do {
        reached += await drawAt(page, points, rate);
        strokes += 1;
        await settled(page, 1);
        const { points: taken } = (await recorded(page))[0];
        must(taken.length >= points.length, `of ${points.length} points ${taken.length} were recorded`);
        pace = JSON.parse(await page.evaluate(() => window.fairpath.pace()));
        await page.keyboard.press("Control+a");
        await page.keyboard.press("Delete");
        await settled(page, 0);
      } while (pace.frames.count < FRAMES && strokes < MOST_STROKES);
      const whole = times(await page.evaluate(() => window.framesMs));
      const { frames, jobs, curves } = pace;
      must(frames.count >= FRAMES, `${frames.count} frames were timed in ${strokes} strokes`);
      must(jobs.count >= strokes, `${jobs.count} jobs were timed`);
      must(curves.count === strokes, `${curves.count} curves were timed, and ${strokes} were drawn`);
      reached /= strokes;
      seen.pace[rate] = { reached, frames, whole, jobs, curves };
      console.log(`  ${LENGTH_PX} px, ${points.length} points, ${rate} a second wanted, ${reached.toFixed(0)} sent; ms:  count   median     99 %  longest`);
      console.log(`    our own work for a frame                                     ${told(frames)}`);
      console.log(`    with triangles and graphics commands, all of the callback    ${told(whole)}`);
      console.log(`    a job in the worker, timed there                             ${told(jobs)}`);
      console.log(`    from the last point to the curve in the picture              ${told(curves)}`);
    }
  });
}
