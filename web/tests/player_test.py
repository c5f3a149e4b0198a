#!/usr/bin/env python3
"""The player in Chromium without a window: player_test.py [TestPlayer.NAME...]. Needs build/web/package and the program."""
import array
import hashlib
import json
import math
import pathlib
import re
import shutil
import sys
import tempfile
import time
import unittest

import material
from browser import chromium
from server import Server
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.keys import Keys

MAKE = """
const [attributes, done] = arguments;
const player = document.createElement("fbs-player");
window.player = player;
window.events = [];
for (const name of ["loadedmetadata", "play", "playing", "pause", "waiting", "seeking", "seeked", "ended", "error"])
  player.addEventListener(name, (event) => events.push(name + (event.detail ? " " + event.detail.code : "")));
for (const [name, value] of Object.entries(attributes)) player.setAttribute(name, value);
for (const name of ["loadeddata", "error"]) player.addEventListener(name, () => done(name), { once: true });
document.body.replaceChildren(player);
"""
COLLECT = """
const [url, done] = arguments;
import("/pages/collect.js").then(async ({ collect, heard, report }) => {
  const { pictures, sound, errors } = await collect(url);
  await report("pictures", new Blob(pictures));
  await report("sound", new Blob(sound.map((piece) => piece.samples)));
  await report("heard", new Blob([await heard(sound, 0.5)]));
  done({ count: pictures.length, rate: sound[0].sampleRate, errors });
});
"""
LEAD = 0.05  # seconds before a SoundOutput begins


