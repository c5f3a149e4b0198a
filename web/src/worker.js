/** Decodes for one player, in parallel to the page. Its messages are in types.d.ts. */
import { DecodingSession } from "./decoding_session.js";
import { loadModule } from "./fbs_module.js";

/**
 * @typedef {import("./types").Request} Request
 * @typedef {import("./types").Answer} Answer
 * @typedef {import("./fbs_module.js").FbsModule} FbsModule
 */

/** @type {(module: FbsModule | Promise<FbsModule>) => void} */
let giveModule;
/** @type {Promise<FbsModule> | undefined} */
let module;
/** @type {DecodingSession | null} */
let session = null;
/** @type {import("./types").FaceEdit} */
let edit = {};

/** @param {Answer} answer @param {Transferable[]} [transfer] */
function send(answer, transfer = []) {
  /** @type {any} */ (self).postMessage(answer, transfer);
}

/** The module, for which the page is asked when it is needed. */
function needModule() {
  module ??= new Promise((resolve) => {
    giveModule = resolve;
    send({ type: "module" });
  });
  return module;
}

/** @param {Request} request */
async function take(request) {
  if (request.type === "module") return giveModule(loadModule(request.module));
  if (request.type === "load") {
    session?.close();
    session = new DecodingSession(request.generation, edit, send);
    return session.read(request.url, request.preview, needModule);
  }
  if (request.type === "edit") edit = request.edit;
  if (request.type === "edit") return session?.edit(edit);
  if (request.type === "seek") return session?.seek(request.generation, request.time);
  if (request.generation !== session?.generation) return;  // sent before it knew of a seek
  if (request.type === "next") session.next(request.skipTo, request.buffer);
  if (request.type === "sound") session.sound(request.to);
  if (request.type === "redraw") session.redraw(request.buffer);
}

self.onmessage = async ({ data }) => {
  try {
    await take(data);
  } catch (fault) {
    // Out of memory, or a bug: the module is unusable, and the player starts another worker for its next
    // stream.
    const message = `the decoder has failed: ${fault instanceof Error ? fault.message : fault}`;
    send({ type: "error", generation: session?.generation ?? 0, error: { code: "internal", message, fatal: true } });
  }
};
