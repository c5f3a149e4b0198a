/**
 * Plays a stream: asks the worker for pictures and sound, and shows each picture at its time. Reports events through `emit`,
 * under the names of HTMLMediaElement's events where they exist.
 */
import { DecoderClient } from "./decoder_client.js";
import { SoundOutput } from "./sound_output.js";
import { WallClock } from "./wall_clock.js";

/** Seconds of sound fetched ahead, whenever a third has been used: a hidden page looks once a second. */
const SOUND_AHEAD = 3;
/** Interval of `timeupdate`, and of looks at the clock while the page is hidden. */
const UPDATE_MS = 250;

/**
 * @typedef {import("./types").ShownPicture} ShownPicture
 * @typedef {import("./types").Arrival} Arrival
 * @typedef {import("./types").PlayerError} PlayerError
 * @typedef {import("./types").Answer} Answer
 */

/** @type {Arrival} */
const NOTHING = { bytes: 0, soundBytes: 0, time: 0, soundRate: 0, complete: false };

export class Playback {
  loop = false;
  volume = 1;
  muted = false;
  playing = false;
  ended = false;
  /** @type {PlayerError | null} */
  error = null;
  arrival = NOTHING;
  /** @type {ShownPicture | null} */
  shown = null;
  /**
   * The buffer of a picture that is no longer shown.
   * @type {ArrayBuffer | undefined}
   */
  spare;
  /** Where the clock begins when it starts, seconds. */
  position = 0;
  /** @type {WallClock | SoundOutput} */
  clock = new WallClock();
  /** @type {SoundOutput | null} */
  sound = null;

  /**
   * The next picture, before its time.
   * @type {ShownPicture | null}
   */
  pending = null;
  requested = false;
  seeking = false;
  /** The next picture has not arrived. */
  waiting = false;
  /** There is no next picture. */
  atEnd = false;
  soundRequested = false;
  /** All sound that has arrived has been taken. */
  soundStarved = false;
  redrawing = false;
  redrawAgain = false;

  timer = 0;
  frame = 0;
  lastUpdate = 0;

  /** @param {(type: string, detail?: any) => void} emit */
  constructor(emit) {
    this.emit = emit;
    this.client = new DecoderClient((answer) => this.take(answer));
  }

  /** Returns to the state before the first load. */
  forget() {
    this.unschedule();
    this.closeSound();
    this.playing = this.ended = false;
    this.error = this.shown = null;
    this.arrival = NOTHING;
    this.spare = undefined;
    this.position = 0;
    this.forgetRequests();
  }

  /** Ignores the answers to all earlier requests. */
  forgetRequests() {
    this.pending = null;
    this.requested = this.seeking = this.waiting = this.atEnd = false;
    this.soundRequested = this.soundStarved = false;
    this.redrawing = this.redrawAgain = false;
  }

  /** @param {string} url  absolute */
  load(url) {
    this.forget();
    this.client.load(url);
    this.request(-1);
  }

  stop() {
    this.client.stop();
    this.forget();
  }

  /** Whether something has been loaded and can be played. */
  get usable() {
    return (this.shown !== null || this.requested) && !this.error?.fatal;
  }

  get currentTime() {
    if (!this.clock.running || !this.shown) return this.position;
    return Math.min(this.clock.time(), this.duration);
  }

  /** Infinity until everything has arrived; NaN before there is a picture. */
  get duration() {
    if (!this.shown) return NaN;
    return this.arrival.complete ? Math.max(this.arrival.time, endOf(this.shown)) : Infinity;
  }

  /** @returns {Promise<boolean>}  false: the browser allows no sound before the visitor has done something */
  async play() {
    if (this.playing || !this.usable) return true;
    this.playing = true;
    this.emit("play");
    if (this.ended) this.seek(0);
    return this.goWithSound();
  }

  pause() {
    if (!this.playing) return;
    this.playing = false;
    this.halt(this.currentTime);
    // The decoder is at the next picture already, while an edit must redraw the one that is seen.
    if (this.pending) this.showPending();
    this.sound?.rest();
    this.emit("timeupdate");
    this.emit("pause");
  }

  /** @param {number} time */
  seek(time) {
    if (!this.usable) return;
    const end = this.duration || Infinity;
    this.halt(Math.max(0, Math.min(time, end)));
    this.forgetRequests();
    this.sound?.clear();
    this.ended = false;
    this.seeking = this.requested = true;
    this.client.seek(this.position);
    this.emit("seeking");
  }

  /** @param {import("./types").FaceEdit} edit */
  edit(edit) {
    this.client.edit(edit);
    if (this.clock.running || !this.shown) return;
    // A picture on its way may have been drawn without the edit.
    if (this.redrawing || (this.requested && !this.waiting)) this.redrawAgain = true;
    else this.redraw();
  }

  redraw() {
    this.redrawAgain = false;
    this.redrawing = true;
    this.client.redraw();
  }

  /** Applies a change of volume or muting. */
  async changeVolume() {
    if (this.sound) this.sound.volume = this.muted ? 0 : this.volume;
    else if (this.playing && this.wantsSound) await this.goWithSound();
  }

  get wantsSound() {
    return this.arrival.soundRate > 0 && !this.muted;
  }

  /**
   * Continues, by the clock of the sound if there is any.
   * @returns {Promise<boolean>}  whether the browser allows it
   */
  async goWithSound() {
    if (!this.wantsSound) {
      this.go();
      return true;
    }
    if (this.clock.running) this.halt(this.currentTime);
    this.sound ??= new SoundOutput(this.arrival.soundRate);
    const { sound } = this;
    sound.volume = this.volume;
    const allowed = await sound.allowed();
    if (sound !== this.sound) return true;
    if (allowed) {
      this.clock = sound;
    } else {
      this.closeSound();
      this.pause();
    }
    this.go();
    return allowed;
  }