class TestPlayer(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        material.make()
        folders = {"package": material.WEB / "package", "pages": material.ROOT / "web/tests/pages",
                   "demo": material.ROOT / "web/demo", "media": material.FOLDER}
        cls.server = cls.enterClassContext(Server(folders))
        cls.driver = cls.enterClassContext(chromium())

    def setUp(self):
        self.server.link.rate = None
        self.driver.get(self.server.url("pages/player.html"))

    def js(self, script, *arguments):
        return self.driver.execute_script(script, *arguments)

    def make(self, src, **attributes):
        """A player. What comes first: loadeddata, or an error."""
        return self.driver.execute_async_script(MAKE, {"src": f"/media/{src}", "controls": "", **attributes})

    def begin(self, src, **attributes):
        """A player, of which nothing has come. Previews count as events, too."""
        self.js(MAKE.replace("const [attributes, done]", "const done = () => {}, [attributes]") +
                "player.addEventListener('preview', () => events.push('preview'));", {"src": f"/media/{src}", **attributes})

    def inner(self, selector):
        return self.js("return player.shadowRoot.querySelector(arguments[0])", selector)

    def until(self, condition, seconds=15):
        end = time.monotonic() + seconds
        while not self.js(f"return {condition}"):
            self.assertLess(time.monotonic(), end, f"never: {condition}; events: {self.js('return window.events')}")
            time.sleep(0.02)

    def press(self, *keys):
        ActionChains(self.driver).send_keys(*keys).perform()

    # ---- what is decoded

    def test_pictures_and_sound_are_those_of_the_program(self):
        for stream, least in ((material.TALK, 60), (material.RADIO, 40)):
            with self.subTest(stream.name):
                said = self.driver.execute_async_script(COLLECT, f"/media/{stream.name}")
                planes, sound, heard = (self.server.posted(name) for name in ("pictures", "sound", "heard"))
                size = material.WIDTH * material.HEIGHT * 3 // 2
                got = [hashlib.md5(planes[k:k + size]).hexdigest() for k in range(0, len(planes), size)]
                self.assertEqual(got, material.native_pictures(stream))
                self.assertEqual(said["errors"], [])
                expected, rate = material.native_sound(stream)
                self.assertEqual(said["rate"], rate)
                # Codecs promise no equal samples.
                self.assertGreater(signal_to_noise(shorts(expected), shorts(sound)), least, "dB")
                # Pieces meet without a seam: nothing is added on the way to the loudspeaker.
                at = round(0.5 * rate)
                self.assertGreater(signal_to_noise(shorts(sound)[at:], scaled(heard)[round(LEAD * rate):]), 60, "dB")

    def test_a_picture_is_the_same_after_a_seek(self):
        self.make("talk.fbs")
        native = material.native_pictures(material.TALK)
        for time_s, number in ((1.42, 35), (0.3, 7), (2.98, 74), (9, 74)):
            self.js("events.length = 0; player.currentTime = arguments[0]", time_s)
            self.until("events.includes('seeked')")
            self.assertEqual(self.js("return player.playback.shown.number"), number)
            self.js("fetch('/shown', { method: 'POST', body: player.playback.shown.planes })")
            self.assertEqual(hashlib.md5(self.server.posted("shown")).hexdigest(), native[number])
        self.assertEqual(self.js("return [player.currentTime, player.duration, player.paused]"), [3, 3, True])
        # News of the stream that crosses a seek on its way counts.
        self.js("""const { playback } = player, { arrival, client } = playback;
                   playback.arrival = { ...arrival, complete: false };
                   player.currentTime = 1;
                   client.worker.onmessage({ data: { type: "arrival", generation: client.loaded, arrival } });""")
        self.assertEqual(self.js("return player.duration"), 3)

    def test_colours_are_right_by_webgl_and_without(self):
        self.make("talk.fbs")
        wrong = self.driver.execute_async_script("""
            const done = arguments[0];
            import("/package/src/picture_painter.js").then(({ PicturePainter }) => {
              const format = { width: 66, height: 65, frameRate: 25, pixelAspect: 1, fullRange: false };
              const out = {};
              for (const plain of [false, true])
                for (const [matrix, fullRange, samples, rgb] of [
                  ["bt601", false, [81, 90, 240], [255, 0, 0]], ["bt709", false, [63, 102, 240], [255, 0, 0]],
                  ["bt601", true, [76, 85, 255], [255, 0, 0]], ["bt709", false, [235, 128, 128], [255, 255, 255]],
                  ["unspecified", false, [145, 54, 34], [0, 255, 0]]]) {
                  const planes = new Uint8Array(66 * 65 + 2 * 33 * 33).fill(samples[0]);
                  planes.fill(samples[1], 66 * 65).fill(samples[2], 66 * 65 + 33 * 33);
                  const canvas = document.createElement("canvas");
                  const painter = new PicturePainter(canvas, plain);
                  painter.paint({ width: 66, height: 65, planes, format: { ...format, matrix, fullRange } });
                  const copy = new OffscreenCanvas(66, 65).getContext("2d");
                  copy.drawImage(canvas, 0, 0);
                  const got = copy.getImageData(60, 60, 1, 1).data;
                  const kind = painter.painter.constructor.name;
                  if (rgb.some((x, k) => Math.abs(x - got[k]) > 2)) out[kind + matrix + fullRange] = [...got];
                  out.kinds = { ...out.kinds, [kind]: true };
                }
              done(out);
            });""")
        self.assertEqual(wrong, {"kinds": {"GlPainter": True, "PlainPainter": True}})

    # ---- playing

    def test_plays_to_its_end_with_sound(self):
        self.make("talk.fbs")
        self.js("""window.times = []; player.addEventListener("timeupdate", () => times.push(player.currentTime));
                   window.shown = []; player.addEventListener("face", ({ detail }) => shown.push(detail.time));""")
        self.inner(".bar button").click()  # a gesture: sound is allowed
        begin = time.monotonic()
        self.until("player.ended")
        self.assertLess(abs(time.monotonic() - begin - 3), 1.5)
        self.assertEqual(self.js("return events"), ["loadedmetadata", "play", "playing", "pause", "ended"])
        times, shown = self.js("return [times, shown]")
        self.assertEqual(times, sorted(times))
        self.assertGreater(len(times), 4)
        self.assertEqual(shown, sorted(shown))
        self.assertEqual(shown[-1], 74 / 25)
        self.assertEqual(self.js("return player.playback.sound.context.sampleRate"), 48000)
        rate = self.js("return player.rate")
        self.assertAlmostEqual(sum(rate.values()) * 3000 / 8, material.TALK.stat().st_size, delta=1)
        self.assertGreater(rate["sound"], 6)
        self.assertEqual(self.inner(".rate").text, f"{rate['picture']:.1f} + {rate['sound']:.1f} kbit/s")
        self.inner(".bar button").click()  # from the beginning
        self.until("!player.paused && player.currentTime > 0.2 && player.currentTime < 2")

    def test_loops_and_is_muted(self):
        self.make("radio.fbs", loop="", muted="", autoplay="")
        self.until("player.currentTime > 2.5")
        self.until("player.currentTime < 1 && !player.paused")
        self.assertNotIn("ended", self.js("return events"))
        self.assertIsNone(self.js("return player.playback.sound"))
        self.js("player.loop = false; player.currentTime = 2.7")
        self.until("player.ended")

    def test_plays_what_has_come(self):
        self.server.gate.clear()
        self.make("talk.fbs?hold=5000", muted="", autoplay="")
        self.until("events.join().endsWith('playing,waiting')")
        arrived, shown = self.js("return [player.arrivedTime, player.playback.shown.number]")
        self.assertTrue(0.5 < arrived < 2, arrived)
        self.assertEqual(shown, round(arrived * 25) - 1)
        self.assertEqual(self.js("return [player.duration, player.paused]"), [None, False])  # infinite: not in JSON
        self.server.gate.set()
        self.until("player.ended")
        self.assertTrue(self.js("return events.join()").endswith("playing,waiting,playing,pause,ended"))
        self.assertEqual(self.js("return player.duration"), 3)

    def test_waits_for_a_time_that_has_not_come(self):
        self.server.gate.clear()
        self.make("talk.fbs?hold=5000")
        self.js("player.currentTime = 2.5")
        self.until("events.includes('waiting')")
        self.assertTrue(self.js("return player.seeking"))
        self.server.gate.set()
        self.until("events.includes('seeked')")
        self.assertEqual(self.js("return [player.currentTime, player.playback.shown.number]"), [2.5, 62])

    def test_loads_nothing_before_it_is_asked(self):
        self.begin("talk.fbs", preload="none", muted="")
        time.sleep(0.2)
        self.assertEqual(self.js("return [player.currentSrc, player.playback.client.worker, events.length]"), ["", None, 0])
        self.js("player.play()")
        self.until("player.currentTime > 0.2")

    def test_a_preview_is_shown_before_the_decoder_has_come(self):
        with Server(self.server.folders) as other:
            other.withheld = "fbs-simd.wasm"
            self.driver.get(other.url("pages/player.html"))
            self.begin("talk.fbs")
            self.until("events.length")
            said = self.js("""
                fetch("/preview", { method: "POST", body: player.painter.last.planes });
                return [events, player.videoWidth, player.face, player.duration];""")
            self.assertEqual(said, [["preview"], 0, None, None])
            asked = [pathlib.PurePath(path).name for path in other.asked]
            self.assertLess(asked.index("preview.wasm"), asked.index("talk.fbs"))
            self.assertEqual(asked.index("fbs-simd.wasm"), len(asked) - 1)
            other.gate.set()
            self.until("events.length > 1")
            self.assertEqual(self.js("return events"), ["preview", "loadedmetadata"])
            self.js("fetch('/shown', { method: 'POST', body: player.playback.shown.planes })")
            self.assertGreater(signal_to_noise(other.posted("shown"), other.posted("preview")), 40, "dB")

    def test_plays_without_a_preview(self):
        with Server(self.server.folders) as other:
            other.missing = "preview.wasm"
            self.driver.get(other.url("pages/player.html"))
            self.begin("talk.fbs")
            self.until("events.length")
            self.assertEqual(self.js("return [events[0], player.videoWidth]"), ["loadedmetadata", material.WIDTH])

    def test_package_and_stream_of_another_origin(self):
        with Server(self.server.folders) as other:
            self.driver.get(self.server.url("pages/blank.html"))
            said = self.driver.execute_async_script("""
                const [base, done] = arguments;
                import(`${base}package/src/index.js`).then(() => {
                  const player = document.createElement("fbs-player");
                  player.src = `${base}media/radio.fbs`;
                  for (const name of ["loadeddata", "error"])
                    player.addEventListener(name, ({ detail }) => done(detail?.message ?? player.videoWidth));
                  document.body.append(player);
                });""", other.url(""))
            self.assertEqual(said, material.WIDTH)

    def test_sound_waits_for_its_decoder_and_pictures_do_not(self):
        with Server(self.server.folders) as other:
            other.withheld = "opus.wasm"
            self.driver.get(other.url("pages/player.html"))
            self.assertEqual(self.make("talk.fbs"), "loadeddata")
            self.inner(".bar button").click()
            time.sleep(0.3)
            self.assertEqual(self.js("return [player.paused, player.currentTime]"), [False, 0])
            other.gate.set()
            self.until("player.currentTime > 0.2")
            self.assertGreater(self.js("return player.playback.sound.end"), 0.2)

    def test_plays_without_sound_where_its_decoder_is_missing(self):
        with Server(self.server.folders) as other:
            other.missing = "opus.wasm"
            self.driver.get(other.url("pages/player.html"))
            self.make("talk.fbs")
            self.until("player.error")
            self.assertEqual(self.js("return [player.error.code, player.error.fatal]"), ["http", False])
            self.inner(".bar button").click()
            self.until("player.currentTime > 0.2")

    def test_service_worker_keeps_one_version(self):
        with tempfile.TemporaryDirectory() as folder, Server({"site": folder, "media": material.FOLDER}) as other:
            source = pathlib.Path(folder) / "package/src"
            shutil.copytree(material.WEB / "package", source.parents[0])
            (pathlib.Path(folder) / "sw.js").write_text(
                'importScripts("package/src/service_worker.js");\nkeepFbsPlayer("package/src/");\n')
            page = (material.ROOT / "web/tests/pages/player.html").read_text()
            (pathlib.Path(folder) / "index.html").write_text(page.replace("/package/", "package/"))
            other.cacheable = False

            def visit():
                """What is asked of the server, and the version that the page has."""
                self.driver.get(other.url("site/index.html"))
                del other.asked[:]
                self.assertEqual(self.make("talk.fbs"), "loadeddata")
                self.until("player.playback.arrival.complete")
                version = self.driver.execute_async_script("""
                    fetch("package/src/index.js").then((answer) => answer.text()).then(arguments[0]);""")
                return [path for path in other.asked if "/package/" in path], "another" in version

            asked, _ = visit()
            self.assertIn("/site/package/src/fbs-simd.wasm", asked)
            self.driver.execute_async_script("""
                const [done] = arguments;
                navigator.serviceWorker.register("sw.js", { updateViaCache: "none" });
                navigator.serviceWorker.ready.then(done);""")
            self.assertEqual(visit(), ([], False))
            # A new version: the page that is open keeps the old one, the next has the new one.
            with (source / "index.js").open("a") as out:
                out.write("// another\n")
            worker = source / "service_worker.js"
            worker.write_text(re.sub('VERSION = "\\w+"', 'VERSION = "another"', worker.read_text()))
            self.driver.execute_async_script("""
                const [done] = arguments;
                navigator.serviceWorker.ready.then(async (found) => {
                  await found.update();
                  while (!found.waiting) await new Promise((resolve) => setTimeout(resolve, 20));
                  done();
                });""")
            self.assertEqual(visit(), ([], False))
            self.driver.get("about:blank")
            time.sleep(0.5)
            self.assertEqual(visit(), ([], True))
            self.assertEqual(self.js("return caches.keys().then((names) => names.length)"), 1)

    def test_does_not_start_where_it_must_not(self):
        self.make("talk.fbs", autoplay="")  # no sound without a gesture
        self.until("events.includes('pause')")
        self.assertTrue(self.js("return player.paused && player.currentTime === 0"))
        features = [{"name": "prefers-reduced-motion", "value": "reduce"}]
        self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": features})
        try:
            self.make("talk.fbs", autoplay="", muted="")
            time.sleep(0.3)
            self.assertEqual(self.js("return events"), ["loadedmetadata"])
        finally:
            self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": []})

    # ---- the visitor

    def test_the_face_is_moved(self):
        self.make("talk.fbs")
        self.js("player.addEventListener('face', ({ detail }) => (window.face = detail.face))")
        pose = lambda: self.js("player.faceEdit = player.faceEdit; return player.face.pose")
        before, mouth = pose(), self.js("return player.face.blendshapes.jawOpen")
        self.js("player.faceEdit = { yaw: 10, mouth: 1 }")
        self.until("window.face && face.blendshapes.jawOpen > 0.3")
        self.assertAlmostEqual(pose()["yaw"] - before["yaw"], 10, delta=0.1)
        self.assertLess(mouth, 0.2)
        self.assertEqual(self.js("return face.landmarks.length"), 3 * 68)
        ActionChains(self.driver).drag_and_drop_by_offset(self.inner(".stage"), 60, 0).perform()
        self.until("player.faceEdit.yaw < 1")  # to the picture's right
        self.inner(".bar .framed").click()
        self.js("player.shadowRoot.querySelectorAll('.deeds button')[1].click()")
        self.until(f"Math.abs(face.pose.yaw - {before['yaw']}) < 0.01")
        self.js("fetch('/shown', { method: 'POST', body: player.playback.shown.planes })")
        self.assertEqual(hashlib.md5(self.server.posted("shown")).hexdigest(), material.native_pictures(material.TALK)[0])

    def test_keyboard(self):
        self.make("talk.fbs", muted="")
        self.js("document.body.tabIndex = -1; document.body.focus()")
        reached = []
        for _ in range(7):
            self.press(Keys.TAB)
            reached.append(self.js("return player.shadowRoot.activeElement?.getAttribute('aria-label') ?? "
                                   "player.shadowRoot.activeElement?.textContent"))
        self.assertEqual([name.partition(":")[0] for name in reached[:6]],
                         ["Video of a person talking", "Play", "Time", "Unmute", "Volume", "Face"])
        self.js("player.shadowRoot.querySelector('.stage').focus()")
        self.press(" ")
        self.until("!player.paused")
        self.press(" ")
        self.until("player.paused")
        self.press(Keys.ARROW_LEFT, Keys.ARROW_LEFT, Keys.ARROW_DOWN)
        self.assertEqual(self.js("return [player.faceEdit.yaw, player.faceEdit.pitch]"), [6, 3])
        self.press("0")
        self.assertEqual(self.js("return player.faceEdit.yaw"), 0)
        self.press("m", "-", "-")
        self.assertEqual(self.js("return [player.muted, Math.round(player.volume * 10)]"), [False, 8])
        self.press("+")
        self.assertEqual(self.js("return Math.round(player.volume * 10)"), 9)
        self.press(Keys.END)
        self.until("player.currentTime === 3")
        self.press(Keys.HOME)
        self.until("player.currentTime === 0 && !player.seeking")
        self.js("player.shadowRoot.querySelector('.time').focus()")
        self.press(Keys.ARROW_RIGHT)
        self.until("player.currentTime === 3")

    def test_every_control_has_a_name(self):
        self.make("talk.fbs")
        self.inner(".bar .framed").click()
        nodes = self.driver.execute_cdp_cmd("Accessibility.getFullAXTree", {})["nodes"]
        value = lambda node, key: node.get(key, {}).get("value", "")
        controls = [(value(n, "role"), value(n, "name")) for n in nodes if value(n, "role") in ("button", "slider", "application")]
        self.assertEqual([c for c in controls if not c[1]], [])
        self.assertEqual(len(controls), 15)
        live = [n for n in nodes if value(n, "role") == "status"]
        self.assertEqual(len(live), 1)
        self.inner(".bar button").click()
        self.until("player.shadowRoot.querySelector('[role=status]').textContent === 'Playing'")

    def test_demo(self):
        size = material.TALK.stat().st_size
        entry = {"rate": 25, "fbs": "talk.fbs", "fbs_bytes": size, "av1": "none.webm", "av1_bytes": 2 * size,
                 "av1_size": "176x144", "av1_fps": 12.5}
        (material.FOLDER / "media.json").write_text(json.dumps({"seconds": 3, "media": [entry]}))
        self.driver.get(self.server.url("demo/index.html"))
        self.until("document.querySelector('fbs-player')?.videoWidth === 176")
        captions = [element.text for element in self.driver.find_elements("css selector", "figcaption")]
        self.assertEqual([caption.split()[1] for caption in captions], [f"{k * size * 8 / 3000:.1f}" for k in (1, 2)])
        (material.FOLDER / "media.json").unlink()
        self.driver.get(self.server.url("demo/index.html?again"))
        self.until("document.querySelector('#rows').textContent.includes('404')")

    # ---- what goes wrong

    def test_errors(self):
        for src, event, fatal, says in (
                ("nothing.fbs", "error http", True, "404"),
                ("page.fbs", "error not-fbs", True, "not an fbs stream"),
                ("cut.fbs", "error truncated", False, "ends"),
                ("damaged.fbs", "error damaged", False, ""),
                ("talk.fbs?cut=8000", "error network", False, "fetched")):
            with self.subTest(src):
                self.server.link.rate = 200000 if "?" in src else None  # something comes before it breaks off
                self.make(src, muted="", autoplay="")
                self.until(f"events.includes('{event}')")
                error = self.js("return player.error")
                self.assertEqual((error["fatal"], says in error["message"]), (fatal, True), error)
                self.assertIn(error["message"].lower(), self.inner(".message").text.lower())
                if not fatal:
                    self.until("player.ended")
        self.assertEqual(self.make("talk.fbs"), "loadeddata")  # the next one plays

    def test_error_of_a_decoder_that_is_not_there(self):
        self.js("""window.fetch = ((fetch) => (url, ...rest) => fetch(String(url).replace(/fbs(-simd)?.wasm/, "no.wasm"),
                   ...rest))(window.fetch)""")
        self.assertEqual(self.make("talk.fbs"), "error")
        self.assertEqual(self.js("return [player.error.code, player.error.fatal, player.paused]"), ["http", True, True])

    def test_error_of_a_decoder_that_fails(self):
        self.js("""const nothing = new Uint8Array([0, 97, 115, 109, 1, 0, 0, 0]);
                   WebAssembly.compileStreaming = async () => new WebAssembly.Module(nothing);""")
        self.assertEqual(self.make("talk.fbs"), "error")
        self.assertEqual(self.js("return [player.error.code, player.error.fatal]"), ["internal", True])


def shorts(content):
    out = array.array("h")
    out.frombytes(content[:len(content) // 2 * 2])
    return out


def scaled(content):
    floats = array.array("f")
    floats.frombytes(content)
    return [32768 * x for x in floats]


def signal_to_noise(expected, got):
    """dB, over what both have, which has to be nearly all of it."""
    count = min(len(expected), len(got))
    if count < 0.95 * len(expected):
        return -math.inf
    noise = sum((expected[k] - got[k]) ** 2 for k in range(count))
    return 10 * math.log10(sum(x * x for x in expected) / max(noise, 1e-9))


if __name__ == "__main__":
    if not (material.WEB / "package").exists():
        sys.exit(77)  # the build has been skipped
    unittest.main(verbosity=2)
