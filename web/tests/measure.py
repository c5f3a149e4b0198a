#!/usr/bin/env python3
"""Measures the player: measure.py [STREAM...]. Prints, and asserts nothing.

Size of the package; for each stream (those of the tests if none is named) pictures per second in Chromium's worker, with the
ratio to the program's on one thread, and seconds from a click to the first picture over a link of 50 kbit/s: on a page whose
decoder has been loaded, and on one where nothing has, not even the player's scripts."""
import pathlib
import statistics
import subprocess
import sys
import time

import material
from browser import chromium
from server import Server

LINK = 50000  # bit/s
RUNS = 3

DECODE = """
const [url, done] = arguments;
import("/package/src/decoder_client.js").then(({ DecoderClient }) => {
  let pictures = 0, begin = 0;
  const client = new DecoderClient((answer) => {
    if (answer.type === "arrival" && answer.arrival.complete && !begin) {
      begin = performance.now();
      client.next(-1);
    }
    if (answer.type === "picture") ++pictures;
    if (answer.type === "picture") client.next(-1, answer.picture.planes.buffer);
    if (answer.type === "end") done([pictures, (performance.now() - begin) / 1000]);
  });
  client.load(new URL(url, location.href).href);
});
"""
# The element is not known yet where the page is blank: its scripts come with the click.
CLICK = """
const [url, done] = arguments;
const begin = performance.now();
import("/package/src/index.js").then(() => {
  const player = document.createElement("fbs-player");
  for (const name of ["loadeddata", "error"])
    player.addEventListener(name, (event) => done([(performance.now() - begin) / 1000, name]));
  player.src = url;
  document.body.append(player);
});
"""
PREPARE = """
const done = arguments[0];
import("/package/src/index.js").then(async ({ prepareDecoder }) => {
  await prepareDecoder();
  await fetch("/package/src/worker.js").then((answer) => answer.text());
  await Promise.all(["decoding_session", "fbs_module", "stream_source"].map(
    (name) => fetch(`/package/src/${name}.js`).then((answer) => answer.text())));
  done();
});
"""


def packed(content, *tool):
    return len(subprocess.run(tool, input=content, stdout=subprocess.PIPE, check=True).stdout)


def print_sizes():
    source = material.WEB / "package/src"
    print("bytes                   raw    gzip  brotli")
    for name, files in (("fbs-simd.wasm", ["fbs-simd.wasm"]), ("fbs.wasm", ["fbs.wasm"]), ("all scripts", sorted(source.glob("*.js")))):
        contents = [(source / file).read_bytes() for file in files]
        row = [sum(map(len, contents)), sum(packed(c, "gzip", "-9", "-c") for c in contents),
               sum(packed(c, "brotli", "-q", "11", "-c") for c in contents)]
        print(f"{name:<17}" + "".join(f"{size:>10}" if k == 0 else f"{size:>8}" for k, size in enumerate(row)))


def native_seconds(stream):
    begin = time.monotonic()
    subprocess.run([material.FBS, "decode", stream, "null:", "--quiet", "--threads", "1"], check=True)
    return time.monotonic() - begin


def print_rate(driver, server, stream):
    """In turns, since the machine may be busy."""
    runs = []
    for _ in range(RUNS):
        driver.get(server.url("pages/blank.html"))
        pictures, seconds = driver.execute_async_script(DECODE, f"/media/{stream.name}")
        runs.append((pictures / seconds, native_seconds(stream) / seconds))
    web, ratio = (statistics.median(run[k] for run in runs) for k in (0, 1))
    print(f"  {web:.0f} pictures/s in the worker, {ratio:.2f} of the program's")


def print_clicks(server, stream):
    for what, prepare in (("decoder loaded", True), ("nothing loaded", False)):
        with chromium() as driver:
            driver.get(server.url("pages/blank.html"))
            driver.set_script_timeout(300)
            if prepare:
                driver.execute_async_script(PREPARE)
            server.link.rate = LINK
            seconds, event = driver.execute_async_script(CLICK, f"/media/{stream.name}")
            server.link.rate = None
            print(f"  {seconds:.1f} s to the first picture, {what}" + ("" if event == "loadeddata" else f": {event}"))


def main():
    material.make()
    streams = [pathlib.Path(name) for name in sys.argv[1:]] or [material.TALK, material.RADIO]
    print_sizes()
    for stream in streams:
        folders = {"package": material.WEB / "package", "pages": material.ROOT / "web/tests/pages", "media": stream.resolve().parent}
        print(f"{stream.name}, {stream.stat().st_size} bytes")
        with Server(folders) as server:
            server.compresses = True
            with chromium() as driver:
                driver.set_script_timeout(300)
                print_rate(driver, server, stream)
            print_clicks(server, stream)


if __name__ == "__main__":
    main()
