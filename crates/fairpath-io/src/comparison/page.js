"use strict";
const data = JSON.parse(document.getElementById("data").textContent);
const COLOURS = ["#2166c4", "#e08a00", "#8e44ad", "#7d8794", "#1a9850", "#d7263d", "#0f9bb0", "#6b7a1f"];
const KINDS = ["--line", "--arc", "--clothoid"];
const colour = (i) => COLOURS[i % COLOURS.length];
// Combs of many curves over each other tell nothing, so each view remembers whether it has them.
const state = { stroke: 0, view: "overlaid", shown: data.methods.map(() => true), comb: { overlaid: data.methods.length < 3, alone: true } };
const $ = (id) => document.getElementById(id);

function element(tag, attributes = {}, children = []) {
  const svg = ["svg", "path", "g", "rect", "circle", "line", "text", "polyline"].includes(tag);
  const made = svg ? document.createElementNS("http://www.w3.org/2000/svg", tag) : document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.append(...[].concat(children));
  return made;
}

const number = (v, digits = 3) => (v === null || v === undefined ? "–" : Math.abs(v) >= 1e5 || (v !== 0 && Math.abs(v) < 1e-3)
  ? v.toExponential(1) : Number(v.toPrecision(digits)).toLocaleString("en", { maximumFractionDigits: 4 }));

// Tables: columns are a title, the value that is compared, and digits; less is better except where `best` is false.
function table(into, columns, rows, names) {
  const least = columns.map((c) => Math.min(...rows.filter(Boolean).map((r) => c.value(r) ?? Infinity)));
  const head = element("tr", {}, [element("th", {}, "method"), ...columns.map((c) => element("th", {}, c.title))]);
  const body = rows.map((row, i) => {
    const name = element("td", { title: data.methods[names[i]].about }, [
      element("span", { class: "key", style: `background:${colour(names[i])}` }), data.methods[names[i]].name]);
    if (!row) return element("tr", {}, [name, element("td", { colspan: columns.length }, "not fitted")]);
    return element("tr", {}, [name, ...columns.map((c, k) => {
      const value = c.value(row);
      const best = c.best !== false && value !== null && value === least[k];
      const cell = element("td", best ? { class: "best" } : {}, number(value, c.digits));
      if (c.wins) cell.append(element("small", {}, ` ${c.wins(row)}×`));
      return cell;
    })]);
  });
  into.replaceChildren(element("thead", {}, head), element("tbody", {}, body));
}

function summary() {
  const all = data.methods.map((_, i) => i);
  table($("summary"), [
    { title: "fitted", value: (r) => r.fitted, best: false },
    { title: "failed", value: (r) => r.failed, best: false },
    { title: "pieces, mean", value: (r) => r.pieces_mean, wins: (r) => r.best.pieces },
    { title: "segments, mean", value: (r) => r.segments_mean },
    { title: "corners", value: (r) => r.corners, best: false, digits: 6 },
    { title: "curvature jumps", value: (r) => r.curvature_jumps, digits: 6 },
    { title: "inflections", value: (r) => r.inflections, digits: 6, wins: (r) => r.best.inflections },
    { title: `rms, ${data.unit}, mean`, value: (r) => r.rms_mean, wins: (r) => r.best.rms },
    { title: `largest, ${data.unit}`, value: (r) => r.max_deviation },
    { title: "variation", value: (r) => r.variation_median, digits: 2, wins: (r) => r.best.variation },
    { title: "ms, median", value: (r) => r.ms_median },
  ], data.summary, all);
}

const chosen = () => data.methods.map((_, i) => i).filter((i) => state.shown[i]);
const stroke = () => data.strokes[state.stroke];

// The comb's scale: so that all but the sharpest of the shown bends reach a tenth of the drawing, times the slider.
function combScale() {
  const bends = [];
  for (const i of chosen()) {
    const comb = stroke().curves[i].comb ?? [];
    for (let k = 0; k < comb.length; k += 5) bends.push(Math.hypot(comb[k + 3], comb[k + 4]));
  }
  bends.sort((a, b) => a - b);
  const high = bends[Math.floor(0.97 * (bends.length - 1))] || 0;
  return high > 0 ? (100 / high) * Math.pow(2, Number($("height").value)) : 0;
}

