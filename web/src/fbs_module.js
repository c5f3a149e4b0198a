/**
 * The decoder: a WebAssembly module, and its functions with the types of JavaScript.
 * Times are seconds, from the first picture of the stream.
 */

import { SoundCodecs, SYSTEM, trap } from "./sound_codecs.js";

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

// The structs of include/fbs are read and written in place: web/module/layout.c checks where their members lie.
const LANDMARKS = 68, BLENDSHAPES = 32;
const STATE_BYTES = 4 * (6 + 2 * 36);
/** In a decoder's own block of memory: fbs_picture_info of the last picture, and what any call takes or gives. */
const INFO = 0, ANY = 32, BLOCK_BYTES = 2048;

const TICKS_PER_SECOND = 90000, SOUND_TICKS_PER_SECOND = 48000;
/** Most pixels of a picture, 4096 x 2304: a module has 2 GB, and a scene of 64 patterns takes 220 bytes a pixel. */
const MAX_PIXELS = 4096n * 2304n;

/** @param {number} seconds  @returns {bigint}  what no stream reaches counts as the limit of numbers */
const ticks = (seconds) => BigInt(Math.min(Math.round(Math.max(seconds, 0) * TICKS_PER_SECOND) || 0, Number.MAX_SAFE_INTEGER));

/** As fbs_status of fbs/fbs.h has them. */
const STATUS_CODES = /** @type {const} */ ({
  "-1": "argument", "-2": "not-fbs", "-3": "damaged", "-4": "truncated", "-5": "unsupported", "-6": "too-large",
  "-7": "no-memory", "-8": "no-face", "-9": "io", "-10": "internal",
});

const MATRICES = /** @type {const} */ (["unspecified", "bt601", "bt709"]);

/** @param {ArrayBuffer} memory  @param {number} address  of an fbs_format  @returns {Format} */
export function formatAt(memory, address) {
  const [width, height, rateNum, rateDen, aspectNum, aspectDen, matrix, range] = new Uint32Array(memory, address, 8);
  const pixelAspect = aspectNum > 0 && aspectDen > 0 ? aspectNum / aspectDen : 1;
  return { width, height, frameRate: rateNum / rateDen, pixelAspect, matrix: MATRICES[matrix], fullRange: range !== 0 };
}

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
  const codecs = new SoundCodecs(compileModule);
  const imports = { ...SYSTEM, env: { ...SYSTEM.env, ...codecs.functions() } };
  const instance = await WebAssembly.instantiate(module ?? (await compileModule()), imports);
  codecs.memory = /** @type {WebAssembly.Memory} */ (instance.exports.memory);
  /** @type {any} */ (instance.exports)._initialize();
  return new FbsModule(instance, codecs);
}

export class FbsModule {
  /** @param {WebAssembly.Instance} instance  @param {SoundCodecs} codecs */
  constructor(instance, codecs) {
    /** @type {any} */
    this.functions = instance.exports;
    this.codecs = codecs;
    /** Names of the weights in Face.blendshapes. */
    this.blendshapeNames = Object.freeze(Array.from({ length: BLENDSHAPES }, (_, k) =>
      this.text(this.functions.fbs_blendshape_name(k))));
  }

  /** @param {number} address  of bytes that end with 0 */
  text(address) {
    const bytes = new Uint8Array(this.functions.memory.buffer, address);
    return new TextDecoder().decode(bytes.slice(0, bytes.indexOf(0)));
  }

  /**
   * Loads a decoder of sound. Those that a stream needs are fetched when it has come: sound() has none until then.
   * @param {"opus" | "codec2"} codec
   * @param {WebAssembly.Module} [module]  default: it is fetched
   */
  loadSound(codec, module) {
    return this.codecs.load(codec, module);
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
    this.functions = module.functions;
    /** All bytes that have come, for seeking. */
    this.stream = { address: 0, size: 0, capacity: 0, finished: false };
    /** Where in it the decoder began. */
    this.origin = this.decoder = this.soundReader = 0;
    this.block = this.functions.malloc(BLOCK_BYTES);
    this.functions.fbs_decoder_default_settings(this.block + ANY, 40);
    this.view.setBigUint64(ANY + 8, MAX_PIXELS, true);
    this.check(this.functions.fbs_decoder_open(this.block, this.block + ANY));
    this.decoder = this.view.getUint32(0, true);
    this.check(this.functions.fbs_sound_open(this.block));
    this.soundReader = this.view.getUint32(0, true);
  }

