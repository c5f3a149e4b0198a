/** The decoder without the player. */
import type { Announced, ErrorCode, Face, FaceEdit, Format, Picture, Sound } from "./types";

export * from "./types";

/** What the stream or the decoder has against going on. */
export class FbsError extends Error {
  constructor(code: ErrorCode, message: string, offset?: number);
  readonly code: ErrorCode;
  /** The byte of the stream that it is about; 0 if it is about none. */
  readonly offset: number;
}

/** The file of the module that this machine can run: with vector instructions or without. */
export function moduleUrl(): URL;
/** Fetches and compiles the module; `url`: default moduleUrl(). */
export function compileModule(url?: URL | string): Promise<WebAssembly.Module>;
/** Makes an instance of the module, which is fetched if it is not given. */
export function loadModule(module?: WebAssembly.Module): Promise<FbsModule>;

export class FbsModule {
  private constructor();
  /** Names of the weights in Face.blendshapes. */
  readonly blendshapeNames: readonly string[];
  /** A decoder of one stream. All of a module share its memory, of 2 GB at most. */
  open(): FbsDecoder;
}

/**
 * Decodes one stream: feed bytes, take pictures. Where there is no memory it throws a WebAssembly.RuntimeError or a
 * RangeError, and the module cannot be used any more.
 */
export class FbsDecoder {
  private constructor();
  /** Frees it. Nothing may be called after that. */
  close(): void;
  /** Takes the next bytes of the stream. They are copied. */
  feed(bytes: Uint8Array): void;
  /** No more bytes will come. */
  finish(): void;
  /** Goes on to the next picture, without drawing it. Throws an FbsError where the stream is damaged; called again, it goes
   * on behind the damage. */
  next(): "picture" | "need-data" | "end";
  /** Goes to the scene in which a picture of a time lies: next() gives its first picture. Sound goes on from the time itself.
   * Returns false as long as no scene has come. */
  seek(time: number): boolean;

  /** The picture that next() announced last. */
  announced(): Announced;
  format(): Format;
  /** Draws it, with the edit. `buffer` is used for its planes if it has the right size. */
  draw(buffer?: ArrayBuffer): Picture;
  /** Its face, with the edit, without drawing; null in a scene without a face. */
  face(): Face | null;
  /** Sets what is added to the motion of the stream; what is left out is 0. */
  edit(edit: FaceEdit): void;

  /** The sound from where the last call or seek() ended up to a time, or as far as it has come; null as long as none has. */
  sound(end: number): Sound | null;
  /** Hz; 0 as long as no sound has come. */
  readonly soundRate: number;
  /** End of the pictures that have come, seconds. */
  readonly arrivedTime: number;
  /** Bytes that have come, and those of them that are sound. */
  readonly arrivedBytes: { all: number; sound: number };
}
