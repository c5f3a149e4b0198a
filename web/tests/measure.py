#!/usr/bin/env python3
"""Measures the player: measure.py [STREAM...]. Prints, and asserts nothing.

Size of the package; for each stream (those of the tests if none is named) pictures per second of the processor's time in
node, and by the clock in Chromium's worker, with the ratio to the program's on one thread; and seconds from a click to the
first picture and, where that is a preview, to that of the decoder, over links of 50 and 500 kbit/s, by gzip and by brotli:
where nothing has been loaded, not even the player's scripts; where a service worker has the player; and where a page has
loaded the decoder before."""
import pathlib
import resource
import statistics
import subprocess
import sys
import time

import material
from browser import chromium
from server import Server, packed

LINKS = (50, 500)  # kbit/s
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
const begin = performance.now(), seconds = () => (performance.now() - begin) / 1000;
import("/package/src/index.js").then(() => {
  const player = document.createElement("fbs-player"), times = [];
  for (const name of ["preview", "loadeddata", "error"])
    player.addEventListener(name, () => {
      times.push(seconds().toFixed(1));
      if (name !== "preview") done([times, name]);
    });
  player.src = url;
  document.body.append(player);
});
"""
PREPARE = """
const done = arguments[0];
import("/package/src/index.js").then(async ({ prepareDecoder }) => {
  await prepareDecoder();
  await fetch("/package/src/worker.js").then((answer) => answer.text());
  await Promise.all(["decoding_session", "fbs_module", "preview", "stream_source"].map(
    (name) => fetch(`/package/src/${name}.js`).then((answer) => answer.text())));
  done();
});
"""


KEEP = """
const done = arguments[0];
navigator.serviceWorker.register("/pages/keep.js", { scope: "/pages/" });
navigator.serviceWorker.ready.then(async ({ active }) => {
  while (active.state !== "activated") await new Promise((resolve) => setTimeout(resolve, 20));
  done();
});
"""


def print_sizes():
    source = material.WEB / "package/src"
    print("bytes                   raw    gzip  brotli")
    modules = [[f"{name}.wasm"] for name in ("fbs-simd", "fbs", "preview", "opus", "codec2")]
    for files in (*modules, sorted(path.name for path in source.glob("*.js"))):
        contents = [(source / file).read_bytes() for file in files]
        row = [sum(map(len, contents))] + [sum(len(packed(c, coding)) for c in contents) for coding in ("gzip", "br")]
        print(f"{files[0] if len(files) == 1 else 'all scripts':<17}{row[0]:>10}{row[1]:>8}{row[2]:>8}")


def native_seconds(stream):
    """By the clock, and of the processor's time."""
    begin, before = time.monotonic(), resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([material.FBS, "decode", stream, "null:", "--quiet", "--threads", "1"], check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return time.monotonic() - begin, after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime


def print_speed(stream, pictures):
    native = pictures / min(native_seconds(stream)[1] for _ in range(RUNS))
    done = subprocess.run(["node", material.ROOT / "web/tests/decode_speed.mjs", material.WEB / "package", stream],
                          stdout=subprocess.PIPE, text=True, check=True)
    for name, speed in (line.split() for line in done.stdout.splitlines()):
        print(f"  {float(speed):.0f} pictures/s of processor time by {name}, {float(speed) / native:.2f} of the program's")


def print_rate(driver, server, stream):
    """In turns, since the machine may be busy."""
    runs = []
    for _ in range(RUNS):
        driver.get(server.url("pages/blank.html"))
        pictures, seconds = driver.execute_async_script(DECODE, f"/media/{stream.name}")
        runs.append((pictures / seconds, native_seconds(stream)[0] / seconds))
    web, ratio = (statistics.median(run[k] for run in runs) for k in (0, 1))
    print(f"  {web:.0f} pictures/s by the clock in the worker, {ratio:.2f} of the program's")
    return pictures


def print_clicks(server, stream):
    print("  seconds to the first picture   nothing loaded   service worker   decoder loaded")
    for rate in LINKS:
        for coding in ("gzip", "br"):
            server.compresses = coding
            times = [click(server, stream, rate, prepare) for prepare in (None, KEEP, PREPARE)]
            print(f"  {rate:>4} kbit/s, {coding:<14}" + "".join(f"{text:>17}" for text in times))


def click(server, stream, rate, prepare):
    with chromium() as driver:
        driver.set_script_timeout(300)
        driver.get(server.url("pages/blank.html"))
        if prepare:
            driver.execute_async_script(prepare)
        if prepare == KEEP:  # another visit
            driver.get(server.url("pages/blank.html"))
        server.link.rate = 1000 * rate
        times, event = driver.execute_async_script(CLICK, f"/media/{stream.name}")
        server.link.rate = None
        return ", ".join(times) + ("" if event == "loadeddata" else f" {event}")


def main():
    material.make()
    streams = [pathlib.Path(name) for name in sys.argv[1:]] or [material.TALK, material.RADIO]
    print_sizes()
    for stream in streams:
        folders = {"package": material.WEB / "package", "pages": material.ROOT / "web/tests/pages", "media": stream.resolve().parent}
        print(f"{stream.name}, {stream.stat().st_size} bytes")
        with Server(folders) as server:
            with chromium() as driver:
                driver.set_script_timeout(300)
                pictures = print_rate(driver, server, stream)
            print_speed(stream, pictures)
            print_clicks(server, stream)


if __name__ == "__main__":
    main()
