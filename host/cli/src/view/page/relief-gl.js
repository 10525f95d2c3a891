// A relief, or cloth on a robot, drawn by WebGL.

import { GREY, palette, ROBOT } from "./colours.js";
import { STRIDE } from "./mesh.js";

/**
 * @typedef {import("./mesh.js").Mesh} Mesh
 * @typedef {import("./mesh.js").Relief} Relief
 * @typedef {import("./camera.js").Sight} Sight
 */

const VERTEX = `#version 300 es
uniform mat4 sight;
in vec3 place;
in vec3 relief;
out float share;
out float light;
void main() {
  share = relief.y;
  light = relief.z;
  gl_Position = sight * vec4(place.xy, place.z + relief.x, 1.0);
}`;

// Each step of the ramp is a colour of its own, as on the panels.
const FRAGMENT = `#version 300 es
precision mediump float;
uniform sampler2D ramp;
uniform float steps;
in float share;
in float light;
out vec4 colour;
void main() {
  int step = int(clamp(share, 0.0, 1.0) * steps + 0.5);
  vec3 pressed = share < 0.0 ? vec3(share < -1.5 ? ${ROBOT} : ${GREY}) : texelFetch(ramp, ivec2(step, 0), 0).rgb;
  colour = vec4(pressed * light, 1.0);
}`;

/** Draws into a canvas of its own. */
export class GlPainter {
  /**
   * A painter; null if the browser has no WebGL 2.
   * @param {HTMLCanvasElement} canvas
   */
  static of(canvas) {
    // The page's processor draws it where there is no graphics card: smoothed edges would be half of the work.
    const gl = canvas.getContext("webgl2", { alpha: true, antialias: false, powerPreference: "low-power" });
    const program = gl && programOf(gl);
    return gl && program ? new GlPainter(canvas, gl, program) : null;
  }

  /**
   * @param {HTMLCanvasElement} canvas
   * @param {WebGL2RenderingContext} gl
   * @param {WebGLProgram} program
   */
  constructor(canvas, gl, program) {
    this.canvas = canvas;
    this.gl = gl;
    this.sight = gl.getUniformLocation(program, "sight");
    this.data = gl.createBuffer();
    this.count = 0;
    gl.useProgram(program);
    gl.enable(gl.DEPTH_TEST);
    this.steps = gl.getUniformLocation(program, "steps");
    this.place = gl.getAttribLocation(program, "place");
    this.places = gl.createBuffer();
    gl.enableVertexAttribArray(this.place);
    this.relief = this.input(program, "relief", STRIDE);
    this.corners = gl.createBuffer();
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, this.corners);
    gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
  }

  /**
   * A buffer for the numbers of each taxel.
   * @param {WebGLProgram} program
   * @param {string} name
   * @param {number} numbers
   */
  input(program, name, numbers) {
    const { gl } = this;
    const buffer = gl.createBuffer();
    const at = gl.getAttribLocation(program, name);
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.enableVertexAttribArray(at);
    gl.vertexAttribPointer(at, numbers, gl.FLOAT, false, 0, 0);
    return buffer;
  }

  /** Takes the colours, which the program reports with the garment. */
  ramp() {
    const { gl } = this;
    gl.uniform1f(this.steps, palette.ramp.length - 1);
    const texels = Uint8Array.from(palette.ramp.flatMap((rgb) => [...rgb, 255]));
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, palette.ramp.length, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, texels);
  }

  /**
   * Takes other places: x and y of each taxel, or x, y and z.
   * @param {Float32Array} places
   * @param {2 | 3} numbers
   */
  move(places, numbers) {
    const { gl } = this;
    gl.bindBuffer(gl.ARRAY_BUFFER, this.places);
    gl.vertexAttribPointer(this.place, numbers, gl.FLOAT, false, 0, 0);
    gl.bufferData(gl.ARRAY_BUFFER, places, gl.DYNAMIC_DRAW);
  }

  /**
   * Takes another mesh.
   * @param {Pick<Mesh, "places" | "faces">} mesh
   * @param {2 | 3} numbers of a place
   */
  build({ places, faces }, numbers = 2) {
    const { gl } = this;
    this.ramp();
    this.move(places, numbers);
    const corners = new Uint32Array((faces.length / 4) * 6);
    [0, 1, 3, 1, 2, 3].forEach((corner, at) => {
      for (let face = 0; face < faces.length / 4; face += 1) corners[face * 6 + at] = faces[face * 4 + corner] ?? 0;
    });
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, corners, gl.STATIC_DRAW);
    this.count = corners.length;
  }

  /**
   * @param {Sight} sight
   * @param {Pick<Relief, "data">} relief
   * @param {[number, number]} size of the picture in pixels of the screen
   */
  draw({ matrix }, { data }, [width, height]) {
    const { gl, canvas } = this;
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    gl.viewport(0, 0, width, height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.uniformMatrix4fv(this.sight, false, matrix);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.relief);
    gl.bufferData(gl.ARRAY_BUFFER, data, gl.DYNAMIC_DRAW);
    gl.drawElements(gl.TRIANGLES, this.count, gl.UNSIGNED_INT, 0);
  }
}

/**
 * @param {WebGL2RenderingContext} gl
 * @returns {WebGLProgram | null}
 */
function programOf(gl) {
  const program = gl.createProgram();
  const parts = /** @type {[number, string][]} */ ([
    [gl.VERTEX_SHADER, VERTEX],
    [gl.FRAGMENT_SHADER, FRAGMENT],
  ]);
  for (const [kind, source] of parts) {
    const shader = gl.createShader(kind);
    if (!program || !shader) return null;
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  return gl.getProgramParameter(program, gl.LINK_STATUS) ? program : null;
}