// Lines are as wide on the screen at every scale of the drawing.
const pen = (width) => ({ fill: "none", "stroke-width": width, "vector-effect": "non-scaling-stroke" });

function comb(curve, scale, ink) {
  let teeth = "", tips = "", broken = true;
  const corners = new Set();
  for (let k = 0; k < curve.joins.length; k += 3) if (curve.joins[k + 2] === 0) corners.add(curve.joins[k] + "," + curve.joins[k + 1]);
  for (let k = 0; k < curve.comb.length; k += 5) {
    const [, x, y, dx, dy] = curve.comb.slice(k, k + 5);
    const length = Math.hypot(dx, dy) * scale, cut = length > 220 ? 220 / length : 1;
    const tip = `${(x + dx * scale * cut).toFixed(1)} ${(y + dy * scale * cut).toFixed(1)}`;
    teeth += `M${x} ${y}L${tip}`;
    tips += (broken ? "M" : "L") + tip;
    broken = corners.has(x + "," + y) && !broken;
  }
  return element("g", { stroke: ink }, [
    element("path", { d: teeth, opacity: 0.4, ...pen(0.7) }), element("path", { d: tips, opacity: 0.9, ...pen(1.1) })]);
}

function drawing(methods, byKind) {
  const { size, stroke: points, curves } = stroke();
  const margin = state.comb[state.view] ? 130 : 40;
  const svg = element("svg", { viewBox: `${-margin} ${-margin} ${size[0] + 2 * margin} ${size[1] + 2 * margin}`,
    "stroke-linecap": "round", "stroke-linejoin": "round", role: "img" });
  if ($("ghost").checked) {
    const list = [];
    for (let k = 0; k < points.length; k += 2) list.push(points[k] + "," + points[k + 1]);
    svg.append(element("polyline", { points: list.join(" "), stroke: "var(--ghost)", ...pen(4) }));
  }
  const scale = state.comb[state.view] ? combScale() : 0;
  for (const i of methods) {
    const curve = curves[i];
    if (curve.failure) continue;
    if (scale > 0) svg.append(comb(curve, scale, byKind ? "#9a86c9" : colour(i)));
    curve.paths.forEach((d, kind) => svg.append(element("path", { d, ...pen(byKind ? 2 : 1.7),
      stroke: byKind ? `var(${KINDS[kind]})` : colour(i) })));
    if ($("joins").checked) {
      for (let k = 0; k < curve.joins.length; k += 3) {
        const [x, y, level] = curve.joins.slice(k, k + 3);
        svg.append(level === 0 ? element("rect", { x: x - 5, y: y - 5, width: 10, height: 10, fill: "var(--mark)" })
          : element("circle", { cx: x, cy: y, r: 4.5, fill: "var(--page)", stroke: byKind ? "var(--mark)" : colour(i), "stroke-width": 1.6 }));
      }
    }
    svg.append(element("circle", { class: "cursor", "data-method": i, r: 7, fill: byKind ? "var(--mark)" : colour(i), visibility: "hidden" }));
  }
  return svg;
}

function cell(title, right, svg) {
  return element("div", { class: "cell" }, [element("h2", {}, [title, element("span", {}, right)]), svg]);
}

function drawings() {
  const into = $("drawings");
  into.className = state.view;
  if (state.view === "overlaid") {
    const only = chosen().length === 1;
    into.replaceChildren(cell(stroke().name, only ? data.methods[chosen()[0]].about : "", drawing(chosen(), only)));
    return;
  }
  into.replaceChildren(...chosen().map((i) => {
    const { figures, failure } = stroke().curves[i];
    return cell(data.methods[i].name, failure ?? `${figures.pieces} pieces, rms ${number(figures.rms, 2)}`, drawing([i], true));
  }));
}

