/** One stream in the worker: reads it, and answers requests for its pictures when they can be decoded. */
import { FbsError } from "./fbs_module.js";
import { Preview } from "./preview.js";
import { openStream, readStream } from "./stream_source.js";

/**
 * @typedef {import("./types").Answer} Answer
 * @typedef {import("./types").FaceEdit} FaceEdit
 * @typedef {import("./fbs_module.js").FbsDecoder} FbsDecoder
 * @typedef {import("./fbs_module.js").FbsModule} FbsModule
 * @typedef {(answer: Answer, transfer?: Transferable[]) => void} Send
 */

/** @param {Error} fault  in loading a module */
const codeOf = (fault) => (fault instanceof FbsError ? fault.code : "network");

export class DecodingSession {
  /**
   * @param {number} generation  of the answers
   * @param {FaceEdit} edit
   * @param {Send} send
   */
  constructor(generation, edit, send) {
    this.generation = generation;
    this.editing = edit;
    this.send = send;
    /**
     * Null until the module has been loaded.
     * @type {FbsDecoder | null}
     */
    this.decoder = null;
    this.abort = new AbortController();
    this.complete = false;
    /** The connection has broken. */
    this.broken = false;
    this.failed = false;
    /** Whether next() has announced a picture since the beginning or the last seek. */
    this.hasPicture = false;
    /** @type {FbsError | null} */
    this.lastFault = null;
    /**
     * A request; `seek`: the decoder has to go to the time first.
     * @type {{ skipTo: number, isSeek: boolean, seek: boolean, buffer?: ArrayBuffer } | null}
     */
    this.wanted = null;
    this.toldWaiting = false;
    /** @type {number | null} */
    this.soundWanted = null;
  }

  /**
   * Reads the stream to its end. First comes what finds a preview, then the stream, then the module: on a slow link all would
   * wait for each other.
   * @param {string} url
   * @param {boolean} hasPreview  whether one is worth it
   * @param {() => Promise<FbsModule>} needModule
   */
  async read(url, hasPreview, needModule) {
    const { signal } = this.abort;
    const preview = hasPreview ? await Preview.load().catch(() => null) : null;
    const stream = openStream(url, signal);
    stream.catch(() => {});  // is seen below
    if (preview) await this.show(preview, stream).catch(() => {});  // it is not needed
    const ready = await needModule();
    if (signal.aborted) return;
    const decoder = ready.open();
    this.decoder = decoder;
    decoder.edit(this.editing);
    ready.codecs.awaitedRate = 0;
    ready.codecs.changed = (fault) => this.takeCodec(fault);
    try {
      await readStream(await stream, (bytes) => {
        if (signal.aborted) return;
        decoder.feed(bytes);
        this.tellArrival(decoder);
        this.answer();
      });
    } catch (fault) {
      if (!signal.aborted && !(fault instanceof FbsError)) throw fault;
      this.broken = true;
      if (!signal.aborted) this.report(/** @type {FbsError} */ (fault), decoder.arrivedBytes.all === 0);
    }
    if (!signal.aborted) {
      this.complete = true;
      decoder.finish();
      this.tellArrival(decoder);
      this.answer();
    }
  }

  /** @param {Preview} preview  @param {Promise<Response>} stream */
  async show(preview, stream) {
    const picture = await preview.picture((await stream).clone());
    this.send({ type: "preview", generation: this.generation, picture }, [picture.planes.buffer]);
  }

  close() {
    this.abort.abort();
    this.decoder?.close();
    this.decoder = null;
  }

  /**
   * The decoder of the sound has come, or not.
   * @param {Error} [fault]
   */
  takeCodec(fault) {
    if (!this.decoder) return;
    if (fault) this.report(new FbsError(codeOf(fault), `the sound's decoder could not be loaded: ${fault.message}`), false);
    else this.tellArrival(this.decoder);
    if (this.soundWanted !== null) this.sound(this.soundWanted);
  }

