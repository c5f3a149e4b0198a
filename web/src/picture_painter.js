/** Draws pictures on a canvas: by WebGL, or without it by the 2D context. */
import { colourMatrix } from "./colour.js";

/** @typedef {import("./types").PaintedPicture} PaintedPicture */

const VERTEX_SHADER = `
attribute vec2 corner;
varying vec2 place;
void main() {
  place = vec2(corner.x, 1.0 - corner.y);
  gl_Position = vec4(corner * 2.0 - 1.0, 0.0, 1.0);
}`;

const FRAGMENT_SHADER = `
precision highp float;
varying vec2 place;
uniform sampler2D y, u, v;
uniform vec2 chromaShare;  // of the chroma planes that the picture covers: less than 1 where its size is odd
uniform float luma;
uniform vec3 red, blue, offset;
void main() {
  vec2 chroma = place * chromaShare;
  vec3 rgb = luma * texture2D(y, place).r + blue * texture2D(u, chroma).r + red * texture2D(v, chroma).r + offset;
  gl_FragColor = vec4(rgb, 1.0);
}`;

export class PicturePainter {
  /** @param {HTMLCanvasElement} canvas @param {boolean} [plain]  without WebGL */
  constructor(canvas, plain = false) {
    this.canvas = canvas;
    /** @type {PaintedPicture | null} */
    this.last = null;
    /** @type {GlPainter | PlainPainter} */
    this.painter = (!plain && GlPainter.create(canvas)) || new PlainPainter(canvas);
    canvas.addEventListener("webglcontextlost", (event) => event.preventDefault());
    canvas.addEventListener("webglcontextrestored", () => {
      this.painter = GlPainter.create(canvas) ?? this.painter;
      if (this.last) this.paint(this.last);
    });
  }

  /** @param {PaintedPicture} picture  kept until the next one */
  paint(picture) {
    const { format } = picture;
    const width = Math.round(format.width * format.pixelAspect);
    if (this.canvas.width !== width) this.canvas.width = width;
    if (this.canvas.height !== format.height) this.canvas.height = format.height;
    this.painter.paint(picture);
    this.last = picture;
  }
}

class GlPainter {
  /** @param {HTMLCanvasElement} canvas */
  static create(canvas) {
    const gl = canvas.getContext("webgl", { alpha: false, antialias: false, depth: false });
    return gl && new GlPainter(gl);
  }

  /** @param {WebGLRenderingContext} gl */
  constructor(gl) {
    this.gl = gl;
    const program = /** @type {WebGLProgram} */ (gl.createProgram());
    gl.attachShader(program, shader(gl, gl.VERTEX_SHADER, VERTEX_SHADER));
    gl.attachShader(program, shader(gl, gl.FRAGMENT_SHADER, FRAGMENT_SHADER));
    gl.linkProgram(program);
    gl.useProgram(program);
    this.program = program;
    gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ARRAY_BUFFER, new Float32Array([0, 0, 1, 0, 0, 1, 1, 1]), gl.STATIC_DRAW);
    const corner = gl.getAttribLocation(program, "corner");
    gl.enableVertexAttribArray(corner);
    gl.vertexAttribPointer(corner, 2, gl.FLOAT, false, 0, 0);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    ["y", "u", "v"].forEach((name, unit) => {
      gl.activeTexture(gl.TEXTURE0 + unit);
      gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
      for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER])
        gl.texParameteri(gl.TEXTURE_2D, filter, gl.LINEAR);
      for (const wrap of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T])
        gl.texParameteri(gl.TEXTURE_2D, wrap, gl.CLAMP_TO_EDGE);
      gl.uniform1i(gl.getUniformLocation(program, name), unit);
    });
  }

  /** @param {PaintedPicture} picture */
  paint({ width, height, planes, format }) {
    const { gl } = this;
    const place = (/** @type {string} */ name) => gl.getUniformLocation(this.program, name);
    const { luma, red, blue, offset } = colourMatrix(format);
    gl.uniform1f(place("luma"), luma);
    gl.uniform3fv(place("red"), red);
    gl.uniform3fv(place("blue"), blue);
    gl.uniform3fv(place("offset"), offset);
    const [y, u, v] = planesOf(width, height, planes);
    gl.uniform2f(place("chromaShare"), width / 2 / u.width, height / 2 / u.height);
    [y, u, v].forEach((plane, unit) => {
      gl.activeTexture(gl.TEXTURE0 + unit);
      gl.texImage2D(gl.TEXTURE_2D, 0, gl.LUMINANCE, plane.width, plane.height, 0, gl.LUMINANCE, gl.UNSIGNED_BYTE,
                    plane.samples);
    });
    gl.viewport(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight);
    gl.drawArrays(gl.TRIANGLE_STRIP, 0, 4);
  }
}

/** @param {WebGLRenderingContext} gl @param {number} type @param {string} source */
function shader(gl, type, source) {
  const out = /** @type {WebGLShader} */ (gl.createShader(type));
  gl.shaderSource(out, source);
  gl.compileShader(out);
  return out;
}

class PlainPainter {
  /** @param {HTMLCanvasElement} canvas */
  constructor(canvas) {
    this.context = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d", { alpha: false }));
    this.image = new ImageData(1, 1);
    this.square = document.createElement("canvas");
  }

  /** @param {PaintedPicture} picture */
  paint({ width, height, planes, format }) {
    if (this.image.width !== width || this.image.height !== height) this.image = new ImageData(width, height);
    const { data } = this.image;
    const { luma, red, blue, offset } = colourMatrix(format);
    const [y, u, v] = planesOf(width, height, planes);
    for (let row = 0, out = 0; row < height; ++row) {
      const chroma = (row >> 1) * u.width;
      for (let x = 0; x < width; ++x, out += 4) {
        const light = luma * y.samples[row * width + x];
        const cb = u.samples[chroma + (x >> 1)], cr = v.samples[chroma + (x >> 1)];
        for (let k = 0; k < 3; ++k) data[out + k] = light + blue[k] * cb + red[k] * cr + 255 * offset[k];
        data[out + 3] = 255;
      }
    }
    const { canvas } = this.context;
    if (canvas.width === width) return this.context.putImageData(this.image, 0, 0);
    // The pixels are not square.
    this.square.width = width;
    this.square.height = height;
    this.square.getContext("2d")?.putImageData(this.image, 0, 0);
    this.context.drawImage(this.square, 0, 0, canvas.width, canvas.height);
  }
}

/** @param {number} width @param {number} height @param {Uint8Array} all */
function planesOf(width, height, all) {
  const half = { width: (width + 1) >> 1, height: (height + 1) >> 1 };
  const luma = width * height, chroma = half.width * half.height;
  return [
    { width, height, samples: all.subarray(0, luma) },
    { ...half, samples: all.subarray(luma, luma + chroma) },
    { ...half, samples: all.subarray(luma + chroma, luma + 2 * chroma) },
  ];
}