// The curvature plot. Stations run over the longest of the shown curves.
const PLOT = { width: 1000, height: 200, left: 46, bottom: 18 };
function plot() {
  const shown = chosen().filter((i) => !stroke().curves[i].failure);
  const profiles = shown.map((i) => stroke().curves[i].profile);
  const values = profiles.flatMap((p) => p.filter((_, k) => k % 2 === 1)).map(Math.abs).sort((a, b) => a - b);
  const high = 1.25 * (values[Math.floor(0.98 * (values.length - 1))] || 1e-9) || 1e-9;
  const length = Math.max(1e-9, ...profiles.map((p) => p[p.length - 2] ?? 0));
  const x = (s) => PLOT.left + (s / length) * (PLOT.width - PLOT.left);
  const y = (k) => (PLOT.height - PLOT.bottom) / 2 * (1 - Math.max(-1.1, Math.min(1.1, k / high)));
  const svg = element("svg", { viewBox: `0 0 ${PLOT.width} ${PLOT.height}`, preserveAspectRatio: "none" });
  for (const k of [-0.8 * high, 0, 0.8 * high]) {
    svg.append(element("line", { x1: PLOT.left, x2: PLOT.width, y1: y(k), y2: y(k), stroke: "var(--faint)", "stroke-width": 1 }));
    svg.append(element("text", { x: PLOT.left - 5, y: y(k) + 4, "text-anchor": "end" }, number(k, 2)));
  }
  svg.append(element("text", { x: PLOT.width, y: PLOT.height - 4, "text-anchor": "end" }, `${number(length)} ${data.unit}`));
  shown.forEach((i, n) => {
    let d = "";
    for (let k = 0; k < profiles[n].length; k += 2) d += (k ? "L" : "M") + x(profiles[n][k]).toFixed(1) + " " + y(profiles[n][k + 1]).toFixed(1);
    svg.append(element("path", { d, stroke: colour(i), ...pen(1.6) }));
  });
  const cursor = element("line", { y1: 0, y2: PLOT.height - PLOT.bottom, stroke: "var(--soft)", visibility: "hidden" });
  svg.append(cursor);
  const point = (event) => {
    const box = svg.getBoundingClientRect();
    const at = ((event.clientX - box.left) / box.width * PLOT.width - PLOT.left) / (PLOT.width - PLOT.left);
    follow(at < 0 || at > 1 ? null : at, length, cursor, x);
  };
  svg.addEventListener("pointermove", point);
  svg.addEventListener("pointerdown", point);
  svg.addEventListener("pointerleave", () => follow(null, length, cursor, x));
  $("plot").replaceChildren(svg);
  follow(null, length, cursor, x);
}

// Shows the place at a share of the longest curve on every curve, and the curvature there.
function follow(share, length, cursor, x) {
  cursor.setAttribute("visibility", share === null ? "hidden" : "visible");
  const said = [];
  if (share !== null) {
    cursor.setAttribute("x1", x(share * length));
    cursor.setAttribute("x2", x(share * length));
    said.push(`at ${number(share * length)} ${data.unit}:`);
  }
  for (const dot of document.querySelectorAll(".cursor")) {
    const i = Number(dot.dataset.method), teeth = stroke().curves[i].comb;
    let best = null;
    for (let k = 0; share !== null && k < teeth.length; k += 5) {
      if (best === null || Math.abs(teeth[k] - share * length) < Math.abs(teeth[best] - share * length)) best = k;
    }
    dot.setAttribute("visibility", best === null ? "hidden" : "visible");
    if (best === null) continue;
    dot.setAttribute("cx", teeth[best + 1]);
    dot.setAttribute("cy", teeth[best + 2]);
    said.push(`${data.methods[i].name} ${number(curvatureAt(stroke().curves[i].profile, share * length))}`);
  }
  $("readout").textContent = said.join("  ");
}

function curvatureAt(profile, s) {
  for (let k = 2; k < profile.length; k += 2) {
    if (s <= profile[k]) {
      const span = profile[k] - profile[k - 2];
      return profile[k - 1] + (span > 0 ? (s - profile[k - 2]) / span : 0) * (profile[k + 1] - profile[k - 1]);
    }
  }
  return profile[profile.length - 1];
}