  closeSound() {
    this.sound?.close();
    this.sound = null;
    this.clock = new WallClock();
  }

  /** Starts the clock when everything it needs is there. */
  go() {
    if (!this.playing || this.clock.running || !this.shown || this.seeking) return;
    if (this.sound && this.sound !== this.clock) return;  // still being opened
    if (this.sound && this.sound.end <= this.position && !this.soundStarved) return this.requestSound();
    if (!this.pending && !this.requested && !this.atEnd) this.request(this.position);
    if (this.waiting && !this.pending) return;
    this.clock.start(this.position);
    this.emit("playing");
    this.tick();
  }

  /** @param {number} position  where the clock is to go on */
  halt(position) {
    this.unschedule();
    if (this.clock.running) this.clock.stop();
    this.position = position;
  }

  schedule() {
    this.frame = requestAnimationFrame(() => this.tick());
    this.timer = setTimeout(() => this.tick(), UPDATE_MS);
  }

  unschedule() {
    cancelAnimationFrame(this.frame);
    clearTimeout(this.timer);
  }

  tick() {
    this.unschedule();
    if (!this.clock.running || !this.shown) return;
    const now = this.clock.time();
    if (this.pending && this.pending.time <= now) this.showPending();
    if (!this.pending && !this.requested && !this.atEnd) this.request(now);
    if (this.sound && this.sound.end < now + SOUND_AHEAD * 2 / 3 && !this.soundStarved) this.requestSound();
    if (!this.pending && now >= endOf(this.shown)) {
      if (this.atEnd) return this.finish();
      if (this.waiting) return this.stall();
    }
    if (performance.now() >= this.lastUpdate + UPDATE_MS) this.emitTime();
    this.schedule();
  }

  emitTime() {
    this.lastUpdate = performance.now();
    this.emit("timeupdate");
  }

  stall() {
    this.halt(endOf(/** @type {ShownPicture} */ (this.shown)));
    this.emit("waiting");
  }

  finish() {
    this.halt(this.duration);
    if (this.loop) return this.seek(0);
    this.playing = false;
    this.ended = true;
    this.sound?.rest();
    this.emit("timeupdate");
    this.emit("pause");
    this.emit("ended");
  }

  /** @param {number} skipTo */
  request(skipTo) {
    this.requested = true;
    this.client.next(skipTo, this.spare);
    this.spare = undefined;
  }

  requestSound() {
    if (this.soundRequested) return;
    this.soundRequested = true;
    this.client.sound(Math.min(this.currentTime + SOUND_AHEAD, this.duration));
  }

  /** @param {ShownPicture} picture */
  show(picture) {
    if (this.shown) this.spare = /** @type {ArrayBuffer} */ (this.shown.planes.buffer);
    this.shown = picture;
    this.emit("picture", picture);
  }

  showPending() {
    if (this.pending) this.show(this.pending);
    this.pending = null;
    if (!this.playing && this.shown) this.position = this.shown.time;
  }

  /** @param {Answer} answer */
  take(answer) {
    if (answer.type === "preview") this.emit("preview", answer.picture);
    if (answer.type === "arrival") this.takeArrival(answer.arrival);
    if (answer.type === "picture" && answer.redraw) this.takeRedrawn(answer.picture);
    if (answer.type === "picture" && !answer.redraw) this.takePicture(answer.picture);
    if (answer.type === "waiting") this.takeWaiting();
    if (answer.type === "end") this.takeEnd();
    if (answer.type === "sound") this.takeSound(answer.sound);
    if (answer.type === "error") this.takeError(answer.error);
  }

  /** @param {Arrival} arrival */
  takeArrival(arrival) {
    const { duration } = this;
    this.arrival = arrival;
    this.soundStarved = false;
    this.emit("progress");
    if (this.shown && this.duration !== duration) this.emit("durationchange");
    if (this.playing && this.wantsSound && !this.sound) this.goWithSound();
  }

  /** @param {ShownPicture} picture */
  takePicture(picture) {
    this.requested = this.waiting = false;
    const first = !this.shown, { seeking } = this;
    if (this.clock.running) {
      this.pending = picture;
      return;
    }
    this.seeking = false;
    // A seek goes to a time within the picture.
    this.position = seeking ? Math.max(picture.time, Math.min(this.position, endOf(picture))) : picture.time;
    this.show(picture);
    if (first) this.emit("loadedmetadata");
    if (first) this.emit("loadeddata");
    if (seeking) this.emit("seeked");
    if (seeking) this.emitTime();
    if (this.redrawAgain && !this.playing) this.redraw();
    this.go();
  }

  /** @param {ShownPicture} picture */
  takeRedrawn(picture) {
    this.redrawing = false;
    if (this.shown?.number === picture.number) this.show(picture);
    if (this.redrawAgain) this.redraw();
  }

  takeWaiting() {
    this.waiting = true;
    if (!this.clock.running) this.emit("waiting");
  }

  takeEnd() {
    this.requested = this.waiting = false;
    this.atEnd = true;
    if (!this.playing && this.shown && this.position >= endOf(this.shown)) this.ended = true;
    this.go();
  }

  /** @param {import("./types").Sound | null} sound */
  takeSound(sound) {
    this.soundRequested = false;
    this.soundStarved = !sound || sound.samples.length === 0;
    if (sound) this.sound?.add(sound);
    this.go();
  }

  /** @param {PlayerError} error */
  takeError(error) {
    this.error = error;
    if (error.fatal) {
      this.requested = false;
      this.pause();
      this.client.stop();
    }
    this.emit("error", error);
  }
}

/** @param {ShownPicture} picture */
function endOf(picture) {
  return picture.time + picture.duration;
}