  /** @param {FbsDecoder} decoder */
  tellArrival(decoder) {
    const { generation, complete } = this;
    const { all, sound } = decoder.arrivedBytes;
    const { arrivedTime: time } = decoder;
    const soundRate = decoder.soundRate || decoder.module.codecs.awaitedRate;
    const arrival = { bytes: all, soundBytes: sound, time, soundRate, complete };
    this.send({ type: "arrival", generation, arrival });
  }

  /** @param {FbsError} fault @param {boolean} fatal */
  report({ code, message }, fatal) {
    this.failed ||= fatal;
    this.send({ type: "error", generation: this.generation, error: { code, message, fatal } });
    if (fatal) this.abort.abort();
  }

  /**
   * Asks for the next picture that ends after a time.
   * @param {number} skipTo
   * @param {ArrayBuffer} [buffer]
   */
  next(skipTo, buffer) {
    this.wanted = { skipTo, isSeek: false, seek: false, buffer };
    this.toldWaiting = false;
    this.answer();
  }

  /** @param {number} generation @param {number} time */
  seek(generation, time) {
    this.generation = generation;
    this.soundWanted = null;
    this.wanted = { skipTo: time, isSeek: true, seek: true };
    this.toldWaiting = false;
    this.answer();
  }

  /**
   * Sound that has no decoder yet is waited for: it begins with its pictures.
   * @param {number} to
   */
  sound(to) {
    const awaited = this.decoder?.module.codecs.awaitedRate;
    this.soundWanted = awaited ? to : null;
    if (awaited) return;
    const sound = this.wanted?.seek ? null : this.decoder?.sound(to) ?? null;
    this.send({ type: "sound", generation: this.generation, sound }, sound ? [sound.samples.buffer] : []);
  }

  /** @param {FaceEdit} edit */
  edit(edit) {
    this.editing = edit;
    this.decoder?.edit(edit);
  }

  /** @param {ArrayBuffer} [buffer] */
  redraw(buffer) {
    if (this.decoder && this.hasPicture) this.draw(this.decoder, true, buffer);
  }

  answer() {
    const { decoder, wanted } = this;
    if (!decoder || !wanted || this.failed) return;
    if (wanted.seek && decoder.seek(wanted.skipTo)) this.hasPicture = wanted.seek = false;
    const found = wanted.seek ? this.withoutScene() : this.advance(decoder, wanted.skipTo);
    if (found === "need-data") {
      if (!this.toldWaiting) this.send({ type: "waiting", generation: this.generation });
      this.toldWaiting = true;
      return;
    }
    this.wanted = null;
    // Behind the end there is the last picture.
    if (found === "picture" || (wanted.isSeek && this.hasPicture)) this.draw(decoder, false, wanted.buffer);
    if (found === "end") this.end();
  }

  withoutScene() {
    return this.complete ? "end" : "need-data";
  }

  /**
   * @param {FbsDecoder} decoder
   * @param {number} skipTo  pictures that end before it are not looked at
   */
  advance(decoder, skipTo) {
    for (;;) {
      try {
        const found = decoder.next();
        if (found !== "picture") return found;
        this.hasPicture = true;
        const { time, duration } = decoder.announced();
        if (time + duration > skipTo) return found;
      } catch (fault) {
        if (!(fault instanceof FbsError)) throw fault;
        // What has been cut off on the way has been reported.
        if (fault.code === "truncated" && this.broken) continue;
        this.lastFault = fault;
        const fatal = fault.code === "not-fbs";
        this.report(fault, fatal);
        if (fatal) return "need-data";
      }
    }
  }

  /**
   * @param {FbsDecoder} decoder
   * @param {boolean} redraw
   * @param {ArrayBuffer} [buffer]
   */
  draw(decoder, redraw, buffer) {
    const { generation } = this;
    const drawn = decoder.draw(buffer);
    const picture = { ...drawn, ...decoder.announced(), format: decoder.format(), face: decoder.face() };
    this.send({ type: "picture", generation, picture, redraw }, [drawn.planes.buffer]);
  }

  end() {
    if (!this.hasPicture) {
      const code = this.lastFault?.code ?? "damaged";
      return this.report(new FbsError(code, this.lastFault?.message ?? "the stream has no picture"), true);
    }
    this.send({ type: "end", generation: this.generation });
  }
}
