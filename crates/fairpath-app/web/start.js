// Loads the program, shows how far that is, and gives it the canvas. Where it cannot run, or stops, says so and what to do.

const element = (id) => document.getElementById(id);
// Everything that belongs together has one version in its address.
const version = new URL(import.meta.url).search;
const beside = (name) => new URL(name + version, import.meta.url);

const kept = "The browser keeps your drawing as it last saved it.";

function tell(title, remedy, details) {
  element("trouble-title").textContent = title;
  element("trouble-remedy").textContent = remedy;
  element("trouble-details").textContent = details;
  element("loading").hidden = true;
  element("trouble").hidden = false;
  element("curtain").hidden = false;
  window.fairpath.ready = false;
  window.fairpath.trouble = { title, remedy, details };
}

// The first trouble is the cause, what comes after it mostly its effect.
function tellOnce(...words) {
  if (!window.fairpath.trouble) tell(...words);
}

function showProgress(received, total) {
  const mb = (bytes) => (bytes / 1e6).toFixed(1);
  const share = total > 0 ? Math.min(received / total, 1) : 0;
  element("progress").value = share;
  element("amount").textContent = share < 1 ? `${mb(received)} of ${mb(total)} MB` : "Starting";
}

// The same response with its bytes counted as they come, after they were decompressed, so that their sum is the file's size.
function counted(response, total) {
  let received = 0;
  const counter = new TransformStream({
    transform(chunk, controller) {
      received += chunk.byteLength;
      showProgress(received, total);
      controller.enqueue(chunk);
    },
  });
  return new Response(response.body.pipeThrough(counter), { headers: { "Content-Type": "application/wasm" } });
}

async function compiled(total) {
  const address = beside("fairpath_bg.wasm");
  const response = await fetch(address);
  if (!response.ok) throw new Error(`the server answered ${response.status} for ${address.pathname}`);
  showProgress(0, total);
  return WebAssembly.compileStreaming(counted(response, total));
}

const frame = () => new Promise((resolve) => requestAnimationFrame(resolve));

async function start() {
  if (typeof WebAssembly !== "object" || !WebAssembly.compileStreaming) {
    const remedy = "It needs WebAssembly: use a present version of Firefox, Chrome, Edge or Safari, and switch off modes that lock the browser down.";
    return tell("This browser cannot run Fairpath.", remedy, navigator.userAgent);
  }
  const total = Number(document.querySelector("script[data-program-bytes]").dataset.programBytes);
  let program;
  try {
    const [glue, module] = await Promise.all([import(beside("fairpath.js")), compiled(total)]);
    await glue.default({ module_or_path: module });
    program = glue;
  } catch (error) {
    const remedy = "Load the page again. If it stays so, what the server sends is incomplete or not what this page was made for.";
    return tellOnce("Fairpath could not be loaded.", remedy, String(error));
  }
  try {
    await program.start("canvas", beside("worker.js").href);
  } catch (error) {
    const remedy =
      "Fairpath draws with WebGPU or WebGL 2, and this browser gives neither. Switch on hardware acceleration in its settings, update the graphics driver, or use another browser.";
    return tellOnce("No graphics.", remedy, String(error));
  }
  while (!window.fairpath.trouble && program.frames() < 1) await frame();
  if (window.fairpath.trouble) return;
  element("curtain").hidden = true;
  const { frames, state, strokes, svg, pace, forgetPace, named, saveText, loadText, removeText } = program;
  Object.assign(window.fairpath, { frames, state, strokes, svg, pace, forgetPace, named });
  Object.assign(window.fairpath, { saveText, loadText, removeText });
  Object.assign(window.fairpath, { ready: true, readyMs: performance.now() });
}

window.fairpath = { ready: false, trouble: null };
// The program's own word for a fault in it.
globalThis.fairpathPanicked = (message) =>
  tellOnce("Fairpath has stopped.", `There is a mistake in the program; what it says below helps whoever mends it. ${kept}`, message);
window.addEventListener("error", (event) => {
  if (event.error instanceof WebAssembly.RuntimeError) {
    tellOnce("Fairpath has stopped.", `The program ran into a fault, perhaps for want of memory. ${kept}`, String(event.error.stack));
  }
});
element("canvas").addEventListener("webglcontextlost", () =>
  tellOnce("The graphics were taken away.", `The browser or the graphics driver has restarted. ${kept}`, "WebGL context lost"),
);
// "Select all" selects the canvas too, as the browser sees it, and the next stroke would drag it away.
element("canvas").addEventListener("dragstart", (event) => event.preventDefault());
element("reload").addEventListener("click", () => location.reload());
start();