function figures() {
  const rows = chosen().map((i) => stroke().curves[i].figures);
  table($("figures"), [
    { title: "pieces", value: (r) => r.pieces },
    { title: "segments", value: (r) => r.segments },
    { title: "corners", value: (r) => r.corners, best: false },
    { title: "curvature jumps", value: (r) => r.curvature_jumps },
    { title: "inflections", value: (r) => r.inflections },
    { title: `rms, ${data.unit}`, value: (r) => r.rms },
    { title: `largest, ${data.unit}`, value: (r) => r.max },
    { title: "variation", value: (r) => r.variation, digits: 2 },
    { title: "ms", value: (r) => r.ms },
  ], rows, chosen());
  const warnings = chosen().flatMap((i) => {
    const curve = stroke().curves[i];
    const texts = (curve.warnings ?? [curve.failure]).slice();
    if (curve.of_points) texts.push("a polyline: its curvature is estimated from its turns");
    return texts.map((text) => element("li", {}, `${data.methods[i].name}: ${text}`));
  });
  $("warnings").replaceChildren(...warnings);
}

function strokes() {
  const wanted = $("find").value.toLowerCase();
  $("strokes").replaceChildren(...data.strokes.flatMap((s, i) => {
    if (!s.name.toLowerCase().includes(wanted)) return [];
    const button = element("button", { type: "button", "aria-current": String(i === state.stroke), title: s.name }, s.name);
    button.addEventListener("click", () => show(i));
    return [element("li", {}, button)];
  }));
}

function render() {
  // What is seen can be linked to.
  history.replaceState(null, "", "#" + new URLSearchParams({ stroke: stroke().name, view: state.view }));
  drawings();
  plot();
  figures();
  for (const button of document.querySelectorAll("[data-view]")) button.setAttribute("aria-pressed", String(button.dataset.view === state.view));
  $("comb").checked = state.comb[state.view];
  $("height").disabled = !state.comb[state.view];
  [...$("methods").children].forEach((button, i) => button.setAttribute("aria-pressed", String(state.shown[i])));
}

function show(i) {
  state.stroke = (i + data.strokes.length) % data.strokes.length;
  strokes();
  render();
  document.querySelector("[aria-current=true]")?.scrollIntoView({ block: "nearest" });
}

data.methods.forEach((method, i) => {
  const button = element("button", { type: "button", title: `${method.about} (double click: this one alone)`, style: `--own:${colour(i)}` }, [
    element("span", { class: "key", style: `background:${colour(i)}` }), method.name]);
  button.addEventListener("click", () => { state.shown[i] = !state.shown[i]; render(); });
  button.addEventListener("dblclick", () => { state.shown = data.methods.map((_, k) => k === i); render(); });
  $("methods").append(button);
});
for (const button of document.querySelectorAll("[data-view]")) {
  button.addEventListener("click", () => { state.view = button.dataset.view; render(); });
}
$("comb").addEventListener("input", () => { state.comb[state.view] = $("comb").checked; render(); });
for (const id of ["height", "joins", "ghost"]) $(id).addEventListener("input", render);
$("find").addEventListener("input", strokes);
document.addEventListener("keydown", (event) => {
  if (event.target.matches("input[type=search], input[type=range]")) return;
  if (event.key === "ArrowDown" || event.key === "ArrowRight") { event.preventDefault(); show(state.stroke + 1); }
  if (event.key === "ArrowUp" || event.key === "ArrowLeft") { event.preventDefault(); show(state.stroke - 1); }
});
$("subtitle").textContent = `${data.strokes.length} strokes, ${data.methods.length} methods. Arrow keys go through the strokes.`;
summary();
const link = new URLSearchParams(location.hash.slice(1));
if (link.get("view") === "alone") state.view = "alone";
const asked = data.strokes.findIndex((s) => s.name === link.get("stroke"));
if (data.strokes.length) show(Math.max(0, asked));
