/**
 * The first picture of a stream before its decoder has come: a small module finds the AV1 frame that it is drawn from, and the
 * browser decodes that. It has not moved yet, and its contrast along the face is nearly right.
 */
import { compileModule, formatAt, moduleUrl } from "./fbs_module.js";
import { SYSTEM } from "./sound_codecs.js";
import { readStream } from "./stream_source.js";

/** Main profile, 8 bits, and a level that has all sizes. */
const CODEC = "av01.0.16M.08";
// Not where the page has come without TLS.
const { VideoDecoder, EncodedVideoChunk, caches } = /** @type {any} */ (globalThis);

/** @param {Uint8Array} data  @returns {Promise<any>}  a VideoFrame */
function decode(data) {
  return new Promise((resolve, error) => {
    const output = (/** @type {any} */ frame) => {
      resolve(frame);
      decoder.close();
    };
    const decoder = new VideoDecoder({ output, error });
    decoder.configure({ codec: CODEC, hardwareAcceleration: "prefer-software" });
    decoder.decode(new EncodedVideoChunk({ type: "key", timestamp: 0, data }));
    decoder.flush().then(error, error);  // there has been no picture
  });
}

export class Preview {
  /** @param {any} functions  of the module, which is for one stream */
  constructor(functions) {
    this.functions = functions;
  }

  /** @returns {Promise<Preview | null>}  null where the browser has no such decoder, or a service worker has ours */
  static async load() {
    if (!VideoDecoder || (await caches.match(moduleUrl()))) return null;
    const module = await compileModule(new URL("./preview.wasm", import.meta.url));
    const { exports } = await WebAssembly.instantiate(module, SYSTEM);
    /** @type {any} */ (exports)._initialize();
    return new Preview(exports);
  }

  /**
   * @param {Response} stream  is read as far as needed
   * @returns {Promise<import("./types").PaintedPicture>}  rejects where none can be had
   */
  async picture(stream) {
    const { memory, malloc, preview_feed, preview_draw } = this.functions;
    let found = 0;
    await readStream(stream, (bytes) => {
      const address = malloc(bytes.length);
      new Uint8Array(memory.buffer, address, bytes.length).set(bytes);
      return (found = preview_feed(address, bytes.length));
    });
    if (!found) throw new Error("the stream has no picture");
    const [av1, size] = new Uint32Array(memory.buffer, found, 2);
    const format = formatAt(memory.buffer, found + 8), { width, height } = format;
    const frame = await decode(new Uint8Array(memory.buffer, av1, size));
    const bytes = width * height + 2 * ((width + 1) >> 1) * ((height + 1) >> 1), address = malloc(bytes);
    await frame.copyTo(new Uint8Array(memory.buffer, address, bytes));
    const { format: layout, visibleRect } = frame;
    frame.close();
    if (layout !== "I420" || !preview_draw(address, visibleRect.width, visibleRect.height)) throw new Error("another size");
    return { width, height, planes: new Uint8Array(memory.buffer, address, bytes).slice(), format };
  }
}
