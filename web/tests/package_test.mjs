// package_test.mjs PACKAGE: what `npm pack` puts into the archive, and that its entry points can be imported from there.
// Exit code 77 where there is no npm, or the build has been skipped.
import { execFileSync } from "node:child_process";
import { existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";

let cwd = path.resolve(process.argv[2]);
if (!existsSync(cwd)) process.exit(77);
const run = (command, ...rest) => execFileSync(command, rest, { encoding: "utf8", cwd, stdio: ["ignore", "pipe", "inherit"] });
let wrong = 0;

function check(right, text) {
  if (right) return;
  ++wrong;
  console.log(text);
}

try {
  execFileSync("npm", ["--version"]);
} catch {
  console.log("no npm: skipped");
  process.exit(77);
}

const user = mkdtempSync(path.join(tmpdir(), "fbs-player-"));
try {
  const [{ filename, files }] = JSON.parse(run("npm", "pack", "--json", "--offline", "--pack-destination", user));
  const names = files.map((file) => file.path);
  for (const name of ["package.json", "README.md", "LICENSE", "src/index.js", "src/index.d.ts", "src/types.d.ts", "src/fbs.wasm",
                      "src/fbs-simd.wasm", "src/preview.wasm", "src/opus.wasm", "src/codec2.wasm", "src/worker.js",
                      "src/service_worker.js", "LICENSE-THIRD-PARTY"])
    check(names.includes(name), `${name} is not in the package`);
  const others = names.filter((name) => !/^(package\.json|README\.md|LICENSE|LICENSE-THIRD-PARTY|src\/[\w-]+\.(js|d\.ts|wasm))$/.test(name));
  check(others.length === 0, `not ours to ship: ${others}`);

  const installed = path.join(user, "node_modules/fbs-player");
  mkdirSync(installed, { recursive: true });
  run("tar", "xf", path.join(user, filename), "-C", installed, "--strip-components=1");
  const { exports: entries } = JSON.parse(readFileSync(path.join(installed, "package.json"), "utf8"));
  for (const file of Object.values(entries).flatMap((entry) => (typeof entry === "string" ? [entry] : Object.values(entry))))
    check(existsSync(path.join(installed, file.replace("*", "fbs"))), `${file} is exported, but not there`);
  // Bundlers find worker and modules by these expressions alone.
  const scripts = names.filter((name) => name.endsWith(".js")).map((name) => readFileSync(path.join(installed, name), "utf8"));
  for (const text of ['new Worker(new URL("./worker.js", import.meta.url), { type: "module" })',
                      ...names.filter((name) => name.endsWith(".wasm")).map((name) => `new URL(".${name.slice(3)}", import.meta.url)`)])
    check(scripts.some((script) => script.includes(text)), `no script has ${text}`);
  cwd = user;
  writeFileSync(path.join(user, "user.mjs"), 'import { moduleUrl } from "fbs-player/decoder"; console.log(moduleUrl().pathname);');
  check(existsSync(run("node", "user.mjs").trim()), "fbs-player/decoder does not find its module");
} finally {
  rmSync(user, { recursive: true });
}
console.log(`${wrong} faults`);
process.exit(wrong > 0 ? 1 : 0);
