// Whether there is anything to draw with; the page checks it before it fetches megabytes.

/** Whether the browser offers WebGL 2 or WebGPU. */
export async function canDraw() {
  return hasWebGl2() || (await hasWebGpu());
}

function hasWebGl2() {
  const context = document.createElement("canvas").getContext("webgl2");
  // Browsers keep few contexts: this one is given back at once.
  context?.getExtension("WEBGL_lose_context")?.loseContext();
  return context !== null;
}

async function hasWebGpu() {
  try {
    return Boolean(await navigator.gpu?.requestAdapter());
  } catch {
    return false;
  }
}
