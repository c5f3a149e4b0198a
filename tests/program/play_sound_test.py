"""What `fbs play` lets be heard. SDL's disk driver writes it to a file at the speed at which it would be played; FBS_PLAY_TIMES
logs number and time of each picture, and what is heard when it is shown. Places are compared in samples; that the machine
is slow moves nothing. Skipped without Xvfb and xdotool."""
import array
import os
import shutil
import statistics
import subprocess
import time
import unittest

from harness import MATERIAL, ffmpeg, packets
from play_test import Play, wait_for
from speech import RATE, STEP, make_speech

SPEECH_FBS = MATERIAL / "speech.fbs"
SHORT_FBS = MATERIAL / "short_speech.fbs"
SOUND = 10      # packet type
PICTURES = 120  # of the talker, 30 a second


def envelope(samples):
    return [sum(map(abs, samples[k:k + STEP])) / STEP for k in range(0, len(samples) - STEP + 1, STEP)]


def place_of(part, whole):
    """Where in `whole` an envelope is found, and the correlation there."""
    def centred(values):
        mean = sum(values) / len(values)
        return [v - mean for v in values]
    part, best = centred(part), (-1, None)
    norm = sum(v * v for v in part)
    for k in range(len(whole) - len(part) + 1):
        other = centred(whole[k:k + len(part)])
        power = sum(v * v for v in other)
        if power > 0:
            best = max(best, (sum(a * b for a, b in zip(part, other)) / (norm * power) ** 0.5, k))
    return best[1], best[0]


