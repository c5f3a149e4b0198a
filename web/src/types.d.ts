/** Properties shared by all pictures of a stream. */
export interface Format {
  width: number;
  height: number;
  /** Nominal; each picture has its own duration. */
  frameRate: number;
  /** Width of a pixel over its height. */
  pixelAspect: number;
  matrix: "unspecified" | "bt601" | "bt709";
  /** Whether black is 0 and white 255, rather than 16 and 235. */
  fullRange: boolean;
}

/** A picture in 8-bit 4:2:0: the planes Y, Cb, Cr one after another, chroma (width + 1) / 2 by (height + 1) / 2. */
export interface Picture {
  width: number;
  height: number;
  planes: Uint8Array;
}

/** A picture's place in its stream. */
export interface Announced {
  /** From 0. */
  number: number;
  /** Seconds from the first picture. */
  time: number;
  /** Seconds. */
  duration: number;
  /** The picture was lost: the previous one is shown again. */
  held: boolean;
  newScene: boolean;
}

/** Degrees and pixels, as in fbs_face_state of fbs/fbs.h. */
export interface Pose {
  /** Positive: the face looks down. */
  pitch: number;
  /** Positive: to the picture's left. */
  yaw: number;
  /** Positive: the top of the head leans to the picture's right. */
  roll: number;
  /** The middle of the head at the height of the eyes. */
  x: number;
  y: number;
  /** With the face seen from the front. */
  eyeDistance: number;
}

/** A face as shown: with the visitor's changes. */
export interface Face {
  pose: Pose;
  /** 68 points in the order of iBUG (300-W): x, y in pixels, and the visible share of the point, 0..1. */
  landmarks: Float32Array;
  /** Weights by the names of docs/export.md, most of them ARKit's: jawOpen, mouthSmileLeft ... */
  blendshapes: Record<string, number>;
}

/** Changes to the motion of a stream. 0 changes nothing; values beyond the limits count as the limits. */
export interface FaceEdit {
  /** Degrees, -12..12: positive: the face looks down. */
  pitch?: number;
  /** Degrees, -18..18: positive: to the picture's left. */
  yaw?: number;
  /** Degrees, -15..15: positive: the top of the head leans to the picture's right. */
  roll?: number;
  /** -1..1: positive: raised. */
  brows?: number;
  /** -1..1: positive: opened. */
  mouth?: number;
  /** -1..1: positive: corners out and up. */
  smile?: number;
  /** -1..1: positive: shut. */
  lids?: number;
}

export interface Sound {
  /** Time of the first sample, seconds. */
  time: number;
  sampleRate: number;
  channels: number;
  /** Channels interleaved. */
  samples: Int16Array;
}

export type ErrorCode =
  /** The bytes could not be fetched. */
  | "network" | "http"
  /** From the stream, as fbs_status of fbs/fbs.h. */
  | "not-fbs" | "damaged" | "truncated" | "unsupported" | "too-large"
  /** From the decoder. */
  | "argument" | "no-memory" | "no-face" | "io" | "internal";

/** An error of the player. */
export interface PlayerError {
  code: ErrorCode;
  message: string;
  /** Whether nothing more is played; otherwise the player continues after the damage. */
  fatal: boolean;
}

/** The part of a stream that has arrived. */
export interface Arrival {
  bytes: number;
  /** How many of them are sound. */
  soundBytes: number;
  /** End of the pictures that have arrived, seconds. */
  time: number;
  /** Hz; 0 until sound has arrived. */
  soundRate: number;
  /** Whether no more will arrive. */
  complete: boolean;
}

/** Detail of the event `face`. */
export interface FaceDetail {
  /** Time of the picture, seconds. */
  time: number;
  /** Null where the stream shows no face. */
  face: Face | null;
}

/** To the worker. `generation` rises with each load and seek: it tells answers from those to earlier
 * requests. */
export type Request =
  | { type: "module"; module: WebAssembly.Module }
  /** `preview`: there is time for one, since the decoder has not been loaded. */
  | { type: "load"; generation: number; url: string; preview: boolean }
  /** The next picture that ends after `skipTo`. */
  | { type: "next"; generation: number; skipTo: number; buffer?: ArrayBuffer }
  | { type: "seek"; generation: number; time: number }
  | { type: "sound"; generation: number; to: number }
  | { type: "edit"; edit: FaceEdit }
  /** The last picture again, with the edit. */
  | { type: "redraw"; generation: number; buffer?: ArrayBuffer };

export interface PaintedPicture extends Picture {
  format: Format;
}

export interface ShownPicture extends PaintedPicture, Announced {
  face: Face | null;
}

/** From the worker. */
export type Answer =
  /** The decoder is needed now. */
  | { type: "module" }
  /** The first picture, nearly as it will be. */
  | { type: "preview"; generation: number; picture: PaintedPicture }
  | { type: "arrival"; generation: number; arrival: Arrival }
  | { type: "picture"; generation: number; picture: ShownPicture; redraw: boolean }
  /** The next picture has not arrived; it will be sent when it has. */
  | { type: "waiting"; generation: number }
  | { type: "end"; generation: number }
  | { type: "sound"; generation: number; sound: Sound | null }
  | { type: "error"; generation: number; error: PlayerError };
