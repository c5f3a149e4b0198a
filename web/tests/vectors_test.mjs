// vectors_test.mjs PACKAGE VECTORS: decodes every test vector by both modules of the package and compares with vectors.txt;
// and the sound of two, by the modules that decode it.
import { createHash } from "node:crypto";
import { existsSync } from "node:fs";
import { readFile } from "node:fs/promises";
import { pathToFileURL } from "node:url";
import path from "node:path";

const [folder, vectors] = process.argv.slice(2);
if (!existsSync(folder)) process.exit(77);  // the build has been skipped
const { loadModule, FbsError } = await import(pathToFileURL(path.resolve(folder, "src/fbs_module.js")));

const CODES = {
  kNotFbs: "not-fbs", kInvalidStream: "damaged", kTruncated: "truncated", kUnsupported: "unsupported",
  kTooLarge: "too-large",
};

/** The first error, the number of pictures and their MD5, as a line of vectors.txt has them. */
function digest(module, stream, pieces) {
  const decoder = module.open();
  for (let k = 0; k < stream.length; k += pieces) decoder.feed(stream.subarray(k, k + pieces));
  decoder.finish();
  const md5 = createHash("md5");
  let error = "-", pictures = 0;
  for (;;) {
    try {
      if (decoder.next() === "end") break;
    } catch (fault) {
      if (!(fault instanceof FbsError)) throw fault;
      if (error === "-") error = fault.code;
      continue;
    }
    md5.update(decoder.draw().planes);
    ++pictures;
  }
  decoder.close();
  return `${error} ${pictures} ${md5.digest("hex")}`;
}

const table = (await readFile(path.join(vectors, "vectors.txt"), "utf8"))
  .split("\n").filter((line) => line && !line.startsWith("#")).map((line) => line.split(" "));
let wrong = 0;
for (const name of ["fbs-simd.wasm", "fbs.wasm"]) {
  const module = await loadModule(await WebAssembly.compile(await readFile(path.join(folder, "src", name))));
  for (const [file, error, pictures, md5] of table) {
    const expected = `${CODES[error] ?? error} ${pictures} ${md5}`;
    const got = digest(module, await readFile(path.join(vectors, file)), 1000);
    if (got === expected) continue;
    ++wrong;
    console.log(`${name}: ${file}: expected ${expected}, got ${got}`);
  }
}
const compiled = async (name) => WebAssembly.compile(await readFile(path.join(folder, "src", name)));
for (const [codec, rate] of [["opus", 48000], ["codec2", 8000]]) {
  const module = await loadModule(await compiled("fbs.wasm")), decoder = module.open();
  decoder.feed(await readFile(path.join(vectors, `sound_${codec}.fbs`)));
  decoder.finish();
  const before = decoder.soundRate;
  await module.loadSound(codec, await compiled(`${codec}.wasm`));
  const sound = decoder.sound(1);
  if (before === 0 && decoder.soundRate === rate && sound?.sampleRate === rate && sound.samples.some((x) => x > 1000)) continue;
  ++wrong;
  console.log(`${codec}: rates ${before} and ${decoder.soundRate}, samples ${sound?.samples.length}`);
}
console.log(`${table.length} vectors, ${wrong} wrong`);
process.exit(table.length === 0 || wrong > 0 ? 1 : 0);