  close() {
    const { free, fbs_decoder_close, fbs_sound_close } = this.functions;
    this.view.setUint32(ANY, this.decoder, true);
    fbs_decoder_close(this.block + ANY);
    this.view.setUint32(ANY, this.soundReader, true);
    fbs_sound_close(this.block + ANY);
    free(this.stream.address);
    free(this.block);
    this.decoder = this.soundReader = 0;
  }

  get memory() {
    return this.functions.memory.buffer;
  }

  /** The decoder's block: memory moves when it grows. */
  get view() {
    return new DataView(this.memory, this.block, BLOCK_BYTES);
  }

  /** @param {Uint8Array} bytes  the next ones of the stream, copied */
  feed(bytes) {
    const stream = this.stream, end = stream.size + bytes.length;
    if (end > stream.capacity) {
      const capacity = Math.max(end, 2 * stream.capacity), address = this.functions.realloc(stream.address, capacity);
      if (address === 0) trap();
      stream.address = address;
      stream.capacity = capacity;
    }
    const address = stream.address + stream.size;
    new Uint8Array(this.memory, address, bytes.length).set(bytes);
    this.check(this.functions.fbs_decoder_feed(this.decoder, address, bytes.length));
    stream.size = end;
    this.functions.fbs_sound_feed(this.soundReader, address, bytes.length);
  }

  /** Ends the stream. */
  finish() {
    this.stream.finished = true;
    this.check(this.functions.fbs_decoder_finish(this.decoder));
  }

  /**
   * Goes on to the next picture. Nothing is drawn yet.
   * @returns {"picture" | "need-data" | "end"}
   */
  next() {
    const status = this.check(this.functions.fbs_decoder_next(this.decoder, this.block + INFO));
    return status === 0 ? "picture" : status === 1 ? "need-data" : "end";
  }

  /**
   * Goes to the scene in which a picture of a time lies; sound goes on from the time itself.
   * @param {number} time
   * @returns {boolean}  false as long as no scene has come, and nothing has changed
   */
  seek(time) {
    const { fbs_find_scene, fbs_decoder_reset, fbs_decoder_feed, fbs_decoder_finish, fbs_sound_seek } = this.functions;
    const { address, size, finished } = this.stream;
    if (fbs_find_scene(address, size, ticks(time), this.block + ANY) !== 0) return false;
    this.origin = Number(this.view.getBigUint64(ANY, true));
    this.check(fbs_decoder_reset(this.decoder));
    this.check(fbs_decoder_feed(this.decoder, address + this.origin, size - this.origin));
    if (finished) this.check(fbs_decoder_finish(this.decoder));
    fbs_sound_seek(this.soundReader, ticks(time));
    return true;
  }

  /** @returns {Announced}  the picture that next() announced last */
  announced() {
    const view = this.view;
    return {
      number: Number(view.getBigUint64(INFO, true)),
      time: Number(view.getBigUint64(INFO + 8, true)) / TICKS_PER_SECOND,
      duration: view.getUint32(INFO + 16, true) / TICKS_PER_SECOND,
      held: view.getInt32(INFO + 20, true) !== 0,
      newScene: view.getInt32(INFO + 24, true) !== 0,
    };
  }

  /** @returns {Format}  of the picture that next() announced last */
  format() {
    this.functions.fbs_decoder_get_format(this.decoder, this.block + ANY);
    return formatAt(this.memory, this.block + ANY);
  }

