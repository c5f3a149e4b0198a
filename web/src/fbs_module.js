/**
 * The decoder: a WebAssembly module, and its functions with the types of JavaScript.
 * Times are seconds, from the first picture of the stream.
 */

/**
 * @typedef {import("./types").Format} Format
 * @typedef {import("./types").Picture} Picture
 * @typedef {import("./types").Face} Face
 * @typedef {import("./types").FaceEdit} FaceEdit
 * @typedef {import("./types").Sound} Sound
 * @typedef {import("./types").Announced} Announced
 */

/** A function with one vector instruction: valid where there are vectors of 128 bits. */
const VECTOR_PROBE = new Uint8Array([
  0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 10, 1, 8, 0, 65, 0, 253, 15, 253, 98, 11,
]);

const POSE_NUMBERS = 6;
const LANDMARKS = 68;

/** As fbs_status of fbs/fbs.h has them. */
const STATUS_CODES = /** @type {const} */ ({
  "-1": "argument", "-2": "not-fbs", "-3": "damaged", "-4": "truncated", "-5": "unsupported", "-6": "too-large",
  "-7": "no-memory", "-8": "no-face", "-9": "io", "-10": "internal",
});

const MATRICES = /** @type {const} */ (["unspecified", "bt601", "bt709"]);

/** An error of the stream or of the decoder. */
export class FbsError extends Error {
  /**
   * @param {import("./types").ErrorCode} code
   * @param {string} message
   * @param {number} [offset]  byte of the stream that it is about
   */
  constructor(code, message, offset = 0) {
    super(message);
    this.name = "FbsError";
    this.code = code;
    this.offset = offset;
  }
}

/** The module file for this machine. */
export function moduleUrl() {
  const vectors = WebAssembly.validate(VECTOR_PROBE);
  return vectors ? new URL("./fbs-simd.wasm", import.meta.url) : new URL("./fbs.wasm", import.meta.url);
}

/**
 * Fetches and compiles the module.
 * @param {URL | string} [url]
 */
export async function compileModule(url = moduleUrl()) {
  const answer = await fetch(url, { credentials: "same-origin" });
  if (!answer.ok) throw new FbsError("http", `${url}: the server answers ${answer.status}`);
  // Compiles while downloading, if the server sends the right type.
  return answer.headers.get("Content-Type")?.startsWith("application/wasm")
    ? WebAssembly.compileStreaming(answer)
    : WebAssembly.compile(await answer.arrayBuffer());
}

/**
 * Makes an instance of the module. Its decoders share its memory.
 * @param {WebAssembly.Module} [module]  default: it is fetched
 */
export async function loadModule(module) {
  const wasi = { proc_exit: trap, fd_write: () => 8, fd_close: () => 8, fd_seek: () => 8 };  // 8: there is no such file
  const imports = { env: { emscripten_notify_memory_growth() {} }, wasi_snapshot_preview1: wasi };
  const instance = await WebAssembly.instantiate(module ?? (await compileModule()), imports);
  /** @type {any} */ (instance.exports)._initialize();
  return new FbsModule(instance);
}

function trap() {
  throw new WebAssembly.RuntimeError("the decoder has given up");
}

export class FbsModule {
  /** @param {WebAssembly.Instance} instance */
  constructor(instance) {
    /** @type {any} */
    this.functions = instance.exports;
    /** Names of the weights in Face.blendshapes. */
    this.blendshapeNames = Object.freeze(this.text(this.functions.web_blendshapes()).split(" "));
  }

  /** @param {number} address  of bytes that end with 0 */
  text(address) {
    const bytes = new Uint8Array(this.functions.memory.buffer, address);
    return new TextDecoder().decode(bytes.slice(0, bytes.indexOf(0)));
  }

  open() {
    return new FbsDecoder(this);
  }
}

/**
 * Decodes one stream:
 *
 *     const decoder = (await loadModule()).open();
 *     decoder.feed(bytes);              // again and again, and finish() after the last ones
 *     while (decoder.next() === "picture") show(decoder.draw());
 *
 * next() throws an FbsError where the stream is damaged; called again, it goes on behind the damage.
 */
export class FbsDecoder {
  /** @param {FbsModule} module */
  constructor(module) {
    this.module = module;
    this.handle = module.functions.web_open();
  }

  close() {
    this.module.functions.web_close(this.handle);
    this.handle = 0;
  }

  get memory() {
    return this.module.functions.memory.buffer;
  }

  /** @param {Uint8Array} bytes  the next ones of the stream, copied */
  feed(bytes) {
    const address = this.module.functions.web_room(this.handle, bytes.length);
    new Uint8Array(this.memory, address, bytes.length).set(bytes);
    this.module.functions.web_feed(this.handle);
  }

  /** Ends the stream. */
  finish() {
    this.module.functions.web_finish(this.handle);
  }

