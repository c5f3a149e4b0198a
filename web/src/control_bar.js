/** The bar below the picture: play, time, sound, rate, and the button of the face's panel. */

const ICONS = {
  play: "M6 4l11 6-11 6z",
  pause: "M5 4h4v12H5zM11 4h4v12h-4z",
  loud: "M3 8v4h3l4 4V4L6 8zM12.5 6.5a5 5 0 0 1 0 7M14.5 4a8 8 0 0 1 0 12",
  mute: "M3 8v4h3l4 4V4L6 8zM13 8l4 4M17 8l-4 4",
};

/**
 * @typedef {object} BarState
 * @property {boolean} paused
 * @property {number} time
 * @property {number} duration
 * @property {number} arrived      seconds
 * @property {boolean} hasSound
 * @property {boolean} muted
 * @property {number} volume
 * @property {{ picture: number, sound: number }} rate  kbit/s
 */

export class ControlBar {
  /**
   * @param {HTMLElement} bar  is filled
   * @param {{ toggle(): void, seek(time: number): void, mute(): void, volume(volume: number): void, face(): void }} deeds
   */
  constructor(bar, deeds) {
    this.play = iconButton(deeds.toggle);
    this.time = range(0, 0.01, "Time", (value) => deeds.seek(value));
    this.time.className = "time";
    this.clock = document.createElement("span");
    this.clock.className = "clock";
    this.mute = iconButton(deeds.mute);
    this.volume = range(1, 0.05, "Volume", (value) => deeds.volume(value));
    this.sound = document.createElement("span");
    this.sound.className = "sound";
    this.sound.append(this.mute, this.volume);
    this.rate = document.createElement("span");
    this.rate.className = "rate";
    this.face = document.createElement("button");
    Object.assign(this.face, { type: "button", className: "framed", textContent: "Face" });
    this.face.setAttribute("aria-expanded", "false");
    this.face.addEventListener("click", deeds.face);
    const right = document.createElement("span");
    right.className = "right";
    right.append(this.sound, this.rate, this.face);
    bar.append(this.play, this.time, this.clock, right);
  }

  /** @param {BarState} state */
  update({ paused, time, duration, arrived, hasSound, muted, volume, rate }) {
    icon(this.play, paused ? "play" : "pause", paused ? "Play" : "Pause");
    const end = Number.isFinite(duration) ? duration : arrived;
    this.time.max = String(Math.max(end, 0.1));
    this.time.value = String(time);
    const total = Number.isFinite(duration) ? clockText(duration) : "";
    this.clock.textContent = total ? `${clockText(time)} / ${total}` : clockText(time);
    this.time.setAttribute("aria-valuetext", total ? `${clockText(time)} of ${total}` : clockText(time));
    this.sound.hidden = !hasSound;
    icon(this.mute, muted || volume === 0 ? "mute" : "loud", muted ? "Unmute" : "Mute");
    this.volume.value = String(muted ? 0 : volume);
    this.volume.setAttribute("aria-valuetext", `${Math.round(100 * (muted ? 0 : volume))} %`);
    this.rate.textContent = rateText(rate, hasSound);
    this.rate.title = hasSound ? "Picture and sound, on average" : "On average";
  }
}

/** @param {{ picture: number, sound: number }} rate @param {boolean} hasSound */
function rateText({ picture, sound }, hasSound) {
  if (!(picture > 0)) return "";
  return hasSound ? `${picture.toFixed(1)} + ${sound.toFixed(1)} kbit/s` : `${picture.toFixed(1)} kbit/s`;
}

/** @param {number} seconds */
function clockText(seconds) {
  const all = Math.floor(seconds + 0.05), hours = Math.floor(all / 3600);
  const two = (/** @type {number} */ x) => String(x).padStart(2, "0");
  const minutes = Math.floor(all / 60) % 60;
  return hours ? `${hours}:${two(minutes)}:${two(all % 60)}` : `${minutes}:${two(all % 60)}`;
}

/** @param {() => void} act */
function iconButton(act) {
  const out = document.createElement("button");
  out.type = "button";
  out.addEventListener("click", act);
  return out;
}

/** @param {HTMLButtonElement} button @param {keyof typeof ICONS} name @param {string} label */
function icon(button, name, label) {
  if (button.getAttribute("aria-label") === label) return;
  button.setAttribute("aria-label", label);
  button.title = label;
  const lines = name === "loud" || name === "mute";
  button.innerHTML = `<svg viewBox="0 0 20 20" aria-hidden="true"><path d="${ICONS[name]}"${
    lines ? ' stroke="currentColor" stroke-width="1.5" fill="none" stroke-linejoin="round"' : ""}/></svg>`;
}

/** @param {number} max @param {number} step @param {string} label @param {(value: number) => void} change */
function range(max, step, label, change) {
  const out = document.createElement("input");
  Object.assign(out, { type: "range", min: "0", max: String(max), step: String(step), value: "0" });
  out.setAttribute("aria-label", label);
  out.addEventListener("input", () => change(Number(out.value)));
  return out;
}
