/** The visitor's hands on the face: sliders, drags on the picture, arrow keys. */

/**
 * @typedef {import("./types").FaceEdit} FaceEdit
 * @typedef {keyof FaceEdit} Part
 */

/** @type {{ part: Part, name: string, low: number, high: number, step: number, low_word: string, high_word: string }[]} */
const SLIDERS = [
  { part: "yaw", name: "Turn", low: -18, high: 18, step: 1, low_word: "right", high_word: "left" },
  { part: "pitch", name: "Nod", low: -12, high: 12, step: 1, low_word: "up", high_word: "down" },
  { part: "roll", name: "Tilt", low: -15, high: 15, step: 1, low_word: "left", high_word: "right" },
  { part: "brows", name: "Brows", low: -1, high: 1, step: 0.05, low_word: "lowered", high_word: "raised" },
  { part: "mouth", name: "Mouth", low: -1, high: 1, step: 0.05, low_word: "shut", high_word: "opened" },
  { part: "smile", name: "Smile", low: -1, high: 1, step: 0.05, low_word: "less", high_word: "more" },
  { part: "lids", name: "Eyes", low: -0.25, high: 1, step: 0.05, low_word: "opened", high_word: "shut" },
];
/** Degrees of an arrow key. */
const KEY_TURN = 3;
/** Degrees that a drag over the whole picture turns. */
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
    for (const { part, name, low, high, step } of SLIDERS) {
      const label = document.createElement("label");
      const input = document.createElement("input");
      // The picture's left is where the slider's left is.
      const mirrored = part === "yaw";
      Object.assign(input, { type: "range", min: String(low), max: String(high), step: String(step), value: "0" });
      if (mirrored) input.style.direction = "rtl";
      input.addEventListener("input", () => this.set({ [part]: Number(input.value) }));
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
    for (const { part, low, high } of SLIDERS) {
      const value = some[part];
      if (value !== undefined) this.edit[part] = Math.max(low, Math.min(high, value));
    }
    this.inputs.forEach((input, part) => (input.value = String(this.edit[part])));
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
    for (const { part, low, high, low_word, high_word } of SLIDERS) {
      const value = this.edit[part];
      const amount = high > 1 ? `${Math.round(Math.abs(value))} degrees` : `${Math.round((100 * value) / (value < 0 ? low : high))} %`;
      this.inputs.get(part)?.setAttribute("aria-valuetext",
        value === 0 ? "as in the video" : `${amount} ${value < 0 ? low_word : high_word}`);
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
