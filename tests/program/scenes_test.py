"""Streams of several scenes: joined in the middle, begun at a time, damaged in one."""
import json

from harness import (GREY_FIRST, LITTLE_LOST, MOTION, MUCH_LOST, RETURN, SETUP, TALK_FBS, TALK_Y4M, TWO_SCENES_FBS,
                     ProgramTest, Y4m, ffmpeg, ffprobe, packets, read_y4m, talker)

FIRST, ALL = GREY_FIRST, 187  # pictures: the encoder finds the cut


class Scenes(ProgramTest):
    def setUp(self):
        super().setUp()
        self.path = TWO_SCENES_FBS
        self.stream = self.path.read_bytes()
        self.whole = self.decoded(self.path).pictures
        self.assertEqual(len(self.whole), ALL)
        self.setups = [begin for kind, begin, _ in packets(self.stream) if kind == SETUP]

    def test_scenes_are_listed(self):
        scenes = json.loads(self.succeed("inspect", self.path, "--json"))["scenes"]
        self.assertEqual([(s["picture"], s["seconds"], s["face"], s["offset"]) for s in scenes],
                         [(0, 0, False, 4), (FIRST, FIRST / 30, True, self.setups[1])])
        self.assertEqual(scenes[0]["bytes"], self.setups[1] - 4)
        text = self.succeed("inspect", self.path).decode()
        self.assertIn("scenes", text)
        self.assertEqual(len(json.loads(self.succeed("inspect", TALK_FBS, "--json"))["scenes"]), 1)

    def test_begins_at_any_time(self):
        for seconds, first in ((0, 0), (0.01, 0), (0.0334, 1), (0.3, 9), (FIRST / 30, FIRST), (2, 60), (6.22, ALL - 1)):
            out = self.succeed("decode", self.path, "-", "--from", seconds)
            self.assertEqual(Y4m(out).pictures, self.whole[first:], seconds)

    def test_begins_at_a_time_of_a_pipe(self):
        out = self.succeed("decode", "-", "-", "--from", 3, stdin=self.stream)
        self.assertEqual(Y4m(out).pictures, self.whole[90:])

    def test_skipped_scenes_are_not_read(self):
        damaged = bytearray(self.stream)
        damaged[self.setups[0] + 30] ^= 3
        self.write("bad.fbs", bytes(damaged))
        out = self.succeed("decode", "bad.fbs", "-", "--from", 1)
        self.assertEqual(Y4m(out).pictures, self.whole[30:])

    def test_sound_begins_with_the_pictures(self):
        ffmpeg("-f", "lavfi", "-i", "sine=duration=8", str(self.folder / "tone.wav"))
        self.succeed("decode", self.path, "out.mkv", "--from", 3, "--sound", "tone.wav")
        for streams in ("v", "a"):
            found = ffprobe(self.folder / "out.mkv", "packet=pts_time", "-select_streams", streams)["packets"]
            times = sorted(float(packet["pts_time"]) for packet in found)
            self.assertLess(abs(times[0]), 0.1, streams)
            self.assertLess(abs(times[-1] - (ALL - 91) / 30), 0.15, streams)

    def test_joined_stream_begins_with_its_own_time(self):
        self.write("joined.fbs", self.stream[:4] + self.stream[self.setups[1]:])
        self.assertEqual(self.decoded("joined.fbs").pictures, self.whole[FIRST:])
        scene = json.loads(self.succeed("inspect", "joined.fbs", "--json"))["scenes"][0]
        self.assertEqual((scene["picture"], scene["offset"]), (FIRST, 4))
        out = self.succeed("decode", "joined.fbs", "-", "--from", 3)
        self.assertEqual(Y4m(out).pictures, self.whole[90:], "the same time as in the whole stream")

    def test_damaged_scene_is_held_up_to_the_next(self):
        motion = [begin for kind, begin, _ in packets(self.stream) if kind == MOTION and begin < self.setups[1]]
        damaged = bytearray(self.stream)
        damaged[motion[1] + 3] ^= 3
        self.write("bad.fbs", bytes(damaged))
        self.fail_cleanly("decode", "bad.fbs", "out.y4m", says=["bad.fbs", f"at byte {motion[1]}"])
        done = self.fbs("decode", "bad.fbs", "-", "--keep-going")
        self.assertEqual(done.returncode, LITTLE_LOST)
        self.assertEqual(Y4m(done.stdout).pictures, [self.whole[0]] * FIRST + self.whole[FIRST:])
        self.assertIn(f"damaged places: 1; pictures lost: {FIRST - 1} of {ALL}, held: {FIRST - 1}".encode(), done.stderr)

    def test_removed_packet_costs_its_scene_alone(self):
        first_motion = next(begin for kind, begin, _ in packets(self.stream) if kind == MOTION)
        for kind, begin, end in packets(self.stream):
            if begin >= self.setups[1]:
                break
            before = [self.whole[0]] * FIRST if kind == MOTION and begin > first_motion else []
            self.write("bad.fbs", self.stream[:begin] + self.stream[end:])
            self.fail_cleanly("decode", "bad.fbs", "out.y4m", says=["bad.fbs", f"at byte {begin}"])
            done = self.fbs("decode", "bad.fbs", "-", "--keep-going")
            self.assertEqual(done.returncode, LITTLE_LOST)
            self.assertEqual(Y4m(done.stdout).pictures, before + self.whole[FIRST:])

    def test_removed_setup_costs_its_scene(self):
        _, begin, end = next(packet for packet in packets(self.stream) if packet[1] == self.setups[1])
        self.write("bad.fbs", self.stream[:begin] + self.stream[end:])
        self.fail_cleanly("decode", "bad.fbs", "out.y4m", says=["bad.fbs", f"at byte {begin}"])
        done = self.fbs("decode", "bad.fbs", "-", "--keep-going")
        self.assertEqual(done.returncode, MUCH_LOST)
        self.assertEqual(Y4m(done.stdout).pictures, self.whole[:FIRST] + [self.whole[FIRST - 1]] * (ALL - FIRST))
        lost = ALL - FIRST
        self.assertIn(f"damaged places: 1; pictures lost: {lost} of {ALL}, held: {lost}".encode(), done.stderr)

    def test_lost_beginning_leaves_a_gap(self):
        damaged = bytearray(self.stream)
        damaged[self.setups[0] + 5] ^= 3
        self.write("bad.fbs", bytes(damaged))
        done = self.fbs("decode", "bad.fbs", "out.mkv", "--keep-going")
        self.assertEqual(done.returncode, LITTLE_LOST)
        self.assertIn(f"pictures lost: {FIRST} of {ALL}, held: 0".encode(), done.stderr)
        times = [float(packet["pts_time"]) for packet in ffprobe(self.folder / "out.mkv", "packet=pts_time")["packets"]]
        self.assertAlmostEqual(min(times), FIRST / 30, delta=0.002)


