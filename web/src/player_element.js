/** <fbs-player>: the element of a page. Attributes and functions follow <video> where it has them. */
import { ControlBar } from "./control_bar.js";
import { FaceControls } from "./face_controls.js";
import { PicturePainter } from "./picture_painter.js";
import { Playback } from "./playback.js";
import { STYLE } from "./style.js";

const TEMPLATE = `<style>${STYLE}</style>
<div class="frame" role="group">
  <div class="stage"><canvas aria-hidden="true"></canvas><p class="message"></p></div>
  <div class="bar" hidden></div>
  <div class="face" role="group" aria-label="Face" hidden></div>
  <p class="spoken" role="status"></p>
</div>`;

/** What the status line says of an event. */
const SPOKEN = /** @type {Record<string, string>} */ ({
  play: "Playing", pause: "Paused", ended: "Ended", waiting: "Waiting for the stream",
});

/**
 * @typedef {import("./types").FaceEdit} FaceEdit
 * @typedef {import("./types").PlayerError} PlayerError
 * @typedef {import("./types").ShownPicture} ShownPicture
 */

const SEEK_SECONDS = 5;
const VOLUME_STEP = 0.1;

export class FbsPlayer extends HTMLElement {
  static observedAttributes = ["src", "controls", "loop", "muted", "label"];

  constructor() {
    super();
    const root = this.attachShadow({ mode: "open" });
    root.innerHTML = TEMPLATE;
    const part = (/** @type {string} */ name) => /** @type {HTMLElement} */ (root.querySelector(name));
    this.frame = part(".frame");
    this.stage = part(".stage");
    this.message = part(".message");
    this.bar = part(".bar");
    this.panel = part(".face");
    this.status = part(".spoken");
    this.painter = new PicturePainter(/** @type {HTMLCanvasElement} */ (part("canvas")));
    this.playback = new Playback((type, detail) => this.take(type, detail));
    this.controlBar = new ControlBar(this.bar, {
      toggle: () => this.toggle(),
      seek: (time) => (this.currentTime = time),
      mute: () => (this.muted = !this.muted),
      volume: (volume) => Object.assign(this, { volume, muted: false }),
      face: () => this.togglePanel(),
    });
    this.faceControls = new FaceControls(this.panel, this.stage, (edit) => this.playback.edit(edit));
    /** The source that has been loaded, or is loading. */
    this.currentSrc = "";
    this.planned = false;
    this.addEventListener("keydown", (event) => this.takeKey(event));
  }

  connectedCallback() {
    this.planLoad();
    this.describe();
    this.update();
  }

  disconnectedCallback() {
    queueMicrotask(() => {
      if (this.isConnected) return;  // it was only moved
      this.playback.stop();
      this.currentSrc = "";
    });
  }

  /** @param {string} name @param {string | null} before @param {string | null} value */
  attributeChangedCallback(name, before, value) {
    if (name === "src" && value !== before) this.planLoad(true);
    if (name === "loop") this.playback.loop = value !== null;
    if (name === "muted") this.playback.muted = value !== null;
    if (name === "muted") this.playback.changeVolume();
    if (name === "controls" || name === "label") this.describe();
    this.update();
  }

  /**
   * Loads once the script that sets attributes is done.
   * @param {boolean} [again]
   */
  planLoad(again = false) {
    if (again) this.currentSrc = "";
    if (this.planned) return;
    this.planned = true;
    queueMicrotask(() => {
      this.planned = false;
      if (!this.isConnected || this.currentSrc) return;
      if (this.preload !== "none" || this.startsItself) this.load();
      else this.playback.stop();
    });
  }

  /** Loads the stream from its beginning. */
  load() {
    this.say("");
    if (!this.src) return this.playback.stop();
    this.currentSrc = new URL(this.src, document.baseURI).href;
    this.playback.load(this.currentSrc);
    this.update();
  }

  // ---- as HTMLMediaElement

  /** Rejects where the browser allows no sound before a visitor's action, and where nothing can be played. */
  async play() {
    if (!this.currentSrc || this.error?.fatal) this.load();
    if (!this.currentSrc) throw new DOMException("there is no src", "NotSupportedError");
    if (!(await this.playback.play())) throw new DOMException("a click is needed before sound", "NotAllowedError");
  }

  pause() {
    this.playback.pause();
  }

  get paused() {
    return !this.playback.playing;
  }

  get ended() {
    return this.playback.ended;
  }

  get seeking() {
    return this.playback.seeking;
  }

  get currentTime() {
    return this.playback.currentTime;
  }

  set currentTime(time) {
    this.playback.seek(Number(time) || 0);
  }

  get duration() {
    return this.playback.duration;
  }

  get error() {
    return this.playback.error;
  }

  get volume() {
    return this.playback.volume;
  }

  set volume(volume) {
    this.playback.volume = Math.max(0, Math.min(1, Number(volume) || 0));
    this.playback.changeVolume();
    this.tell("volumechange");
  }

  get muted() {
    return this.playback.muted;
  }

  set muted(muted) {
    this.playback.muted = Boolean(muted);
    this.playback.changeVolume();
    this.tell("volumechange");
  }

  get videoWidth() {
    return this.playback.shown?.format.width ?? 0;
  }

  get videoHeight() {
    return this.playback.shown?.format.height ?? 0;
  }

  get src() {
    return this.getAttribute("src") ?? "";
  }

  set src(src) {
    this.setAttribute("src", src);
  }

  get preload() {
    return this.getAttribute("preload") === "none" ? "none" : "auto";
  }

  set preload(preload) {
    this.setAttribute("preload", preload);
  }

  get autoplay() {
    return this.hasAttribute("autoplay");
  }

