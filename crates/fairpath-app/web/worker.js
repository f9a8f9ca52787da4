// Does the long work beside the page. First comes the compiled program, then jobs as [id, job]; answers go back as [id, answer, null, ms]
// with the time that the job took here, without its way here and back.
// A program that failed once is in no state to be asked again: [null, null, reason] is then this worker's last word.

let failed = null;
globalThis.fairpathPanicked = (message) => (failed ??= message);

// Resolves to the program; jobs that come before it is ready wait for it.
let program = null;

async function load(module) {
  const glue = await import("./fairpath.js" + self.location.search);
  await glue.default({ module_or_path: module });
  return glue;
}

function die(error) {
  self.postMessage([null, null, failed ?? String(error)]);
  self.close();
}

self.onmessage = async ({ data }) => {
  if (data instanceof WebAssembly.Module) {
    program = load(data);
    program.catch(die);
    return;
  }
  const [id, job] = data;
  try {
    const { run_job } = await program;
    const begun = performance.now();
    const answer = run_job(job);
    self.postMessage([id, answer, null, performance.now() - begun]);
  } catch (error) {
    die(error);
  }
};
