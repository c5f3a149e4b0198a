// Compiled, not run: the types of the package say what its code does, and a page in TypeScript can use them.
import { FbsPlayer, loadModule, type FbsDecoder } from "../src/index";
import { FbsDecoder as RealDecoder } from "../src/fbs_module.js";
import { FbsPlayer as RealPlayer } from "../src/player_element.js";

type Members<T> = Pick<T, keyof T>;
declare const realPlayer: RealPlayer, realDecoder: RealDecoder;
export const player: Omit<Members<FbsPlayer>, "addEventListener"> = realPlayer;
export const decoder: Members<FbsDecoder> = realDecoder;

export async function page() {
  const element = document.createElement("fbs-player");
  element.addEventListener("face", ({ detail }) => detail.face?.blendshapes.jawOpen.toFixed(2));
  element.addEventListener("error", ({ detail }) => detail.fatal);
  element.faceEdit = { yaw: 5 };
  const yaw: number = element.faceEdit.yaw;
  // @ts-expect-error: there is no such part of a face
  element.faceEdit = { nose: 1 };
  const picture = (await loadModule()).open().draw();
  return yaw + picture.planes.length;
}
