/** Plays sound by Web Audio, and gives the pictures' clock: the time of the sound heard. */

/** Seconds from start() to the first sample, for the buffers to be ready. */
const LEAD = 0.05;
/** How long a context may take to start. Where the visitor must allow sound first, it never does. */
const PATIENCE_MS = 400;

export class SoundOutput {
  /**
   * @param {number} sampleRate
   * @param {BaseAudioContext} [context]  default: a new one of the sound's own rate, so that pieces meet without a seam
   */
  constructor(sampleRate, context = new AudioContext({ sampleRate })) {
    this.context = context;
    this.gain = new GainNode(context);
    this.gain.connect(context.destination);
    this.running = false;
    this.position = 0;
    /** Time of the context at `position`. */
    this.begun = 0;
    /** @type {{ time: number, buffer: AudioBuffer, source: AudioBufferSourceNode | null }[]} */
    this.pieces = [];
  }

  /** @param {number} volume  0..1 */
  set volume(volume) {
    this.gain.gain.value = volume;
  }

  /**
   * Waits until the context plays.
   * @returns {Promise<boolean>}  false: the browser does not let it
   */
  async allowed() {
    const context = /** @type {AudioContext} */ (this.context);
    const patience = new Promise((resolve) => setTimeout(resolve, PATIENCE_MS));
    await Promise.race([context.resume().catch(() => {}), patience]);
    return /** @type {string} */ (context.state) === "running";
  }

  /** Seconds of the stream up to which there is sound. */
  get end() {
    const last = this.pieces[this.pieces.length - 1];
    return last ? last.time + last.buffer.duration : -Infinity;
  }

  /** @param {import("./types").Sound} sound  follows the one before */
  add({ time, sampleRate, channels, samples }) {
    const count = samples.length / channels;
    if (count === 0) return;
    const buffer = new AudioBuffer({ numberOfChannels: channels, length: count, sampleRate });
    for (let c = 0; c < channels; ++c) {
      const plane = buffer.getChannelData(c);
      for (let k = 0; k < count; ++k) plane[k] = samples[k * channels + c] / 32768;
    }
    const piece = { time, buffer, source: null };
    this.pieces.push(piece);
    if (this.running) this.schedule(piece);
  }

  /** @param {number} position  seconds of the stream */
  start(position) {
    const { sampleRate, currentTime } = this.context;
    this.position = position;
    this.begun = Math.ceil((currentTime + LEAD) * sampleRate) / sampleRate;
    this.running = true;
    this.pieces = this.pieces.filter(({ time, buffer }) => time + buffer.duration > position);
    for (const piece of this.pieces) this.schedule(piece);
  }

  stop() {
    this.position = this.time();
    this.running = false;
    for (const piece of this.pieces) {
      piece.source?.stop();
      piece.source?.disconnect();
      piece.source = null;
    }
  }

  /** Uses no power until allowed() is called. */
  rest() {
    /** @type {AudioContext} */ (this.context).suspend();
  }

  /** Drops all sound: what is added next may be from anywhere. */
  clear() {
    this.stop();
    this.pieces = [];
  }

  close() {
    this.clear();
    if (this.context instanceof AudioContext) this.context.close();
  }

  /** Time of the sound heard, seconds of the stream. */
  time() {
    if (!this.running) return this.position;
    return this.position + Math.max(0, this.heard() - this.begun);
  }

  /** Time of the context that is leaving the loudspeaker now. */
  heard() {
    const context = /** @type {AudioContext} */ (this.context);
    const stamp = context.getOutputTimestamp?.();
    if (stamp?.contextTime && stamp.performanceTime)
      return stamp.contextTime + (performance.now() - stamp.performanceTime) / 1000;
    return context.currentTime - (context.outputLatency || context.baseLatency || 0);
  }

  /** @param {{ time: number, buffer: AudioBuffer, source: AudioBufferSourceNode | null }} piece */
  schedule(piece) {
    const { sampleRate, currentTime } = this.context;
    const late = this.begun + piece.time - this.position;
    // Aligned to samples: rounding of seconds must not leave a seam between pieces.
    const when = Math.max(Math.round(late * sampleRate) / sampleRate, this.begun, currentTime);
    const offset = Math.max(0, when - late);
    if (offset >= piece.buffer.duration) return;
    const source = new AudioBufferSourceNode(this.context, { buffer: piece.buffer });
    source.connect(this.gain);
    source.onended = () => this.ended(source);
    source.start(when, offset < 0.5 / sampleRate ? 0 : offset);
    piece.source = source;
  }

  /** @param {AudioBufferSourceNode} source */
  ended(source) {
    // Kept until the next one has begun, for end().
    const place = this.pieces.findIndex((piece) => piece.source === source);
    if (place >= 0 && place < this.pieces.length - 1) this.pieces.splice(0, place + 1);
  }
}
