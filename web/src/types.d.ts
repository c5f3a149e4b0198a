/** What all pictures of a stream share. */
export interface Format {
  width: number;
  height: number;
  /** Nominal; each picture has its own duration. */
  frameRate: number;
  /** Width of a pixel over its height. */
  pixelAspect: number;
  matrix: "unspecified" | "bt601" | "bt709";
  /** Whether black is 0 and white 255, and not 16 and 235. */
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
  /** The picture was lost: the one before is shown again. */
  held: boolean;
  newScene: boolean;
}

/** Degrees and pixels, as fbs_face_state of fbs/fbs.h has them. */
export interface Pose {
  /** Positive: the face looks down. */
  pitch: number;
  /** Positive: to the picture's left. */
  yaw: number;
  /** Positive: the top of the head leans to the picture's right. */
  roll: number;
  /** Of the middle of the head at the height of the eyes. */
  x: number;
  y: number;
  /** Of the face seen from the front. */
  eyeDistance: number;
}

/** A face as it is shown: with what the visitor has added. */
export interface Face {
  pose: Pose;
  /** 68 points as iBUG (300-W) numbers them: x, y in pixels, and 0..1, the share of the point that is seen. */
  landmarks: Float32Array;
  /** Weights by the names of docs/export.md, most of them ARKit's: jawOpen, mouthSmileLeft ... */
  blendshapes: Record<string, number>;
}

/** What is added to the motion of a stream. 0 changes nothing; beyond the limits is as at the limits. */
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
  /** Of the first sample, seconds. */
  time: number;
  sampleRate: number;
  channels: number;
  /** Channels interleaved. */
  samples: Int16Array;
}

export type ErrorCode =
  /** The bytes could not be fetched. */
  | "network" | "http"
  /** Of the stream, as fbs_status of fbs/fbs.h. */
  | "not-fbs" | "damaged" | "truncated" | "unsupported" | "too-large"
  /** Of the decoder. */
  | "argument" | "no-memory" | "no-face" | "io" | "internal";

/** What went wrong. */
export interface PlayerError {
  code: ErrorCode;
  message: string;
  /** Whether nothing more is played; otherwise the player goes on behind the damage. */
  fatal: boolean;
}

/** What has come of a stream. */
export interface Arrival {
  bytes: number;
  /** Of them. */
  soundBytes: number;
  /** End of the pictures that have come, seconds. */
  time: number;
  /** Hz; 0 as long as no sound has come. */
  soundRate: number;
  /** Whether nothing more will come. */
  complete: boolean;
}

/** Detail of the event `face`. */
export interface FaceDetail {
  /** Of the picture, seconds. */
  time: number;
  /** Null where the stream shows nobody. */
  face: Face | null;
}

/** To the worker. `generation` tells answers from those to earlier requests: it rises with each load and seek. */
export type Request =
  | { type: "module"; module: WebAssembly.Module }
  | { type: "load"; generation: number; url: string }
  /** The next picture that ends after `skipTo`. */
  | { type: "next"; generation: number; skipTo: number; buffer?: ArrayBuffer }
  | { type: "seek"; generation: number; time: number }
  | { type: "sound"; generation: number; to: number }
  | { type: "edit"; edit: FaceEdit }
  /** The last picture once more, with the edit. */
  | { type: "redraw"; generation: number; buffer?: ArrayBuffer };

export interface ShownPicture extends Picture, Announced {
  format: Format;
  face: Face | null;
}

/** From the worker. */
export type Answer =
  | { type: "arrival"; generation: number; arrival: Arrival }
  | { type: "picture"; generation: number; picture: ShownPicture; redraw: boolean }
  /** The next picture has not come yet; it will be sent when it has. */
  | { type: "waiting"; generation: number }
  | { type: "end"; generation: number }
  | { type: "sound"; generation: number; sound: Sound | null }
  | { type: "error"; generation: number; error: PlayerError };
