/**
 * The decoders of sound: libopus and libcodec2, each a module of its own, fetched when a stream has sound for it. They share
 * no memory with the decoder of pictures: packets and samples are copied.
 */

/** @typedef {"opus" | "codec2"} Codec */

/** Hz of what they decode. */
const RATES = { opus: 48000, codec2: 8000 };
const OPUS_RESET_STATE = 4028;
/** The longest Opus packet and its samples: 0.12 s of two channels. */
const PACKET_BYTES = 61298, SAMPLE_BYTES = 4 * 5760;

/** What the modules import besides each other: there are no files. */
export const SYSTEM = {
  env: { emscripten_notify_memory_growth() {} },
  wasi_snapshot_preview1: { proc_exit: trap, fd_write: () => 8, fd_close: () => 8, fd_seek: () => 8 },
};

export function trap() {
  throw new WebAssembly.RuntimeError("the decoder has given up");
}

/** @param {Codec} codec */
export function codecUrl(codec) {
  return codec === "opus" ? new URL("./opus.wasm", import.meta.url) : new URL("./codec2.wasm", import.meta.url);
}

export class SoundCodecs {
  /** @param {(url: URL) => Promise<WebAssembly.Module>} compile */
  constructor(compile) {
    this.compile = compile;
    /**
     * Called when a codec that a stream needs has been loaded, or could not be.
     * @type {(fault?: Error) => void}
     */
    this.changed = () => {};
    /** Hz of the sound that waits for its codec; 0 when none does. */
    this.awaitedRate = 0;
    /** @type {Map<Codec, Promise<void>>} */
    this.loads = new Map();
    /** @type {Map<Codec, any>} */
    this.loaded = new Map();
    /** @type {Set<Codec>} */
    this.failed = new Set();
    /** Bytes of a sample of all channels, by decoder of Opus. */
    this.frameBytes = new Map();
    /**
     * That of the decoder of pictures, whose calls are answered.
     * @type {WebAssembly.Memory | null}
     */
    this.memory = null;
  }

  /**
   * @param {Codec} codec
   * @param {WebAssembly.Module} [module]  default: it is fetched
   */
  load(codec, module) {
    const load = !module && !this.failed.has(codec) && this.loads.get(codec) || this.instantiate(codec, module);
    this.failed.delete(codec);
    this.loads.set(codec, load);
    return load;
  }

  /** @param {Codec} codec  @param {WebAssembly.Module} [module] */
  async instantiate(codec, module) {
    const instance = await WebAssembly.instantiate(module ?? (await this.compile(codecUrl(codec))), SYSTEM);
    if (this.loaded.has(codec)) return;  // by another call, and decoders may be in it
    /** @type {any} */
    const functions = instance.exports;
    functions._initialize();
    this.loaded.set(codec, { ...functions, packet: functions.malloc(PACKET_BYTES), samples: functions.malloc(SAMPLE_BYTES) });
  }

  /** @param {Codec} codec  @returns {any}  null until it has been loaded */
  get(codec) {
    const loaded = this.loaded.get(codec);
    if (loaded || this.failed.has(codec)) return loaded;
    this.awaitedRate = RATES[codec];
    if (!this.loads.has(codec)) this.load(codec).then(() => this.end(codec), (fault) => this.end(codec, fault));
    return null;
  }

  /** @param {Codec} codec  @param {Error} [fault] */
  end(codec, fault) {
    this.awaitedRate = 0;
    if (fault) this.failed.add(codec);
    this.changed(fault);
  }

  /**
   * Copies a packet to a codec, and gives its address there.
   * @param {any} to
   * @param {number} address
   * @param {number} size
   */
  send(to, address, size) {
    const { buffer } = /** @type {WebAssembly.Memory} */ (this.memory);
    new Uint8Array(to.memory.buffer, to.packet, size).set(new Uint8Array(buffer, address, size));
    return to.packet;
  }

  /**
   * Copies samples from a codec.
   * @param {any} from
   * @param {number} address
   * @param {number} size  bytes
   */
  take(from, address, size) {
    const { buffer } = /** @type {WebAssembly.Memory} */ (this.memory);
    new Uint8Array(buffer, address, size).set(new Uint8Array(from.memory.buffer, from.samples, size));
  }

  /** The functions of libopus and libcodec2 that the decoder calls. A decoder cannot be created before its codec is there. */
  functions() {
    return {
      /** @param {number} rate @param {number} channels */
      opus_decoder_create: (rate, channels) => {
        const decoder = this.get("opus")?.opus_decoder_create(rate, channels, 0) ?? 0;
        this.frameBytes.set(decoder, 2 * channels);
        return decoder;
      },
      /** @param {number} decoder */
      opus_decoder_destroy: (decoder) => this.get("opus").opus_decoder_destroy(decoder),
      /** @param {number} decoder */
      opus_decoder_ctl: (decoder) => this.get("opus").opus_decoder_ctl(decoder, OPUS_RESET_STATE, 0),
      /** @param {number} packet @param {number} size @param {number} rate */
      opus_packet_get_nb_samples: (packet, size, rate) => {
        const opus = this.get("opus");
        return opus.opus_packet_get_nb_samples(this.send(opus, packet, size), size, rate);
      },
      /** @param {number[]} arguments_ */
      opus_decode: (...[decoder, packet, size, samples, count, fec]) => {
        const opus = this.get("opus");
        const done = opus.opus_decode(decoder, packet && this.send(opus, packet, size), size, opus.samples, count, fec);
        if (done > 0) this.take(opus, samples, done * this.frameBytes.get(decoder));
        return done;
      },
      /** @param {number} mode */
      codec2_create: (mode) => this.get("codec2")?.codec2_create(mode) ?? 0,
      /** @param {number} decoder */
      codec2_destroy: (decoder) => this.get("codec2").codec2_destroy(decoder),
      /** @param {number} decoder @param {number} samples @param {number} frame */
      codec2_decode: (decoder, samples, frame) => {
        const codec2 = this.get("codec2");
        codec2.codec2_decode(decoder, codec2.samples, this.send(codec2, frame, codec2.codec2_bytes_per_frame(decoder)));
        this.take(codec2, samples, 2 * codec2.codec2_samples_per_frame(decoder));
      },
    };
  }
}
