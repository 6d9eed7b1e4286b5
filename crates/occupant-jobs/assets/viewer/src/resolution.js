// As many pixels as the machine can draw while playing, all of them when still.

/** More pixels than this a CSS pixel cost frames and show nothing. */
const MOST = 1.5;
const LEAST = 0.5;
/** Frames slower than this make the picture coarser, faster than this finer, ms. */
const SLOW_MS = 22;
const FAST_MS = 14;
/** Frames between two changes. */
const PATIENCE = 12;

export class Resolution {
  constructor(renderer, clock) {
    this.renderer = renderer;
    this.clock = clock;
    this.full = Math.min(window.devicePixelRatio, MOST);
    this.coarse = this.full;
    this.last = 0;
    this.mean = 16;
    this.count = 0;
    this.set(this.full);
  }

  set(ratio) {
    if (this.renderer.getPixelRatio() !== ratio) this.renderer.setPixelRatio(ratio);
  }

  /** A frame is about to be drawn. */
  drawn(now) {
    const passed = now - this.last;
    this.last = now;
    if (!this.clock.playing) {
      this.set(this.full);
      return;
    }
    this.mean += 0.2 * (Math.min(passed, 100) - this.mean);
    this.count += 1;
    if (this.count >= PATIENCE) this.adapt();
    this.set(this.coarse);
  }

  adapt() {
    if (this.mean > SLOW_MS) this.coarse = Math.max(LEAST, 0.8 * this.coarse);
    else if (this.mean < FAST_MS) this.coarse = Math.min(this.full, 1.1 * this.coarse);
    else return;
    this.count = 0;
  }
}

/** Whether WebGL is drawn by the processor, for which smooth edges are dear. */
export function drawsInSoftware() {
  const context = document.createElement("canvas").getContext("webgl2");
  if (!context) return false;
  const info = context.getExtension("WEBGL_debug_renderer_info");
  const name = info ? context.getParameter(info.UNMASKED_RENDERER_WEBGL) : "";
  context.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|software|basic render/i.test(name);
}
