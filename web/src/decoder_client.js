/** The page's end of the worker: starts it, and numbers the requests. */
import { compileModule, FbsError } from "./fbs_module.js";

/**
 * @typedef {import("./types").Request} Request
 * @typedef {import("./types").Answer} Answer
 */

/** @type {Promise<WebAssembly.Module> | undefined} */
let compiled;

/**
 * Fetches and compiles the decoder, once for all players of the page.
 * @returns {Promise<WebAssembly.Module>}
 */
export function prepareDecoder() {
  compiled ??= compileModule().catch((fault) => {
    compiled = undefined;  // try again
    throw fault;
  });
  return compiled;
}

/** @returns {Worker} */
function startWorker() {
  const here = import.meta.url;
  // Bundlers know a worker by this very expression.
  if (new URL(here).origin === location.origin) return new Worker(new URL("./worker.js", import.meta.url), { type: "module" });
  // A worker must come from the page's own origin: this one does, and imports the other.
  const text = new Blob([`import ${JSON.stringify(new URL("worker.js", here).href)};`], { type: "text/javascript" });
  return new Worker(URL.createObjectURL(text), { type: "module" });
}

export class DecoderClient {
  /** @param {(answer: Answer) => void} take  called with the answers to the last load or seek */
  constructor(take) {
    this.take = take;
    this.generation = 0;
    /** The generation of the last load: reports about the stream matter after a seek, too. */
    this.loaded = 0;
    /** @type {Worker | null} */
    this.worker = null;
    /** @type {import("./types").FaceEdit} */
    this.editing = {};
  }

  /** @param {string} url  absolute */
  load(url) {
    this.worker ??= this.start();
    this.loaded = ++this.generation;
    this.ask({ type: "load", generation: this.generation, url, preview: !compiled });
  }

  /** @param {number} time */
  seek(time) {
    this.ask({ type: "seek", generation: ++this.generation, time });
  }

  /** @param {number} skipTo  @param {ArrayBuffer} [buffer] */
  next(skipTo, buffer) {
    this.ask({ type: "next", generation: this.generation, skipTo, buffer }, buffer ? [buffer] : []);
  }

  /** @param {number} to */
  sound(to) {
    this.ask({ type: "sound", generation: this.generation, to });
  }

  /** @param {import("./types").FaceEdit} edit */
  edit(edit) {
    this.editing = edit;
    this.ask({ type: "edit", edit });
  }

  redraw() {
    this.ask({ type: "redraw", generation: this.generation });
  }

  stop() {
    this.worker?.terminate();
    this.worker = null;
    this.loaded = ++this.generation;
  }

  /** @param {Request} request @param {Transferable[]} [transfer] */
  ask(request, transfer = []) {
    this.worker?.postMessage(request, transfer);
  }

  start() {
    const worker = startWorker();
    worker.onmessage = ({ data }) => {
      if (data.type === "module") return this.giveModule(worker);
      const since = data.type === "arrival" || data.type === "error" ? this.loaded : this.generation;
      if (worker === this.worker && data.generation >= since) this.take(data);
    };
    worker.onerror = () => this.fail(new FbsError("network", "the decoder's worker could not be started"));
    worker.postMessage({ type: "edit", edit: this.editing });
    return worker;
  }

  /** @param {Worker} worker */
  giveModule(worker) {
    prepareDecoder().then(
      (module) => worker.postMessage({ type: "module", module }),
      (fault) => {
        const message = `the decoder could not be loaded: ${fault.message}`;
        if (worker === this.worker) this.fail(new FbsError(fault instanceof FbsError ? fault.code : "network", message));
      });
  }

  /** @param {FbsError} fault */
  fail({ code, message }) {
    const generation = this.generation;
    this.stop();
    this.take({ type: "error", generation, error: { code, message, fatal: true } });
  }
}
