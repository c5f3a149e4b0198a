"""fbs remux: a stream into a Matroska file and out of it again, and what other programs make of that file."""
import json
import random
import re
import subprocess

from harness import (KEYED_FBS, MAX_SECONDS, SETUP, SOURCE, TALK_FBS, TALK_ONE_FBS, TALK_Y4M, TWO_SCENES_FBS,
                     ProgramTest, ffmpeg, packets)

VECTORS = SOURCE / "tests/vectors"
# Whatever is in a Matroska file, it has to say of what kind its pictures are.
WITHOUT_SETUP = {"no_setup.fbs", "removed_setup.fbs", "not_fbs.fbs", "newer.fbs", "oversized.fbs", "live_joined.fbs",
                 "live_timed_joined.fbs"}


def run(*command):
    return subprocess.run([str(word) for word in command], check=True, capture_output=True, timeout=MAX_SECONDS).stdout


class Remux(ProgramTest):
    def stream(self, name, source, *options):
        self.succeed("encode", source, name, "--quiet", *options)
        return self.folder / name

    def voiced_source(self, name="voiced.mkv", sound="sine=frequency=330:sample_rate=44100:duration=3.5"):
        """The talker with a sound that is shorter than the pictures."""
        ffmpeg("-i", TALK_Y4M, "-f", "lavfi", "-i", sound, "-c:v", "ffv1", "-c:a", "pcm_s16le", self.folder / name)
        return name

    def there_and_back(self, stream):
        """Remuxes; what comes back must be the same. Returns the Matroska file."""
        self.assertFalse(self.succeed("remux", stream, "made.mkv", "--quiet"))
        self.succeed("remux", "made.mkv", "back.fbs")
        self.assertEqual((self.folder / "back.fbs").read_bytes(), stream.read_bytes(), stream)
        return self.folder / "made.mkv"

    def tracks(self, file):
        report = json.loads(run("mkvmerge", "-J", file))
        self.assertFalse(report["errors"] + report["warnings"])
        return [(track["type"], track["properties"]["codec_id"]) for track in report["tracks"]]

    def test_streams_without_sound(self):
        for stream in (TALK_FBS, TALK_ONE_FBS, TWO_SCENES_FBS, KEYED_FBS):
            self.assertEqual(self.tracks(self.there_and_back(stream)), [("video", "V_FBS")])

    def test_streams_with_sound(self):
        source = self.voiced_source()
        for options in ((), ("--patterns", "1"), ("--key-interval", "0.7"), ("--live",)):
            made = self.there_and_back(self.stream("talk.fbs", source, *options))
            self.assertEqual(self.tracks(made), [("video", "V_FBS"), ("audio", "A_OPUS")], options)

    def test_sound_of_codec2_stays_inside(self):
        stream = self.stream("talk.fbs", self.voiced_source(), "--sound", "codec2")
        self.assertEqual(self.tracks(self.there_and_back(stream)), [("video", "V_FBS")])
        done = self.fbs("remux", stream, "made.mkv")
        self.assertRegex(done.stderr.decode(), r"\Afbs: made.mkv: the sound stays within[^\n]*\n\Z")

    def test_a_varying_rate(self):
        ffmpeg("-i", TALK_Y4M, "-vf", "setpts='(N+floor(N/3))/25/TB'", "-fps_mode", "vfr", "-c:v", "ffv1",
               self.folder / "slow.mkv")
        made = self.there_and_back(self.stream("talk.fbs", "slow.mkv"))
        self.assertNotIn(b"Default duration", run("mkvinfo", made))

    def test_every_vector(self):
        for vector in sorted(VECTORS.glob("*.fbs")):
            if vector.name in WITHOUT_SETUP:
                self.fail_cleanly("remux", vector, "no.mkv", says=[vector.name])
            else:
                self.there_and_back(vector)

    def test_through_pipes(self):
        made = self.there_and_back(TALK_FBS).read_bytes()
        self.succeed("remux", "-", "piped.mkv", stdin=TALK_FBS.read_bytes())
        self.assertEqual((self.folder / "piped.mkv").read_bytes(), made)
        self.assertEqual(self.succeed("remux", "made.mkv", "-"), TALK_FBS.read_bytes())
        self.assertEqual(self.succeed("remux", TALK_FBS, "-"), (self.folder / "made.mkv").read_bytes())

    def test_other_verbs_read_it(self):
        stream = self.stream("talk.fbs", self.voiced_source(), "--key-interval", "0.7")
        self.there_and_back(stream)
        verbs = (("decode", "%", "--md5"), ("decode", "%", "--md5", "--from", "1.5"), ("inspect", "%", "--packets", "--json"),
                 ("export", "%", "-"), ("retarget", "--motion", "%", "--face", "%", "-", "--quiet"),
                 ("evaluate", TALK_Y4M, "%", "--json", "--quiet"))
        for verb in verbs:
            with_name = lambda name: [name if word == "%" else word for word in verb]
            of_stream, of_file = (self.succeed(*with_name(name)) for name in ("talk.fbs", "made.mkv"))
            self.assertEqual(of_file.replace(b"made.mkv", b"talk.fbs"), of_stream, verb)
        self.succeed("decode", "talk.fbs", "a.wav")
        self.succeed("decode", "made.mkv", "b.wav")
        self.assertEqual((self.folder / "a.wav").read_bytes(), (self.folder / "b.wav").read_bytes())

    def test_times_as_others_see_them(self):
        stream = self.stream("talk.fbs", self.voiced_source(), "--key-interval", "0.7")
        made = self.there_and_back(stream)
        shown = json.loads(run("ffprobe", "-v", "fatal", "-show_packets", "-show_streams", "-show_format", "-of", "json", made))
        seconds = json.loads(self.succeed("inspect", stream, "--json"))["seconds"]
        self.assertAlmostEqual(float(shown["format"]["duration"]), seconds, delta=0.07)
        video, sound = ([p for p in shown["packets"] if p["codec_type"] == kind] for kind in ("video", "audio"))
        setups = [p["seconds"] for p in json.loads(self.succeed("inspect", stream, "--packets", "--json"))["packets"]
                  if p["type"] == "setup"]
        keys = [float(p["pts_time"]) for p in video if p["flags"].startswith("K")]
        self.assertEqual(len(keys), len(setups))
        for key, setup in zip(keys, setups):
            self.assertAlmostEqual(key, setup, delta=0.0001)
        end = 0
        for block in video:
            self.assertAlmostEqual(float(block["pts_time"]), end, delta=0.0002)
            end = float(block["pts_time"]) + float(block["duration_time"])
        self.assertAlmostEqual(end, seconds, delta=0.0002)
        steps = {round(float(b["pts_time"]) - float(a["pts_time"]), 4) for a, b in zip(sound, sound[1:])}
        self.assertEqual(len(steps), 1)
        self.assertAlmostEqual(float(sound[0]["pts_time"]), -0.0065, delta=0.0001, msg="libopus begins so much ahead")
        self.assertEqual([shown["streams"][0][side] for side in ("width", "height")], [176, 144])

    def test_cues_lead_to_key_blocks(self):
        made = self.there_and_back(KEYED_FBS)
        data, report = made.read_bytes(), run("mkvinfo", "--continue", "-P", "-v", "-v", made).decode()
        segment = int(re.search(r"\+ Segment: size \d+ at (\d+)", report)[1]) + 12  # ID and size
        cues = re.findall(r"Cue time: \S+ at.*?Cue cluster position: (\d+)", report, re.DOTALL)
        scenes = [p for p in packets(KEYED_FBS.read_bytes()) if p[0] == SETUP]
        self.assertEqual(len(cues), len(scenes))
        self.assertGreater(len(cues), 3)
        for cue, (_, begin, end) in zip(cues, scenes):
            at = segment + int(cue)
            self.assertEqual(data[at:at + 4], b"\x1f\x43\xb6\x75", "no cluster")
            self.assertIn(KEYED_FBS.read_bytes()[begin:end], data[at:at + 60 + end - begin])

    def test_others_play_the_sound_in_step(self):
        """Bursts of a tone begin when they do in the source."""
        sound = "aevalsrc='sin(2*PI*440*t)*lt(mod(t\\,1)\\,0.2)*gt(t\\,0.5)':s=48000:d=4"
        self.there_and_back(self.stream("talk.fbs", self.voiced_source(sound=sound)))
        raw = run("ffmpeg", "-v", "error", "-i", self.folder / "made.mkv", "-vn", "-ac", "1", "-ar", "8000", "-f", "s16le", "-")
        samples = memoryview(raw).cast("h")
        for second in (1, 2, 3):
            begin = next(t for t in range(second * 8000 - 800, second * 8000 + 800) if abs(samples[t]) > 1500)
            self.assertAlmostEqual(begin / 8000, second, delta=0.01)

    def test_mkvmerge_keeps_it(self):
        stream = self.stream("talk.fbs", self.voiced_source(), "--key-interval", "0.7")
        made = self.there_and_back(stream)
        run("mkvmerge", "-q", "-o", self.folder / "merged.mkv", made)
        self.assertEqual(self.succeed("remux", "merged.mkv", "-"), stream.read_bytes())

    def test_a_part_of_it_is_in_step(self):
        """mkvmerge counts the times of each part from zero."""
        stream = self.stream("talk.fbs", self.voiced_source(), "--key-interval", "0.7")
        run("mkvmerge", "-q", "--split", "timestamps:2s", "-o", self.folder / "part-%02d.mkv", self.there_and_back(stream))
        listed = json.loads(self.succeed("inspect", "part-02.mkv", "--packets", "--json"))["packets"]
        begin = next(p["seconds"] for p in listed if p["type"] == "setup")
        self.assertGreater(begin, 1)
        whole = json.loads(self.succeed("inspect", stream, "--packets", "--json"))["packets"]
        sound = [[p["seconds"] for p in packets if p["type"] == "sound"] for packets in (listed, whole)]
        self.assertAlmostEqual(sound[0][-1], sound[1][-1], delta=0.06)
        self.assertAlmostEqual(sound[0][0], begin, delta=0.13)

    def test_other_tracks_are_named(self):
        made = self.there_and_back(TALK_FBS)
        ffmpeg("-f", "lavfi", "-i", "sine=duration=1", "-c:a", "flac", self.folder / "tone.mka")
        run("mkvmerge", "-q", "-o", self.folder / "both.mkv", made, self.folder / "tone.mka")
        done = self.fbs("remux", "both.mkv", "out.fbs")
        self.assertEqual((done.returncode, done.stderr.decode()), (0, "fbs: both.mkv: a track of A_FLAC is left out\n"))
        self.assertEqual((self.folder / "out.fbs").read_bytes(), TALK_FBS.read_bytes())

    def test_a_sound_from_elsewhere(self):
        """Any Opus beside the video is its sound."""
        made = self.there_and_back(TALK_FBS)
        ffmpeg("-f", "lavfi", "-i", "sine=duration=4", "-c:a", "libopus", "-ac", "1", "-b:a", "16k", self.folder / "tone.mka")
        run("mkvmerge", "-q", "-o", self.folder / "both.mkv", made, self.folder / "tone.mka")
        self.succeed("remux", "both.mkv", "out.fbs")
        self.assertGreater(json.loads(self.succeed("inspect", "out.fbs", "--json"))["bytes"]["sound"], 1000)
        self.assertEqual(self.succeed("decode", "out.fbs", "--md5"), self.succeed("decode", TALK_FBS, "--md5"))
        self.there_and_back(self.folder / "out.fbs")

    def test_wrong_uses_are_refused(self):
        made = self.there_and_back(TALK_FBS).name
        (self.folder / "talk.fbs").write_bytes(TALK_FBS.read_bytes())
        self.fail_cleanly("remux", "talk.fbs", "talk.webm", says=["talk.webm", ".mkv"])
        self.fail_cleanly("remux", "talk.fbs", "other.fbs", says=["talk.fbs", "not a Matroska file"])
        self.fail_cleanly("remux", made, "other.mkv", says=[made, "already"])
        self.fail_cleanly("remux", made, made, says=["same file"])
        self.fail_cleanly("remux", "none.fbs", "other.mkv", says=["none.fbs", "cannot open"])
        self.fail_cleanly("remux", TALK_Y4M, "other.mkv", says=["not an fbs stream"])
        self.fail_cleanly("remux", self.voiced_source(), "other.fbs", says=["without fbs video"])
        self.fail_cleanly("encode", made, "other.fbs", says=[made, "is an fbs stream"])

    def test_cut_and_damaged_files(self):
        data = self.there_and_back(self.stream("talk.fbs", self.voiced_source())).read_bytes()
        for size in (4, 30, 200, 700, len(data) // 2, len(data) - 1):
            self.write("cut.mkv", data[:size])
            self.fail_cleanly("remux", "cut.mkv", "no.fbs", says=["cut.mkv"])
        chance = random.Random(4)
        for _ in range(60):
            wrong = bytearray(data)
            for _ in range(chance.randrange(1, 5)):
                wrong[chance.randrange(len(wrong))] = chance.randrange(256)
            self.write("wrong.mkv", wrong)
            for verb in (("remux", "wrong.mkv", "out.fbs"), ("decode", "wrong.mkv", "--md5")):
                done = self.fbs(*verb)
                self.assertIn(done.returncode, (0, 2), done.stderr)
                if done.returncode == 2:
                    self.assertRegex(done.stderr.decode(errors="replace"), r"\Afbs: [^\n]*wrong.mkv[^\n]+\n\Z")
