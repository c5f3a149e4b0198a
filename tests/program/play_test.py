"""fbs play on a screen of 1024 x 768: keys and mouse are sent, what is seen is read back. Skipped without Xvfb and xdotool.

Most tests begin paused and record: then there is one picture for the beginning and one for each change, whatever the time."""
import os
import shutil
import subprocess
import time
import unittest

from harness import FBS, MATERIAL, TALK_FBS, TALK_ONE_FBS, ProgramTest, read_y4m, talker

SCREEN = 1024, 768
PATIENCE = 60  # seconds, for what takes one
PORTRAIT = MATERIAL / "portrait.fbs"


def wait_for(what, text):
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        found = what()
        if found:
            return found
        time.sleep(0.02)
    raise AssertionError(f"{text}: not within {PATIENCE} s")


class Screen:
    """An X server of its own."""

    def __init__(self):
        ours, theirs = os.pipe()
        self.server = subprocess.Popen(["Xvfb", "-displayfd", str(theirs), "-screen", "0", "%dx%dx24" % SCREEN,
                                        "-nolisten", "tcp", "-noreset"], pass_fds=[theirs], stderr=subprocess.DEVNULL)
        os.close(theirs)
        with os.fdopen(ours) as told:
            number = told.readline().strip()
        if not number:
            raise unittest.SkipTest("Xvfb does not start here")
        self.environment = {key: value for key, value in os.environ.items()
                            if key not in ("WAYLAND_DISPLAY", "SDL_VIDEODRIVER")}
        self.environment |= {"DISPLAY": ":" + number, "SDL_RENDER_DRIVER": "software"}

    def close(self):
        self.server.terminate()
        self.server.wait()

    def xdotool(self, *arguments):
        return subprocess.run(["xdotool", *map(str, arguments)], env=self.environment, capture_output=True, text=True,
                              timeout=PATIENCE).stdout

    def shot(self):
        """Rows of the screen, 3 bytes a pixel."""
        ppm = subprocess.run(["import", "-window", "root", "-depth", "8", "ppm:-"], env=self.environment, check=True,
                             capture_output=True, timeout=PATIENCE).stdout
        _, size, _, data = ppm.split(b"\n", 3)
        width, height = map(int, size.split())
        assert (width, height) == SCREEN and len(data) == 3 * width * height
        return [data[3 * width * y:3 * width * (y + 1)] for y in range(height)]


