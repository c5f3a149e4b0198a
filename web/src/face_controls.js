/** The visitor's control of the face: sliders, drags on the picture, arrow keys. */

/**
 * @typedef {import("./types").FaceEdit} FaceEdit
 * @typedef {keyof FaceEdit} Part
 */

/**
 * `words` name values below and above 0. `sign`: -1 where the slider's left stands for the part's positive values.
 * @type {{ part: Part, name: string, low: number, high: number, step: number, words: [string, string], sign: number }[]}
 */
const SLIDERS = [
  { part: "yaw", name: "Turn", low: -18, high: 18, step: 1, words: ["right", "left"], sign: -1 },
  { part: "pitch", name: "Nod", low: -12, high: 12, step: 1, words: ["up", "down"], sign: 1 },
  { part: "roll", name: "Tilt", low: -15, high: 15, step: 1, words: ["left", "right"], sign: 1 },
  { part: "brows", name: "Brows", low: -1, high: 1, step: 0.05, words: ["lowered", "raised"], sign: 1 },
  { part: "mouth", name: "Mouth", low: -1, high: 1, step: 0.05, words: ["shut", "opened"], sign: 1 },
  { part: "smile", name: "Smile", low: -1, high: 1, step: 0.05, words: ["less", "more"], sign: 1 },
  { part: "lids", name: "Eyes", low: -1, high: 1, step: 0.05, words: ["opened", "shut"], sign: 1 },
];
/** Degrees per press of an arrow key. */
const KEY_TURN = 3;
/** Degrees per drag over the whole picture. */
const DRAG_TURN = 60;
const BLINK_MS = 180;

export class FaceControls {
  /**
   * @param {HTMLElement} panel   is filled
   * @param {HTMLElement} stage   where the picture is
   * @param {(edit: Required<FaceEdit>) => void} change
   */
  constructor(panel, stage, change) {
    this.change = change;
    /** @type {Required<FaceEdit>} */
    this.edit = { pitch: 0, yaw: 0, roll: 0, brows: 0, mouth: 0, smile: 0, lids: 0 };
    /** @type {Map<Part, HTMLInputElement>} */
    this.inputs = new Map();
    panel.append(this.sliders(), this.deeds());
    this.followDrags(stage);
  }

  sliders() {
    const out = document.createElement("div");
    out.className = "sliders";
    for (const { part, name, low, high, step, sign } of SLIDERS) {
      const label = document.createElement("label");
      const input = document.createElement("input");
      Object.assign(input, { type: "range", min: String(low), max: String(high), step: String(step), value: "0" });
      input.addEventListener("input", () => this.set({ [part]: sign * Number(input.value) }));
      this.inputs.set(part, input);
      label.append(name, input);
      out.append(label);
    }
    this.speakValues();
    return out;
  }

  deeds() {
    const out = document.createElement("div");
    out.className = "deeds";
    const hint = document.createElement("p");
    hint.className = "hint";
    hint.textContent = "Drag the picture to turn the head, or use the arrow keys on it.";
    out.append(button("Blink", () => this.blink()), button("Reset", () => this.reset()), hint);
    return out;
  }

  /** @param {FaceEdit} some */
  set(some) {
    for (const { part, low, high, sign } of SLIDERS) {
      const value = some[part];
      if (value === undefined) continue;
      this.edit[part] = Math.max(low, Math.min(high, value));
      /** @type {HTMLInputElement} */ (this.inputs.get(part)).value = String(sign * this.edit[part]);
    }
    this.speakValues();
    this.change({ ...this.edit });
  }

  reset() {
    this.set({ pitch: 0, yaw: 0, roll: 0, brows: 0, mouth: 0, smile: 0, lids: 0 });
  }

  blink() {
    const { lids } = this.edit;
    this.set({ lids: 1 });
    setTimeout(() => this.set({ lids }), BLINK_MS);
  }

  speakValues() {
    for (const { part, low, high, words } of SLIDERS) {
      const value = this.edit[part], limit = value < 0 ? low : high;
      const amount = high > 1 ? `${Math.round(Math.abs(value))} degrees` : `${Math.round((100 * value) / limit)} %`;
      const text = value === 0 ? "as in the video" : `${amount} ${words[value < 0 ? 0 : 1]}`;
      this.inputs.get(part)?.setAttribute("aria-valuetext", text);
    }
  }

  /** @param {string} key  @returns {boolean}  whether it was one of the face's */
  takeKey(key) {
    const { yaw, pitch } = this.edit;
    if (key === "ArrowLeft") this.set({ yaw: yaw + KEY_TURN });
    else if (key === "ArrowRight") this.set({ yaw: yaw - KEY_TURN });
    else if (key === "ArrowUp") this.set({ pitch: pitch - KEY_TURN });
    else if (key === "ArrowDown") this.set({ pitch: pitch + KEY_TURN });
    else if (key === "0") this.reset();
    else return false;
    return true;
  }

  /** @param {HTMLElement} stage */
  followDrags(stage) {
    /** @type {{ x: number, y: number, yaw: number, pitch: number } | null} */
    let begin = null;
    stage.addEventListener("pointerdown", (event) => {
      if (event.button !== 0 || !stage.classList.contains("turnable")) return;
      begin = { x: event.clientX, y: event.clientY, yaw: this.edit.yaw, pitch: this.edit.pitch };
      stage.setPointerCapture(event.pointerId);
      stage.classList.add("turning");
    });
    stage.addEventListener("pointermove", (event) => {
      if (!begin) return;
      const turn = DRAG_TURN / stage.clientWidth;
      this.set({ yaw: begin.yaw - (event.clientX - begin.x) * turn, pitch: begin.pitch + (event.clientY - begin.y) * turn });
    });
    for (const end of ["pointerup", "pointercancel"])
      stage.addEventListener(end, () => {
        begin = null;
        stage.classList.remove("turning");
      });
  }
}

/** @param {string} text @param {() => void} act */
function button(text, act) {
  const out = document.createElement("button");
  out.type = "button";
  out.className = "framed";
  out.textContent = text;
  out.addEventListener("click", act);
  return out;
}