  /**
   * Goes on to the next picture. Nothing is drawn yet.
   * @returns {"picture" | "need-data" | "end"}
   */
  next() {
    const status = this.module.functions.web_next(this.handle);
    if (status < 0) throw this.error(status);
    return status === 0 ? "picture" : status === 1 ? "need-data" : "end";
  }

  /**
   * Goes to the scene in which a picture of a time lies; sound goes on from the time itself.
   * @param {number} time
   * @returns {boolean}  false as long as no scene has come, and nothing has changed
   */
  seek(time) {
    return this.module.functions.web_seek(this.handle, time) === 0;
  }

  /** @returns {Announced}  the picture that next() announced last */
  announced() {
    const [number, time, duration, held, newScene] =
      new Float64Array(this.memory, this.module.functions.web_picture(this.handle), 5);
    return { number, time, duration, held: held !== 0, newScene: newScene !== 0 };
  }

  /** @returns {Format}  of the picture that next() announced last */
  format() {
    const [width, height, rateNum, rateDen, aspectNum, aspectDen, matrix, range] =
      new Int32Array(this.memory, this.module.functions.web_format(this.handle), 8);
    const pixelAspect = aspectNum > 0 && aspectDen > 0 ? aspectNum / aspectDen : 1;
    return { width, height, frameRate: rateNum / rateDen, pixelAspect, matrix: MATRICES[matrix], fullRange: range !== 0 };
  }

  /**
   * Draws the picture that next() announced last, with the edit.
   * @param {ArrayBuffer} [buffer]  used again if it has the right size
   * @returns {Picture}
   */
  draw(buffer) {
    const pointers = this.module.functions.web_draw(this.handle);
    if (pointers === 0) throw this.error(-10);
    const { width, height } = this.format();
    const luma = width * height, chroma = ((width + 1) >> 1) * ((height + 1) >> 1);
    const size = luma + 2 * chroma;
    const planes = new Uint8Array(buffer?.byteLength === size ? buffer : new ArrayBuffer(size));
    const [y, u, v] = new Uint32Array(this.memory, pointers, 3);
    planes.set(new Uint8Array(this.memory, y, luma));
    planes.set(new Uint8Array(this.memory, u, chroma), luma);
    planes.set(new Uint8Array(this.memory, v, chroma), luma + chroma);
    return { width, height, planes };
  }

  /** @returns {Face | null}  of that picture, with the edit; null in a scene without a face */
  face() {
    const address = this.module.functions.web_face(this.handle);
    if (address === 0) return null;
    const names = this.module.blendshapeNames;
    const numbers = new Float32Array(this.memory, address, POSE_NUMBERS + 3 * LANDMARKS + names.length);
    const [pitch, yaw, roll, x, y, eyeDistance] = numbers;
    const first = POSE_NUMBERS + 3 * LANDMARKS;
    return {
      pose: { pitch, yaw, roll, x, y, eyeDistance },
      landmarks: numbers.slice(POSE_NUMBERS, first),
      blendshapes: Object.fromEntries(names.map((name, k) => [name, numbers[first + k]])),
    };
  }

  /** @param {FaceEdit} edit  what is added to the motion of the stream from now on */
  edit({ pitch = 0, yaw = 0, roll = 0, brows = 0, mouth = 0, smile = 0, lids = 0 }) {
    this.module.functions.web_edit(this.handle, pitch, yaw, roll, brows, mouth, smile, lids);
  }

  /**
   * The sound from where the last call or seek() ended up to a time, or as far as it has come.
   * @param {number} end
   * @returns {Sound | null}
   */
  sound(end) {
    const { web_sound_channels, web_sound_time, web_sound_take, web_sound_samples } = this.module.functions;
    const sampleRate = this.soundRate;
    if (sampleRate === 0) return null;
    const time = web_sound_time(this.handle);
    const count = web_sound_take(this.handle, end);
    const samples = new Int16Array(this.memory, web_sound_samples(this.handle), count).slice();
    return { time, sampleRate, channels: web_sound_channels(this.handle), samples };
  }

  /** Hz; 0 until sound has arrived. */
  get soundRate() {
    return this.module.functions.web_sound_rate(this.handle);
  }

  /** End of the pictures that have arrived, with all before them. */
  get arrivedTime() {
    return this.module.functions.web_released(this.handle);
  }

  /** Bytes that have arrived, and how many of them are sound. */
  get arrivedBytes() {
    const { web_bytes, web_sound_bytes } = this.module.functions;
    return { all: web_bytes(this.handle), sound: web_sound_bytes(this.handle) };
  }

  /** @param {number} status */
  error(status) {
    const { web_error, web_error_offset } = this.module.functions;
    const code = STATUS_CODES[/** @type {keyof typeof STATUS_CODES} */ (String(status))] ?? "internal";
    return new FbsError(code, this.module.text(web_error(this.handle)), web_error_offset(this.handle));
  }
}
