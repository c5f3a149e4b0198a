/** The bytes of a stream from a URL, as they arrive. */
import { FbsError } from "./fbs_module.js";

/** @param {unknown} fault */
function lost(fault) {
  return new FbsError("network", `the stream could not be fetched: ${fault instanceof Error ? fault.message : fault}`);
}

/**
 * @param {string} url
 * @param {AbortSignal} signal
 * @throws {FbsError}  of the code "network" or "http"
 */
export async function openStream(url, signal) {
  const answer = await fetch(url, { signal }).catch((fault) => {
    throw lost(fault);
  });
  if (!answer.ok) throw new FbsError("http", `the server answers ${answer.status} ${answer.statusText}`.trim());
  return answer;
}

/**
 * @param {Response} answer
 * @param {(bytes: Uint8Array) => unknown} take  true: it takes no more
 * @throws {FbsError}  of the code "network", where the connection breaks
 */
export async function readStream(answer, take) {
  if (!answer.body) return;
  const reader = answer.body.getReader();
  for (;;) {
    const { done, value } = await reader.read().catch((fault) => {
      throw lost(fault);
    });
    if (done) return;
    if (take(value)) return reader.cancel();
  }
}
