/** The decoder without the player. */
import type { Announced, ErrorCode, Face, FaceEdit, Format, Picture, Sound } from "./types";

export * from "./types";

/** An error of the stream or of the decoder. */
export class FbsError extends Error {
  constructor(code: ErrorCode, message: string, offset?: number);
  readonly code: ErrorCode;
  /** The offset in the stream of the error's cause; 0 if it has none. */
  readonly offset: number;
}

/** The module file for this machine: with or without vector instructions. */
export function moduleUrl(): URL;
/** Fetches and compiles the module; `url`: default moduleUrl(). */
export function compileModule(url?: URL | string): Promise<WebAssembly.Module>;
/** Creates an instance of the module, which is fetched if not given. */
export function loadModule(module?: WebAssembly.Module): Promise<FbsModule>;

export class FbsModule {
  private constructor();
  /** Names of the weights in Face.blendshapes. */
  readonly blendshapeNames: readonly string[];
  /** Loads a decoder of sound; `module`: default, it is fetched. In pages and workers that which a stream needs is fetched
   * by itself. Node fetches no files: give the module there. */
  loadSound(codec: "opus" | "codec2", module?: WebAssembly.Module): Promise<void>;
  /** Opens a decoder of one stream. All decoders of a module share its memory, at most 2 GB. */
  open(): FbsDecoder;
}

/**
 * Decodes one stream: feed bytes, take pictures. Where there is no memory it throws a WebAssembly.RuntimeError or a
 * RangeError, and the module cannot be used any more.
 */
export class FbsDecoder {
  private constructor();
  /** Frees the decoder. No method may be called afterwards. */
  close(): void;
  /** Copies the next bytes of the stream. */
  feed(bytes: Uint8Array): void;
  /** Ends the stream. */
  finish(): void;
  /** Advances to the next picture, without drawing it. Throws an FbsError where the stream is damaged; the next call
   * continues after the damage. */
  next(): "picture" | "need-data" | "end";
  /** Goes to the scene that contains a time: next() gives its first picture. Sound continues from the time itself.
   * Returns false until a scene has arrived. */
  seek(time: number): boolean;

  /** The picture that next() announced last. */
  announced(): Announced;
  format(): Format;
  /** Draws the picture, with the edit. `buffer` is used for its planes if it has the right size. */
  draw(buffer?: ArrayBuffer): Picture;
  /** The picture's face, with the edit, without drawing; null in a scene without a face. */
  face(): Face | null;
  /** Sets the changes to the motion of the stream; omitted members are 0. */
  edit(edit: FaceEdit): void;

  /** The sound from the end of the last call or seek() up to a time, or as far as it has arrived; null until some
   * has, and its decoder (loadSound). */
  sound(end: number): Sound | null;
  /** Hz; 0 until sound has arrived, and its decoder. */
  readonly soundRate: number;
  /** End of the pictures that have arrived, seconds. */
  readonly arrivedTime: number;
  /** Bytes that have arrived, and how many of them are sound. */
  readonly arrivedBytes: { all: number; sound: number };
}
