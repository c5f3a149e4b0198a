/** <fbs-player>, the element. Importing this package defines it. */
import type { Face, FaceDetail, FaceEdit, PlayerError } from "./types";

export * from "./decoder";

/** Fetches and compiles the decoder before a player needs it. All players of the page share it. */
export function prepareDecoder(): Promise<WebAssembly.Module>;

export interface FbsPlayerEventMap extends HTMLElementEventMap {
  /** Fired when a picture is shown. */
  face: CustomEvent<FaceDetail>;
  /** Playback continues after it unless it is fatal. */
  error: CustomEvent<PlayerError> & ErrorEvent;
}

export class FbsPlayer extends HTMLElement {
  // Like HTMLMediaElement. Further events: play, playing, pause, timeupdate, waiting, seeking, seeked, ended,
  // loadedmetadata, loadeddata, durationchange, progress, volumechange; and preview.
  src: string;
  preload: string;
  autoplay: boolean;
  loop: boolean;
  controls: boolean;
  muted: boolean;
  /** 0..1 */
  volume: number;
  /** Seconds. Waits for a time that has not arrived. */
  currentTime: number;
  /** Seconds: NaN before the first picture, Infinity until the whole stream has arrived. */
  readonly duration: number;
  readonly paused: boolean;
  readonly ended: boolean;
  readonly seeking: boolean;
  readonly error: PlayerError | null;
  readonly currentSrc: string;
  readonly videoWidth: number;
  readonly videoHeight: number;
  /** Rejects where nothing can be played, and where the browser allows no sound before a visitor's action. */
  play(): Promise<void>;
  pause(): void;
  load(): void;

  /** Describes the picture for visitors who cannot see it. The attribute is `label`. */
  label: string;
  /** Changes to the motion of the stream. Setting changes only the members named. */
  get faceEdit(): Required<FaceEdit>;
  set faceEdit(edit: FaceEdit);
  /** The face in the picture shown; null without a face. */
  readonly face: Face | null;
  /** Seconds of the stream that have arrived. */
  readonly arrivedTime: number;
  /** Average kbit/s of the part that has arrived. */
  readonly rate: { picture: number; sound: number };

  addEventListener<K extends keyof FbsPlayerEventMap>(
    type: K, listener: (this: FbsPlayer, event: FbsPlayerEventMap[K]) => unknown, options?: boolean | AddEventListenerOptions): void;
  addEventListener(
    type: string, listener: EventListenerOrEventListenerObject, options?: boolean | AddEventListenerOptions): void;
}

declare global {
  interface HTMLElementTagNameMap {
    "fbs-player": FbsPlayer;
  }
}
