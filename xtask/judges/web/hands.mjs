// Hands on the canvas: fingers, a pen, and gestures of the browser that would disturb them.
import { frameShown, must, openedBlank, openedWell, out, recorded, settled, state, wait, withPage } from "./page.mjs";

/** Gestures of the browser that would disturb drawing do nothing on the canvas. */
export async function keepsGesturesOff() {
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

/** Fingers on the glass: each call says which are down from then on, as [finger, x, y]. */
async function fingers(page) {
  const session = await page.context().newCDPSession(page);
  const send = (type, down) => session.send("Input.dispatchTouchEvent", { type, touchPoints: down.map(([id, x, y]) => ({ id, x, y })) });
  return {
    down: (...all) => send("touchStart", all),
    move: (...all) => send("touchMove", all),
    lift: () => send("touchEnd", []),
  };
}

/** Waits until what is under way is done, and gives the state. */
async function atRest(page) {
  await wait(300);
  return settled(page, (await state(page)).strokes);
}

/** Does it for 1 to n, one after the other but without waiting, as a quick device does. */
const all = (n, deed) => Promise.all(Array.from({ length: n }, (_, i) => deed(i + 1)));

const arch = (x, y, radius, i, n) => [x - radius * Math.cos((Math.PI * i) / n), y - radius * Math.sin((Math.PI * i) / n)];

/** Gives the page a clock that can be stopped, so that how long a tap lasts is no matter of this machine. */
function ownClock() {
  const now = performance.now.bind(performance);
  let stopped = null;
  performance.now = () => stopped ?? now();
  window.clock = { stop: () => (stopped = now()), pass: (ms) => (stopped += ms), go: () => (stopped = null) };
}

/** One finger draws, two move the paper and draw nothing, a tap of two undoes and of three redoes. */
export async function drawsByTouch(seen) {
  await withPage({ touch: true }, async (page, log) => {
    await page.addInitScript(ownClock);
    await openedBlank(page);
    const glass = await fingers(page);
    const drawArch = async (x, y, radius) => {
      await glass.down([0, ...arch(x, y, radius, 0, 40)]);
      await all(40, (i) => glass.move([0, ...arch(x, y, radius, i, 40)]));
      await glass.lift();
    };
    await drawArch(400, 350, 120);
    const one = await settled(page, 1);
    const [{ points }] = await recorded(page);
    must(points.length >= 41, `a finger moved through 41 points, and ${points.length} were recorded`);
    must(points.every((point) => point[3] === undefined), "a finger is said to have a pressure");
    await drawArch(700, 350, 120);
    await settled(page, 2);

    // Two fingers go apart by one half and to the right.
    await glass.down([0, 400, 300]);
    await glass.down([0, 400, 300], [1, 600, 300]);
    // What moves in the very frame in which a finger comes or goes is no gesture.
    await frameShown(page);
    await all(20, (i) => glass.move([0, 400 + i, 300], [1, 600 + 6 * i, 300]));
    await frameShown(page);
    await glass.lift();
    const moved = await atRest(page);
    must(moved.strokes === 2, "two fingers drew a stroke");
    seen.pinched = one.pixel_size / moved.pixel_size;
    must(Math.abs(seen.pinched - 1.5) < 0.05, `two fingers went apart by 1.5, and the paper came nearer by ${seen.pinched}`);
    // What was under the middle of the fingers, which went from 500 to 570, is still there.
    const middle = (from, x) => from.corner[0] + x * from.pixel_size;
    const off = (middle(moved, 570) - middle(one, 500)) / moved.pixel_size;
    must(Math.abs(off) < 5, `the paper does not follow two fingers: it is ${off} px off`);

    // A second finger comes while the first one draws.
    await glass.down([0, 300, 550]);
    await all(10, (i) => glass.move([0, 300 + 8 * i, 550]));
    await glass.down([0, 380, 550], [1, 500, 600]);
    await all(10, (i) => glass.move([0, 380 + i, 550], [1, 500 + i, 600]));
    await glass.lift();
    must((await atRest(page)).strokes === 2, "a stroke goes on when a second finger comes");

    const tap = async (count, ms) => {
      const down = Array.from({ length: count }, (_, i) => [i, 400 + 60 * i, 500]);
      await page.evaluate(() => window.clock.stop());
      for (let i = 1; i <= count; i += 1) await glass.down(...down.slice(0, i));
      await frameShown(page);
      await page.evaluate((ms) => window.clock.pass(ms), ms);
      await glass.lift();
      await frameShown(page);
      await page.evaluate(() => window.clock.go());
      return (await atRest(page)).strokes;
    };
    must((await tap(2, 150)) === 1, "a tap of two fingers does not undo");
    must((await tap(2, 1000)) === 1, "two fingers that rest on the glass for a second undo");
    must((await tap(2, 150)) === 0, "a second tap of two fingers does not undo");
    must((await tap(3, 150)) === 1, "a tap of three fingers does not redo");
    await drawArch(800, 600, 60);
    await settled(page, 2);
    await page.screenshot({ path: out("touch.png") });
    must(log.errors.length === 0, `the page complains: ${log.errors.join("; ")}`);
  });
}

/** A pen draws with the pressures that it measures, and a hand beside it does nothing. */
export async function drawsByPen(seen) {
  await withPage({ touch: true }, async (page, log) => {
    await openedBlank(page);
    const session = await page.context().newCDPSession(page);
    const glass = await fingers(page);
    const force = (i) => 0.2 + 0.6 * (i / 40);
    const pen = (type, [x, y], i) =>
      session.send("Input.dispatchMouseEvent", { type, x, y, button: "left", buttons: 1, clickCount: 1, pointerType: "pen", force: force(i) });
    const drawArch = async ([x, y, radius], meanwhile) => {
      await pen("mousePressed", arch(x, y, radius, 0, 40), 0);
      for (let part = 0; part < 8; part += 1) {
        await all(5, (i) => pen("mouseMoved", arch(x, y, radius, 5 * part + i, 40), 5 * part + i));
        if (!meanwhile) continue;
        await meanwhile(part);
        await frameShown(page);
      }
      await pen("mouseReleased", arch(x, y, radius, 40, 40), 40);
    };
    const mustHavePressures = ({ points }) => {
      must(points.length >= 41, `a pen moved through 41 points, and ${points.length} were recorded`);
      const off = points.slice(0, 41).map((point, i) => Math.abs(point[3] - force(i)));
      must(Math.max(...off) < 1e-3, `the pressures of a pen are recorded as ${points.map((point) => point[3])}`);
    };
    await drawArch([400, 350, 120]);
    const one = await settled(page, 1);
    mustHavePressures((await recorded(page))[0]);

    // A palm is laid down, moves and is lifted again, twice, while the pen draws.
    const palm = [() => glass.down([0, 640, 560], [1, 760, 580]), () => glass.move([0, 650, 570], [1, 800, 600]), () => glass.lift()];
    await drawArch([700, 350, 120], (part) => palm[part % 4]?.());
    const both = await settled(page, 2);
    mustHavePressures((await recorded(page))[1]);
    const view = ({ corner, pixel_size }) => JSON.stringify([corner, pixel_size]);
    must(view(both) === view(one), `a palm beside the pen moves the paper: ${view(one)} became ${view(both)}`);

    // The palm is there before the pen.
    await glass.down([0, 300, 600]);
    await drawArch([400, 560, 90]);
    await glass.lift();
    await settled(page, 3);
    mustHavePressures((await recorded(page))[2]);
    seen.penStrokes = 3;
    await page.screenshot({ path: out("pen.png") });
    must(log.errors.length === 0, `the page complains: ${log.errors.join("; ")}`);
  });
}