def read_samples(path):
    return array.array("h", path.read_bytes()[: path.stat().st_size // 2 * 2])


class PlaySound(Play):
    def setUp(self):
        super().setUp()
        if not shutil.which("ffmpeg"):
            self.skipTest("ffmpeg is not installed")
        make_speech(SPEECH_FBS, 4, self.folder)
        self.heard_file, self.log = self.folder / "heard.raw", self.folder / "times"
        self.before = dict(self.screen.environment)
        self.screen.environment |= {"SDL_AUDIODRIVER": "disk", "SDL_DISKAUDIOFILE": str(self.heard_file),
                                    "FBS_PLAY_TIMES": str(self.log)}
        self.addCleanup(lambda: setattr(self.screen, "environment", self.before))

    def times(self):
        """(number, time of the picture, time of what is heard; in samples) of each picture shown with sound."""
        if not self.log.exists():
            return []
        return [tuple(map(int, line.split())) for line in self.log.read_text().splitlines(keepends=True)
                if line.endswith("\n")]

    def wait_for_picture(self, number, rows=0):
        wait_for(lambda: any(row[0] >= number for row in self.times()[rows:]), f"picture {number}")

    def heard(self):
        return read_samples(self.heard_file)

    def decoded_sound(self, stream=SPEECH_FBS):
        self.succeed("decode", stream, "decoded.wav", "--quiet")
        return array.array("h", (self.folder / "decoded.wav").read_bytes()[44:])

    def assert_in_step(self, rows, most=50):
        """Pictures with what is heard: half of them within `most` ms, which a machine that is slow now and then allows."""
        self.assertTrue(rows)
        self.assertLess(statistics.median(abs(shown - heard) for _, shown, heard in rows), most * RATE // 1000)

    def runs(self, samples, least=200):
        """(begin, end) of what lies between silences of `least` ms, which `bursts` has none of."""
        loud = [k for k, v in enumerate(envelope(samples)) if v > 20]
        found, begin = [], None
        for a, b in zip(loud, loud[1:] + [None]):
            begin = a if begin is None else begin
            if b is None or b - a > least:
                found.append((begin * STEP, (a + 1) * STEP))
                begin = None
        return found

    def place_in(self, whole, part):
        place, correlation = place_of(envelope(part), envelope(whole))
        self.assertGreater(correlation, 0.8)
        return place * STEP

    def test_all_of_the_sound_is_heard_with_its_pictures(self):
        player = self.open(SPEECH_FBS)
        self.wait_for_picture(PICTURES - 1)
        time.sleep(0.3)
        self.quit(player)
        sound, heard = self.decoded_sound().tobytes(), self.heard().tobytes()
        begin = heard.find(sound[:RATE])
        self.assertGreaterEqual(begin, 0)
        # As it was decoded, without a gap, up to the block in which the last picture ended.
        end = len(sound) - 2 * RATE // 10
        self.assertEqual(heard[begin:begin + end], sound[:end])
        rows = self.times()
        self.assertLess(rows[0][0], 3)
        self.assert_in_step(rows)

    def test_pause_goes_on_with_the_picture(self):
        player = self.open(SPEECH_FBS)
        self.wait_for_picture(40)
        self.press("space")
        time.sleep(0.5)
        before = len(self.times())
        self.press("space")
        self.wait_for_picture(100)
        self.quit(player)
        rows, heard, sound = self.times(), self.heard(), self.decoded_sound()
        (_, paused), (again, _) = self.runs(heard)[:2]
        place = self.place_in(sound, heard[again:again + RATE // 2])
        shown = rows[before - 1][1]
        self.assertLess(abs(place - shown), 0.04 * RATE)
        self.assert_in_step(rows[before:])
        # Nothing of what was decoded ahead is heard after the pause.
        self.assertLess(paused / RATE, rows[before - 1][2] / RATE + 1)

    def test_seek_and_step_are_followed(self):
        player = self.open(SPEECH_FBS, "--paused", "--from", "2")
        self.press("Right", "Right", "space")
        self.wait_for_picture(75)
        before = len(self.times())
        self.press("Down")  # five seconds back: to the beginning
        wait_for(lambda: any(row[0] < 10 for row in self.times()[before:]), "the beginning")
        self.wait_for_picture(30, len(self.times()))
        self.press("space")
        self.quit(player)
        rows, heard, sound = self.times(), self.heard(), self.decoded_sound()
        begin = self.runs(heard)[0][0]
        self.assertIn(rows[0][0], (62, 63))
        self.assertLess(abs(self.place_in(sound, heard[begin:begin + RATE // 3]) - rows[0][1]), 0.04 * RATE)
        back = next(k for k in range(1, len(rows)) if rows[k][0] < rows[k - 1][0])
        self.assertLess(rows[back][0], 10)
        self.assert_in_step(rows[:back])
        self.assert_in_step(rows[back:])
        place = heard.tobytes().find(sound[:RATE // 2].tobytes())
        self.assertGreater(place, 0, "the beginning is heard")

    def test_loop_is_heard_again(self):
        player = self.open(SPEECH_FBS, "--loop", "--from", "3")
        self.wait_for_picture(PICTURES - 1)
        before = len(self.times())
        wait_for(lambda: len({row[0] for row in self.times()[before:]}) > 5, "second round")
        time.sleep(0.4)
        self.quit(player)
        rows, heard = self.times(), self.heard()
        self.assertGreaterEqual(min(row[0] for row in rows), 89)
        self.assertTrue(any(b[0] < a[0] for a, b in zip(rows, rows[1:])))
        self.assert_in_step(rows)
        begin = self.runs(heard)[0][0]
        self.assertGreater(heard.tobytes().count(heard[begin + RATE // 20:begin + RATE // 4].tobytes()), 1)

    def test_pictures_follow_a_device_that_is_slow(self):
        self.screen.environment |= {"SDL_DISKAUDIODELAY": "40"}  # for blocks of 21 ms
        player = self.open(SPEECH_FBS)
        self.wait_for_picture(PICTURES - 1)
        self.quit(player)
        self.assert_in_step(self.times(), 60)

    def test_mute_is_silent_and_does_not_stop_the_clock(self):
        player = self.open(SPEECH_FBS)
        self.wait_for_picture(20)
        self.press("v")
        time.sleep(0.4)
        muted = max(row[0] for row in self.times())
        self.wait_for_picture(muted + 15)
        self.press("v")
        self.wait_for_picture(PICTURES - 5)
        self.quit(player)
        heard, sound = self.heard(), self.decoded_sound()
        first, second = self.runs(heard)[:2]
        self.assertGreater(second[0] - first[1], 0.3 * RATE)
        before = self.place_in(sound, heard[first[0]:first[1]]) - first[0]
        part = heard[second[0]:second[0] + RATE // 2]
        self.assertLess(abs(self.place_in(sound, part) - second[0] - before), 2 * STEP)
        self.assert_in_step(self.times())

    def test_volume_makes_it_softer(self):
        player = self.open(SPEECH_FBS, "--paused")
        self.press("minus", "minus", "minus", "space")
        self.wait_for_picture(60)
        self.quit(player)
        heard, sound = self.heard(), self.decoded_sound()
        begin = self.runs(heard)[0][0]
        part, whole = heard[begin:begin + RATE], sound[:RATE]
        share = sum(map(abs, part)) / sum(map(abs, whole))
        self.assertAlmostEqual(share, 0.49, delta=0.04)

    def test_pictures_go_on_behind_the_sound(self):
        make_speech(SHORT_FBS, 2, self.folder)
        player = self.open(SHORT_FBS)
        self.wait_for_picture(PICTURES - 1)
        self.quit(player)
        self.assert_in_step(self.times())
        self.assertGreater(self.times()[-1][2], 3.8 * RATE)

    def test_pipe_that_waits_leaves_a_pause_and_no_drift(self):
        ours, theirs = os.pipe()
        data = SPEECH_FBS.read_bytes()
        with os.fdopen(ours, "rb") as reading, os.fdopen(theirs, "wb") as writing:
            writing.write(data[:len(data) * 2 // 3])
            writing.flush()
            player = self.open("-", stdin=reading)
            wait_for(lambda: self.times() and (lambda n: time.sleep(0.5) or len(self.times()) == n)(len(self.times())),
                     "all that has come is shown")
            writing.write(data[len(data) * 2 // 3:])
            writing.close()
            self.wait_for_picture(PICTURES - 1)
            self.quit(player)
        self.assert_in_step(self.times(), 90)  # pictures of a pipe are 40 ms early
        heard, sound = self.heard(), self.decoded_sound()
        found = self.runs(heard)
        self.assertEqual(len(found), 2, "one pause")
        (a, b), (c, d) = found
        self.assertAlmostEqual((b - a) + (d - c), len(sound), delta=0.25 * RATE)
        for begin, end in ((a, b), (c, d)):
            part = heard[begin:min(end, begin + RATE // 2)]
            self.assertGreaterEqual(self.place_in(sound, part), 0)

    def test_damage_loses_no_time(self):
        data = bytearray(SPEECH_FBS.read_bytes())
        sounds = [(begin, end) for kind, begin, end in packets(data) if kind == SOUND]
        begin, end = sounds[len(sounds) // 2]
        data[(begin + end) // 2] ^= 255
        self.write("broken.fbs", data)
        # The sound is silent for the packet alone, and the end comes when it would.
        player = self.open("broken.fbs")
        self.wait_for_picture(PICTURES - 1)
        self.quit(player)
        rows = self.times()
        self.assert_in_step(rows)
        heard, sound = self.heard(), self.decoded_sound()
        runs = self.runs(heard)
        self.assertGreater(runs[0][1] - runs[0][0], 0.5 * RATE)
        self.assertEqual(len(runs), 2)
        silence = runs[1][0] - runs[0][1]
        self.assertGreater(silence, 0.5 * RATE)
        self.assertLess(silence, 1.5 * RATE)
        self.assertGreater(runs[1][1], len(sound) - 0.1 * RATE)

    def test_without_a_device_the_pictures_play_on(self):
        self.screen.environment |= {"SDL_DISKAUDIOFILE": str(self.folder / "absent" / "heard.raw")}
        player = self.open(SPEECH_FBS, "--record", "seen.mkv")
        part = self.folder / "seen.mkv.part"
        wait_for(part.exists, "recording")
        time.sleep(1)
        self.press("v", "minus")
        said = [line for line in self.quit(player).splitlines() if not line.startswith("CRITICAL")]
        self.assertEqual(len(said), 1, said)
        self.assertIn("audio device", said[0])
        self.assertIn("without sound", said[0])

    def test_no_sound_opens_no_device(self):
        player = self.open(SPEECH_FBS, "--no-sound", "--record", "seen.mkv")
        time.sleep(0.5)
        self.quit(player)
        self.assertFalse(self.heard_file.exists())
        done = subprocess.run(["ffprobe", "-v", "error", "-show_entries", "stream=codec_type", "-of", "csv=p=0", "seen.mkv"],
                              cwd=self.folder, check=True, capture_output=True, text=True)
        self.assertEqual(done.stdout.split(), ["video"])

    def test_recording_has_the_sound_of_its_pictures(self):
        for name in ("seen.mp4", "seen.mkv"):
            with self.subTest(name=name):
                self.log.unlink(missing_ok=True)
                player = self.open(SPEECH_FBS, "--paused", "--record", name)
                # Ten pictures without sound: the first, nine that are stepped to.
                self.press(*["Right"] * 9, "space")
                self.wait_for_picture(100)
                self.press("space", "m")  # and one after what was played
                self.quit(player)
                ffmpeg("-i", self.folder / name, "-ac", "1", "-ar", str(RATE), "-f", "s16le", self.folder / "seen.raw")
                seen, sound = read_samples(self.folder / "seen.raw"), self.decoded_sound()
                silent = 10 * RATE // 30
                self.assertLess(max(envelope(seen[:silent - 20 * STEP])), 20)
                for begin in (silent + RATE // 20, 2 * RATE):
                    place = self.place_in(sound, seen[begin:begin + RATE // 2])
                    self.assertLess(abs(place - begin), 0.02 * RATE)


if __name__ == "__main__":
    unittest.main()
