/** YCbCr to RGB: matrices for 8-bit samples in the stream's format. */

/** Weights of red and blue in luma, by the names of Format.matrix. An unspecified matrix counts as the older
 * one. */
const LUMA_WEIGHTS = {
  bt601: [0.299, 0.114],
  bt709: [0.2126, 0.0722],
};

/**
 * What of the samples makes red, green and blue, all 0..1: rgb = y * luma + cb * blue + cr * red + offset.
 * @param {import("./types").Format} format
 * @returns {{ luma: number, red: number[], blue: number[], offset: number[] }}  red, blue and offset have three numbers
 */
export function colourMatrix({ matrix, fullRange }) {
  const [kr, kb] = LUMA_WEIGHTS[matrix === "bt709" ? "bt709" : "bt601"], kg = 1 - kr - kb;
  const luma = fullRange ? 1 : 255 / 219, chroma = fullRange ? 1 : 255 / 224;
  const red = [2 * (1 - kr), (-2 * (1 - kr) * kr) / kg, 0].map((x) => x * chroma);
  const blue = [0, (-2 * (1 - kb) * kb) / kg, 2 * (1 - kb)].map((x) => x * chroma);
  const black = fullRange ? 0 : 16 / 255, middle = 128 / 255;
  const offset = red.map((x, k) => -black * luma - middle * (x + blue[k]));
  return { luma, red, blue, offset };
}
