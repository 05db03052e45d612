// Checks whether the browser can draw, before the page fetches megabytes.

/** Returns whether the browser offers WebGL 2 or WebGPU. */
export async function canDraw() {
  return hasWebGl2() || (await hasWebGpu());
}

function hasWebGl2() {
  const context = document.createElement("canvas").getContext("webgl2");
  // Browsers allow few contexts, so this one is released at once.
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
