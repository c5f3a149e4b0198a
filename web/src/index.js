/** Defines <fbs-player>, and exports what programs use with it. */
import { FbsPlayer } from "./player_element.js";

export { FbsPlayer };
export { prepareDecoder } from "./decoder_client.js";
export { FbsDecoder, FbsError, FbsModule, compileModule, loadModule, moduleUrl } from "./fbs_module.js";

if (!customElements.get("fbs-player")) customElements.define("fbs-player", FbsPlayer);