class Play(ProgramTest):
    @classmethod
    def setUpClass(cls):
        missing = [name for name in ("Xvfb", "xdotool") if not shutil.which(name)]
        if missing:
            raise unittest.SkipTest("not installed: " + ", ".join(missing))
        cls.screen = Screen()

    @classmethod
    def tearDownClass(cls):
        cls.screen.close()

    def open(self, *arguments, stdin=None):
        """Starts the player and waits for its window; the pointer is over it."""
        player = subprocess.Popen([FBS, "play", *map(str, arguments)], env=self.screen.environment, cwd=self.folder,
                                  stdin=stdin, stderr=subprocess.PIPE)
        self.addCleanup(lambda: (player.kill(), player.communicate()))

        def window():
            self.assertIsNone(player.poll(), "the player has ended")
            return self.screen.xdotool("search", "--onlyvisible", "--name", "^fbs: ").split()
        self.window = wait_for(window, "window")[0]
        # There is no window manager to give it the keyboard; SDL drops what comes just before and after that.
        self.screen.xdotool("windowfocus", "--sync", self.window, "mousemove", SCREEN[0] // 2, SCREEN[1] // 2)
        time.sleep(0.4)
        return player

    def press(self, *keys):
        self.screen.xdotool("key", "--delay", "30", *keys)

    def quit(self, player):
        self.press("q")
        said = player.communicate(timeout=PATIENCE)[1].decode()
        self.assertEqual(player.returncode, 0, said)
        return said

    def recorded(self, *keys, stream=TALK_FBS, options=(), stdin=None):
        """Pictures that are recorded when these keys are pressed."""
        player = self.open(stream, "--paused", "--record", "seen.y4m", *options, stdin=stdin)
        self.press(*keys)
        self.quit(player)
        seen = read_y4m(self.folder / "seen.y4m")
        self.assertEqual((seen.width, seen.height), (176, 144))
        return seen.pictures

    def assert_shows(self, seen, numbers, stream=TALK_FBS):
        """Whether these are the pictures of these numbers that decode writes, sample for sample."""
        decoded = self.decoded(stream).pictures
        self.assertEqual([decoded.index(p) if p in decoded else None for p in seen],
                         [decoded.index(decoded[k]) for k in numbers])

    def geometry(self):
        def asked():
            # On a busy machine xdotool sometimes answers without them.
            text = self.screen.xdotool("getwindowgeometry", "--shell", self.window)
            values = dict(line.split("=", 1) for line in text.split() if "=" in line)
            return all(name in values for name in wanted) and tuple(int(values[name]) for name in wanted)
        wanted = ("X", "Y", "WIDTH", "HEIGHT")
        return wait_for(asked, "geometry")

    def needs_import(self):
        if not shutil.which("import"):
            self.skipTest("ImageMagick's import is not installed")

    def landmarks(self):
        """{number: (x, y)} of the first picture."""
        self.succeed("export", TALK_ONE_FBS, "marks.csv")
        names, first = (line.split(",") for line in (self.folder / "marks.csv").read_text().splitlines()[:2])
        row = dict(zip(names, map(float, first)))
        return {k: (row[f"x{k}"], row[f"y{k}"]) for k in range(68)}

    def changed(self, a, b, more_than=0, width=176, height=144):
        """Box of the luma samples that differ by more: left, top, right, bottom; None if none does."""
        points = [(k % width, k // width) for k in range(width * height) if abs(a[k] - b[k]) > more_than]
        if not points:
            return None
        xs, ys = zip(*points)
        return min(xs), min(ys), max(xs), max(ys)


class Keys(Play):
    def test_stepping_shows_what_decode_writes(self):
        seen = self.recorded("period", "Right", "period", "comma", "Left", "Right")
        self.assert_shows(seen, (0, 1, 2, 3, 2, 1, 2))

    def test_seek_goes_to_another_time(self):
        two = round(2 * self.decoded().rate)
        seen = self.recorded("Left", "Up", "Down", "Home", options=("--from", "2"))
        self.assert_shows(seen, (two, two - 1, -1, 0, two))

    def test_click_on_the_bar_goes_there(self):
        decoded = self.decoded().pictures
        player = self.open(TALK_FBS, "--paused", "--record", "seen.y4m")
        left, top, width, height = self.geometry()
        self.screen.xdotool("mousemove", left + width // 2, top + height - 3, "click", 1)
        self.quit(player)
        seen = read_y4m(self.folder / "seen.y4m").pictures
        self.assert_shows(seen[:1], [0])
        self.assertAlmostEqual(decoded.index(seen[1]), len(decoded) / 2, delta=2)

    def test_mouth_key_moves_the_mouth_alone(self):
        # A picture of one pattern: which of several are blended follows from the whole face.
        before, *_, opened, after = self.recorded("m", "m", "m", "0", stream=TALK_ONE_FBS)
        marks = self.landmarks()
        left, top, right, bottom = self.changed(before, opened)
        self.assertGreater(top, max(marks[k][1] for k in range(17, 27)), "brows")
        self.assertTrue(left > 8 and right < 168 and bottom < 136, "border")
        left, top, right, bottom = self.changed(before, opened, more_than=12)
        self.assertGreater(top, marks[30][1], "nose")
        self.assertLess(right - left, marks[45][0] - marks[36][0])
        for k in (48, 54, 57):
            x, y = marks[k]
            self.assertTrue(left - 3 <= x <= right + 3 and top - 3 <= y <= bottom + 3, k)
        self.assertIsNone(self.changed(after, before))

    def test_every_key_of_the_face_changes_the_face_and_0_takes_it_back(self):
        marks = self.landmarks()
        keys = ["shift+Right", "shift+Left", "shift+Up", "shift+Down", "ctrl+Left", "ctrl+Right", "b", "shift+b", "m", "g",
                "shift+g", "e", "shift+e"]
        first, *seen = self.recorded(*(k for key in keys for k in (key, "0")))
        self.assertEqual(len(seen), 2 * len(keys))
        self.assertEqual(len(set(seen[::2])), len(keys), "two keys do the same")
        for key, moved, back in zip(keys, seen[::2], seen[1::2]):
            left, _, right, _ = self.changed(first, moved)
            self.assertTrue(left < marks[27][0] < right, key)
            self.assertIsNone(self.changed(back, first), key)

    def test_drag_turns_the_head(self):
        player = self.open(TALK_FBS, "--paused", "--record", "seen.y4m")
        self.screen.xdotool("mousedown", 1, "mousemove_relative", 40, 0, "mouseup", 1)
        self.press("0")
        self.quit(player)
        first, *turned, last = read_y4m(self.folder / "seen.y4m").pictures
        self.assertTrue(turned)
        self.assertIsNotNone(self.changed(first, turned[-1]))
        self.assertIsNone(self.changed(last, first))

    def test_pattern_alone_and_back(self):
        first, *seen, last = self.recorded("Up", "1", "2", "bracketright", "n", "o")
        self.assertIsNone(self.changed(last, seen[0]))
        self.assertEqual(len(set(seen[1:3])), 2)
        self.assertIsNotNone(self.changed(first, last))

    def test_wire_frame_and_contours_lie_on_the_face(self):
        marks = self.landmarks()
        first, wire, plain, snakes = self.recorded("w", "w", "s")
        self.assertIsNone(self.changed(plain, first))
        # Colour is converted to and fro, so that other samples may differ a little.
        left, _, right, bottom = self.changed(wire, first, more_than=12)
        self.assertLess(abs(left - marks[0][0]), 8)
        self.assertLess(abs(right - marks[16][0]), 8)
        self.assertLess(abs(bottom - marks[8][1]), 8)
        inner = self.changed(snakes, first, more_than=12)
        self.assertTrue(left < inner[0] and inner[2] < right and inner[3] < bottom)

    def test_pipe_is_kept_for_going_back(self):
        with open(TALK_FBS, "rb") as stream:
            pipe = subprocess.Popen(["cat"], stdin=stream, stdout=subprocess.PIPE)
            seen = self.recorded("Right", "Right", "Left", "Home", stream="-", stdin=pipe.stdout)
            pipe.wait()
        self.assert_shows(seen, (0, 1, 2, 1, 0))

    def test_pipe_that_waits_does_not_stop_the_keys(self):
        ours, theirs = os.pipe()
        with os.fdopen(ours, "rb") as reading, os.fdopen(theirs, "wb") as writing:
            data = TALK_FBS.read_bytes()
            writing.write(data[:len(data) * 3 // 4])
            writing.flush()
            player = self.open("-", stdin=reading)
            self.press("h")
            self.quit(player)

    def test_loop_begins_again(self):
        player = self.open(TALK_FBS, "--from", "3", "--loop", "--record", "seen.y4m")
        last = self.decoded().pictures[round(3 * self.decoded().rate):]
        part = self.folder / "seen.y4m.part"
        wait_for(lambda: part.exists() and part.stat().st_size > (len(last) + 6) * len(last[0]), "second round")
        self.quit(player)
        seen = read_y4m(self.folder / "seen.y4m").pictures
        begin = 120 - len(last)
        self.assert_shows(seen[:len(last) + 3], (*range(begin, 120), *range(begin, begin + 3)))

    def test_damage_is_played_past(self):
        data = bytearray(TALK_FBS.read_bytes())
        data[len(data) * 4 // 5] ^= 255  # motion of the last second
        self.write("broken.fbs", data)
        player = self.open("broken.fbs", "--paused", "--record", "seen.y4m")
        self.press(*["Right"] * 30)
        self.quit(player)
        self.assertGreater(len(read_y4m(self.folder / "seen.y4m").pictures), 1)


class OnScreen(Play):
    def test_pause_holds_the_picture(self):
        self.needs_import()
        player = self.open(TALK_FBS, "--loop")
        first = self.screen.shot()
        wait_for(lambda: self.screen.shot() != first, "another picture")
        self.press("space")
        held = wait_for(lambda: (lambda a, b: a == b and a)(self.screen.shot(), self.screen.shot()), "still picture")
        time.sleep(0.5)
        self.assertTrue(self.screen.shot() == held)
        self.press("space")
        wait_for(lambda: self.screen.shot() != held, "another picture")
        self.quit(player)

    def test_help_is_shown_and_hidden(self):
        self.needs_import()
        player = self.open(TALK_FBS, "--paused")
        plain = wait_for(lambda: (lambda a, b: a == b and any(map(any, a)) and a)(self.screen.shot(), self.screen.shot()),
                         "picture")
        self.press("h")
        wait_for(lambda: self.screen.shot() != plain, "help")
        self.press("F1")
        wait_for(lambda: self.screen.shot() == plain, "picture without help")
        self.quit(player)

    def test_large_portrait_fits_the_screen_and_fills_it(self):
        self.needs_import()
        if not PORTRAIT.exists() or PORTRAIT.stat().st_mtime < FBS.stat().st_mtime:
            talker(self.folder / "portrait.y4m", "--size", "720x1280", "--frames", "3")
            self.succeed("encode", "portrait.y4m", "portrait.fbs", "--quiet", "--patterns", "1")
            shutil.copy(self.folder / "portrait.fbs", PORTRAIT)
        player = self.open(PORTRAIT, "--paused")
        left, top, width, height = self.geometry()
        self.assertTrue(left >= 0 and top >= 0 and left + width <= SCREEN[0] and top + height <= SCREEN[1])
        self.assertAlmostEqual(width / height, 720 / 1280, delta=0.01)
        self.press("i", "f")
        wait_for(lambda: self.geometry()[2:] == SCREEN, "full screen")

        def is_letterboxed():
            rows = self.screen.shot()
            bars = [row[:3 * 290] + row[-3 * 290:] for row in rows[20:-20]]
            middle = [row[3 * 305:3 * 720] for row in rows[20:-20]]
            return not any(map(any, bars)) and all(map(any, middle))
        wait_for(is_letterboxed, "picture in the middle, as high as the screen")
        self.press("Escape")
        wait_for(lambda: self.geometry()[2:] == (width, height), "the window as it was")
        self.quit(player)


class Refused(ProgramTest):
    def test_record_onto_the_stream(self):
        self.write("talk.y4m", TALK_FBS.read_bytes())
        self.fail_cleanly("play", "talk.y4m", "--record", "talk.y4m", says=["--record", "INPUT"])

    def test_record_in_an_unknown_format(self):
        self.fail_cleanly("play", TALK_FBS, "--record", "seen.avi", says=["seen.avi", ".mkv"])
        self.fail_cleanly("play", TALK_FBS, "--record", "-", says=["--record"])

    def test_source_that_is_not_there(self):
        self.fail_cleanly("play", TALK_FBS, "--source", "absent.mkv", says=["absent.mkv"])