  /**
   * Draws the picture that next() announced last, with the edit.
   * @param {ArrayBuffer} [buffer]  used again if it has the right size
   * @returns {Picture}
   */
  draw(buffer) {
    const { width, height } = this.format();
    const sides = [[width, height], [(width + 1) >> 1, (height + 1) >> 1]];
    const size = width * height + 2 * sides[1][0] * sides[1][1];
    const planes = new Uint8Array(buffer?.byteLength === size ? buffer : new ArrayBuffer(size));
    this.check(this.functions.fbs_decoder_get_picture(this.decoder, this.block + ANY));
    const pointers = new Int32Array(this.memory, this.block + ANY + 8, 6);  // and strides
    for (let k = 0, at = 0; k < 3; ++k)
      for (let [columns, rows] = sides[Math.min(k, 1)], row = 0; row < rows; ++row, at += columns)
        planes.set(new Uint8Array(this.memory, pointers[k] + row * pointers[3 + k], columns), at);
    return { width, height, planes };
  }

  /** @returns {Face | null}  of that picture, with the edit; null in a scene without a face */
  face() {
    const { fbs_decoder_get_state, fbs_decoder_get_landmarks, fbs_decoder_get_blendshapes } = this.functions;
    const state = this.block + ANY, landmarks = state + STATE_BYTES, weights = landmarks + 12 * LANDMARKS;
    if (fbs_decoder_get_state(this.decoder, state) !== 0) return null;
    this.check(fbs_decoder_get_landmarks(this.decoder, landmarks));
    this.check(fbs_decoder_get_blendshapes(this.decoder, weights));
    const [pitch, yaw, roll, x, y, eyeDistance] = new Float32Array(this.memory, state, 6);
    const shapes = new Float32Array(this.memory, weights, BLENDSHAPES);
    return {
      pose: { pitch, yaw, roll, x, y, eyeDistance },
      landmarks: new Float32Array(this.memory, landmarks, 3 * LANDMARKS).slice(),
      blendshapes: Object.fromEntries(this.module.blendshapeNames.map((name, k) => [name, shapes[k]])),
    };
  }

  /** @param {FaceEdit} edit  what is added to the motion of the stream from now on */
  edit({ pitch = 0, yaw = 0, roll = 0, brows = 0, mouth = 0, smile = 0, lids = 0 }) {
    new Float32Array(this.memory, this.block + ANY, 7).set([pitch, yaw, roll, brows, mouth, smile, lids]);
    this.functions.fbs_decoder_set_edit(this.decoder, this.block + ANY);  // which refuses what is not a number
  }

  /**
   * The sound from where the last call or seek() ended up to a time, or as far as it has come.
   * @param {number} end
   * @returns {Sound | null}
   */
  sound(end) {
    if (this.functions.fbs_sound_take(this.soundReader, ticks(end), this.block + ANY) !== 0) return null;
    const view = this.view;
    const time = Number(view.getBigUint64(ANY, true)) / SOUND_TICKS_PER_SECOND;
    const [sampleRate, channels, count, address] = new Uint32Array(this.memory, this.block + ANY + 8, 4);
    return { time, sampleRate, channels, samples: new Int16Array(this.memory, address, count * channels).slice() };
  }

  /** What has come of the sound: Hz, bytes, and ticks. */
  arrived() {
    this.check(this.functions.fbs_sound_get_info(this.soundReader, this.block + ANY));
    const view = this.view;
    return {
      rate: view.getUint32(ANY, true),
      bytes: Number(view.getBigUint64(ANY + 8, true)),
      until: Number(view.getBigUint64(ANY + 16, true)),
    };
  }

  /** Hz; 0 until sound has arrived. */
  get soundRate() {
    return this.arrived().rate;
  }

  /** End of the pictures that have arrived, with all before them. */
  get arrivedTime() {
    return this.arrived().until / TICKS_PER_SECOND;
  }

  /** Bytes that have arrived, and how many of them are sound. */
  get arrivedBytes() {
    return { all: this.stream.size, sound: this.arrived().bytes };
  }

  /** @param {number} status  @returns {number}  it, unless it is an error, which is thrown */
  check(status) {
    if (status >= 0) return status;
    const code = STATUS_CODES[/** @type {keyof typeof STATUS_CODES} */ (String(status))] ?? "internal";
    const { fbs_decoder_error, fbs_decoder_error_offset } = this.functions;
    const offset = this.origin + Number(fbs_decoder_error_offset(this.decoder));
    throw new FbsError(code, this.module.text(fbs_decoder_error(this.decoder)), offset);
  }
}