  set autoplay(autoplay) {
    this.toggleAttribute("autoplay", autoplay);
  }

  get loop() {
    return this.hasAttribute("loop");
  }

  set loop(loop) {
    this.toggleAttribute("loop", loop);
  }

  get controls() {
    return this.hasAttribute("controls");
  }

  set controls(controls) {
    this.toggleAttribute("controls", controls);
  }

  // ---- of its own

  /** Describes the picture for visitors who cannot see it. */
  get label() {
    return this.getAttribute("label") ?? "Video of a person talking";
  }

  set label(label) {
    this.setAttribute("label", label);
  }

  /**
   * Changes to the motion of the stream; may be set in part.
   * @returns {Required<FaceEdit>}
   */
  get faceEdit() {
    return { ...this.faceControls.edit };
  }

  set faceEdit(/** @type {FaceEdit} */ edit) {
    this.faceControls.set(edit);
  }

  /** The face in the picture shown. */
  get face() {
    return this.playback.shown?.face ?? null;
  }

  /** Seconds of the stream that have arrived. */
  get arrivedTime() {
    return this.playback.arrival.time;
  }

  /** Average kbit/s of the part that has arrived. */
  get rate() {
    const { bytes, soundBytes, time } = this.playback.arrival;
    const rateOf = (/** @type {number} */ part) => (time > 0 ? (part * 8) / 1000 / time : 0);
    return { picture: rateOf(bytes - soundBytes), sound: rateOf(soundBytes) };
  }

  // ---- what happens

  /** Whether it plays unasked: not for visitors who prefer reduced motion. */
  get startsItself() {
    return this.autoplay && !matchMedia("(prefers-reduced-motion: reduce)").matches;
  }

  /** @param {string} type @param {any} detail */
  take(type, detail) {
    if (type === "picture") return this.takePicture(detail);
    if (type === "preview") this.paint(detail);
    if (type === "error") this.say(detail.message);
    if (type in SPOKEN) this.status.textContent = SPOKEN[type];
    if (type === "loadeddata") this.describe();
    this.tell(type, detail);
    if (type === "loadeddata" && this.startsItself) this.play().catch(() => {});
  }

  /** @param {import("./types").PaintedPicture} picture */
  paint(picture) {
    const { width, height, pixelAspect } = picture.format;
    this.stage.style.setProperty("--fbs-ratio", `${width * pixelAspect} / ${height}`);
    this.painter.paint(picture);
  }

  /** @param {ShownPicture} picture */
  takePicture(picture) {
    this.paint(picture);
    this.tell("face", { time: picture.time, face: picture.face });
  }

  /** @param {string} type @param {any} [detail] */
  tell(type, detail) {
    if (type !== "face") this.update();
    this.dispatchEvent(new CustomEvent(type, { detail }));
  }

  /** @param {string} text */
  say(text) {
    this.message.textContent = text && text[0].toUpperCase() + text.slice(1);
    this.message.classList.toggle("alone", !this.playback.shown);
    if (text) this.status.textContent = text;
  }

  /** Names and roles. */
  describe() {
    const { controls, label } = this, turnable = controls && (this.face !== null || !this.playback.shown);
    this.frame.setAttribute("aria-label", label);
    this.stage.classList.toggle("turnable", turnable);
    this.stage.setAttribute("role", controls ? "application" : "img");
    this.stage.setAttribute("aria-label", turnable ? `${label}: arrow keys turn the head` : label);
    if (controls) this.stage.tabIndex = 0;
    else this.stage.removeAttribute("tabindex");
    this.bar.hidden = !controls;
    this.controlBar.face.hidden = !turnable;
    if (!turnable) this.togglePanel(false);
  }

  update() {
    const { paused, currentTime, duration, muted, volume, rate, playback } = this;
    this.controlBar.update({
      paused, time: currentTime, duration, arrived: playback.arrival.time, hasSound: playback.arrival.soundRate > 0, muted,
      volume, rate,
    });
  }

  toggle() {
    if (this.paused) this.play().catch((fault) => this.error ?? this.say(fault.message));
    else this.pause();
  }

  togglePanel(open = this.panel.hidden) {
    this.panel.hidden = !open;
    this.controlBar.face.setAttribute("aria-expanded", String(open));
  }

  /** @param {KeyboardEvent} event */
  takeKey(event) {
    if (!this.controls || event.defaultPrevented || event.ctrlKey || event.altKey || event.metaKey) return;
    const target = /** @type {HTMLElement} */ (event.composedPath()[0]);
    const inner = target.localName;
    if (inner === "button" && (event.key === " " || event.key === "Enter")) return;
    const moves = /^(Arrow|Home|End|Page)/.test(event.key) && !event.shiftKey;
    if (inner === "input" && target !== this.controlBar.time && moves) return;
    const taken = target === this.stage || event.shiftKey ? this.faceControls.takeKey(event.key) : false;
    if (taken || this.takePlayerKey(event.key)) event.preventDefault();
  }

  /** @param {string} key */
  takePlayerKey(key) {
    if (key === " " || key === "k") this.toggle();
    else if (key === "Home") this.currentTime = 0;
    else if (key === "End") this.currentTime = this.duration;
    else if (key === "ArrowLeft") this.currentTime -= SEEK_SECONDS;
    else if (key === "ArrowRight") this.currentTime += SEEK_SECONDS;
    else if (key === "+" || key === "=") this.volume += VOLUME_STEP;
    else if (key === "-") this.volume -= VOLUME_STEP;
    else if (key === "m") this.muted = !this.muted;
    else if (key === "0") this.faceControls.reset();
    else return false;
    return true;
  }
}
