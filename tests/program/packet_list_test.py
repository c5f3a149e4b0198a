"""fbs inspect --packets: every packet of a stream, and where it is damaged."""
import json

from harness import (BLEND, END, FAILED, LITTLE_LOST, MOTION, PATTERN, RETURN, SETUP, SOURCE, SURROUND, TALK_FBS,
                     TALK_ONE_FBS, TWO_SCENES_FBS, UNIT, ProgramTest, packets)

NAMES = {SETUP: "setup", 2: "geometry", SURROUND: "surround", PATTERN: "pattern", MOTION: "motion", END: "end",
         BLEND: "blend", UNIT: "unit", RETURN: "return"}
VECTORS = SOURCE / "tests/vectors"
# Wrong only in their AV1 data, which is not decoded.
WRONG_FRAMES = {"bad_av1.fbs", "wrong_size.fbs", "two_frames.fbs", "show_existing.fbs"}


class PacketList(ProgramTest):
    def listed(self, stream, code=0):
        done = self.fbs("inspect", stream, "--packets", "--json")
        self.assertEqual(done.returncode, code, done.stderr)
        self.assertFalse(done.stderr)
        return json.loads(done.stdout)["packets"]

    def test_every_packet_is_listed(self):
        for stream in (TALK_FBS, TALK_ONE_FBS, TWO_SCENES_FBS):
            listed = self.listed(stream)
            self.assertEqual([(p["type"], p["offset"], p["offset"] + p["bytes"]) for p in listed],
                             [(NAMES[kind], begin, end) for kind, begin, end in packets(stream.read_bytes())])
            for packet in listed:
                self.assertNotIn("error", packet)

    def test_times_are_those_of_the_pictures(self):
        for stream in (TALK_FBS, TALK_ONE_FBS, TWO_SCENES_FBS):
            listed, report = self.listed(stream), json.loads(self.succeed("inspect", stream, "--json"))
            of_kind = lambda kind: [p["seconds"] for p in listed if p["type"] == kind]
            self.assertEqual(of_kind("setup"), [scene["seconds"] for scene in report["scenes"]])
            self.assertAlmostEqual(of_kind("end")[0], report["seconds"], places=4)
            for kind in ("motion", "blend"):
                self.assertEqual(of_kind(kind), sorted(of_kind(kind)))
            first_of_packet = {round(p["seconds"], 3) for p in report["patterns"]}
            for seconds in of_kind("pattern"):
                self.assertIn(round(seconds, 3), first_of_packet)

    def test_keys_are_where_a_scene_begins(self):
        listed = self.listed(TALK_ONE_FBS)
        for kind in ("setup", "pattern", "motion"):
            self.assertTrue(next(p for p in listed if p["type"] == kind)["key"], kind)
        self.assertFalse([p for p in listed if p["type"] == "pattern"][1:])
        self.assertFalse(any(p["key"] for p in listed if p["type"] == "geometry"))

    def test_agrees_with_the_decoder_about_every_vector(self):
        rows = [line.split() for line in (VECTORS / "vectors.txt").read_text().splitlines() if line[:1] not in ("", "#")]
        self.assertGreater(len(rows), 40)
        for name, error, *_ in rows:
            with self.subTest(name):
                if name == "not_fbs.fbs":
                    self.fail_cleanly("inspect", VECTORS / name, "--packets", says=["not an fbs stream"])
                    continue
                whole = error == "-" or name in WRONG_FRAMES
                listed = self.listed(VECTORS / name, 0 if whole else LITTLE_LOST)
                self.assertEqual(any("error" in p for p in listed), not whole)
                # A stream that was joined in the middle has no signature.
                at = 4 if (VECTORS / name).read_bytes().startswith(b"\x89fbs") else 0
                for packet in listed:
                    self.assertEqual(packet["offset"], at)
                    at += packet["bytes"]
                self.assertEqual(at, (VECTORS / name).stat().st_size)

    def test_goes_on_past_damage(self):
        stream = bytearray(TWO_SCENES_FBS.read_bytes())
        whole = self.listed(TWO_SCENES_FBS)
        second = [p for p in whole if p["type"] == "setup"][1]
        bad = next(p for p in whole if p["type"] == "motion")
        stream[bad["offset"] + 3] ^= 0x55
        self.write("bad.fbs", bytes(stream))
        listed = self.listed("bad.fbs", LITTLE_LOST)
        self.assertEqual(listed[listed.index(second):], whole[whole.index(second):])
        damage = next(p for p in listed if p["type"] == "damage")
        self.assertEqual((damage["type"], damage["offset"], damage["offset"] + damage["bytes"], damage["seconds"]),
                         ("damage", bad["offset"], bad["offset"] + bad["bytes"], None))
        self.assertIn("damaged", damage["error"])

    def test_marks_packets_that_were_repaired(self):
        stream = bytearray(TALK_FBS.read_bytes())
        _, begin, end = packets(stream)[3]
        stream[(begin + end) // 2] ^= 1
        self.write("bit.fbs", bytes(stream))
        self.assertEqual([k for k, p in enumerate(self.listed("bit.fbs")) if p.get("repaired")], [3])
        self.assertIn(b"one wrong bit set right", self.succeed("inspect", "bit.fbs", "--packets"))

    def test_text_has_a_line_for_each_packet(self):
        stream = TALK_FBS.read_bytes()
        found = packets(stream)
        lines = self.succeed("inspect", TALK_FBS, "--packets").decode().splitlines()
        self.assertEqual(lines[0], f"{TALK_FBS}: {len(found)} packets")
        self.assertEqual(len(lines), 2 + len(found))
        for line, (kind, begin, end) in zip(lines[2:], found):
            fields = line.split()
            self.assertEqual((fields[0], fields[1], fields[-1]), (str(begin), NAMES[kind], str(end - begin)))

    def test_text_says_where_the_damage_is(self):
        stream = TALK_FBS.read_bytes()
        _, begin, _ = packets(stream)[-2]
        self.write("cut.fbs", stream[:begin + 2])
        done = self.fbs("inspect", "cut.fbs", "--packets")
        self.assertEqual((done.returncode, done.stderr), (LITTLE_LOST, b""))
        self.assertRegex(done.stdout.decode().splitlines()[-1], rf"^ +{begin}  damage +- +2  stream ends inside a packet$")

    def test_reads_a_pipe(self):
        self.assertEqual(self.succeed("inspect", "-", "--packets", "--json", stdin=TALK_FBS.read_bytes()),
                         self.succeed("inspect", TALK_FBS, "--packets", "--json"))

    def test_stream_without_packets_is_refused(self):
        for content in (b"", b"\x89fbs", b"\x89fb", b"nothing"):
            self.write("empty.fbs", content)
            self.assertEqual(self.fbs("inspect", "empty.fbs", "--packets").returncode, FAILED, content)
            self.fail_cleanly("inspect", "empty.fbs", "--packets", says=["empty.fbs"])