class Conversation(ProgramTest):
    """Two talkers who take turns of 40 pictures, as in an interview that is cut from one to the other."""
    TURN, TURNS = 40, 5

    def setUp(self):
        super().setUp()
        talker(self.folder / "other.y4m", "--size", "176x144", "--frames", "80", "--eye-distance", "0.25", "--seed", "6")
        people = [read_y4m(path) for path in (TALK_Y4M, self.folder / "other.y4m")]
        frames = [people[turn % 2].pictures[turn // 2 * self.TURN + k] for turn in range(self.TURNS) for k in range(self.TURN)]
        header = TALK_Y4M.read_bytes().partition(b"\n")[0]
        self.write("talk.y4m", header + b"\n" + b"".join(b"FRAME\n" + frame for frame in frames))
        self.succeed("encode", "talk.y4m", "talk.fbs", "--quiet", "--effort", "1")
        self.stream = (self.folder / "talk.fbs").read_bytes()
        self.whole = self.decoded("talk.fbs").pictures
        self.assertEqual(len(self.whole), self.TURN * self.TURNS)

    def test_returns_instead_of_beginning_anew(self):
        kinds = [kind for kind, _, _ in packets(self.stream)]
        self.assertEqual((kinds.count(SETUP), kinds.count(RETURN)), (2, self.TURNS - 2))
        scenes = json.loads(self.succeed("inspect", "talk.fbs", "--json"))["scenes"]
        self.assertEqual([s["picture"] for s in scenes], list(range(0, self.TURN * self.TURNS, self.TURN)))
        self.succeed("encode", "talk.y4m", "anew.fbs", "--quiet", "--effort", "1", "--key-interval", "60")
        anew = (self.folder / "anew.fbs").read_bytes()
        self.assertNotIn(RETURN, [kind for kind, _, _ in packets(anew)], "whoever joins knows no scene before")
        self.assertLess(len(self.stream), 0.8 * len(anew))

    def test_conversation_begins_at_any_time(self):
        for first in (10, 55, 100, 190):
            out = self.succeed("decode", "talk.fbs", "-", "--from", first / 30)
            self.assertEqual(Y4m(out).pictures, self.whole[first:], first)

    def test_conversation_goes_through_matroska(self):
        self.succeed("remux", "talk.fbs", "talk.mkv")
        self.succeed("remux", "talk.mkv", "back.fbs")
        self.assertEqual((self.folder / "back.fbs").read_bytes(), self.stream)
        self.assertEqual(self.decoded("talk.mkv").pictures, self.whole)

    def test_lost_return_costs_its_turn(self):
        _, begin, end = [packet for packet in packets(self.stream) if packet[0] == RETURN][1]
        self.write("bad.fbs", self.stream[:begin] + self.stream[end:])
        done = self.fbs("decode", "bad.fbs", "-", "--keep-going")
        self.assertEqual(done.returncode, MUCH_LOST)
        shown, first = Y4m(done.stdout).pictures, 3 * self.TURN
        self.assertEqual(shown, self.whole[:first] + [self.whole[first - 1]] * self.TURN + self.whole[first + self.TURN:])
