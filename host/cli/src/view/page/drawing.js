// The canvas of a scene, drawn by WebGL or, without it, by the canvas alone.

import { make } from "./dom.js";
import { FlatPainter } from "./relief-flat.js";
import { GlPainter } from "./relief-gl.js";

/** Greatest number of pixels drawn for one of the page, in each direction. */
const SHARPEST = 2;

/** A canvas and who draws on it. */
export class Drawing {
  /**
   * @param {HTMLElement} stage
   * @param {() => void} lost another draws from now on, and knows nothing yet
   */
  constructor(stage, lost) {
    this.canvas = make("canvas", { "aria-hidden": "true" });
    stage.append(this.canvas);
    /** @type {GlPainter | FlatPainter} */
    this.painter = GlPainter.of(this.canvas) ?? new FlatPainter(this.renewed());
    // A lost graphics card must not leave a blank picture.
    this.canvas.addEventListener("webglcontextlost", () => {
      this.painter = new FlatPainter(this.renewed());
      lost();
    });
  }

  /** Another canvas in the place of the first: one that has been asked for WebGL may give nothing else. */
  renewed() {
    const canvas = make("canvas", { "aria-hidden": "true" });
    this.canvas.replaceWith(canvas);
    this.canvas = canvas;
    return canvas;
  }

  /**
   * Pixels of the screen for one of the page, and for all of the canvas.
   * @returns {{ ratio: number, size: [number, number] }}
   */
  sharpness() {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const ratio = Math.min(SHARPEST, window.devicePixelRatio || 1);
    return { ratio, size: [Math.round(width * ratio), Math.round(height * ratio)] };
  }
}
