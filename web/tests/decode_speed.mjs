// decode_speed.mjs PACKAGE STREAM: for each module the pictures it decodes and draws in a second of the processor's time,
// which other programs on the machine do not change much.
import { readFile } from "node:fs/promises";
import { pathToFileURL } from "node:url";
import path from "node:path";

const [folder, file] = process.argv.slice(2);
const { loadModule } = await import(pathToFileURL(path.resolve(folder, "src/fbs_module.js")));
const stream = await readFile(file);

/** Pictures a second. */
function speed(module) {
  const decoder = module.open();
  decoder.feed(stream);
  decoder.finish();
  let pictures = 0, spare;
  const begin = process.cpuUsage();
  for (; decoder.next() === "picture"; ++pictures) spare = decoder.draw(spare).planes.buffer;
  const { user, system } = process.cpuUsage(begin);
  decoder.close();
  return (1e6 * pictures) / (user + system);
}

for (const name of ["fbs-simd.wasm", "fbs.wasm"]) {
  const module = await loadModule(await WebAssembly.compile(await readFile(path.join(folder, "src", name))));
  speed(module);  // compiles what is used often
  console.log(name, Math.max(speed(module), speed(module)).toFixed(1));
}
