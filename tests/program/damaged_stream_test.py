"""Every intact packet of a damaged stream still decodes, and the damage is reported with its position."""
from harness import FAILED, MOTION, TALK_FBS, ProgramTest, Y4m, packets


class DamagedStream(ProgramTest):
    def setUp(self):
        super().setUp()
        self.stream = TALK_FBS.read_bytes()
        self.motion = [packet for packet in packets(self.stream) if packet[0] == MOTION]
        self.whole = self.decoded()
        self.assertGreaterEqual(len(self.motion), 3, "too few groups to test with")

    def keep_going(self, stream):
        """Decodes as much as possible. Returns the pictures and the messages."""
        self.write("bad.fbs", stream)
        done = self.fbs("decode", "bad.fbs", "-", "--keep-going")
        self.assertEqual(done.returncode, 0, done.stderr)
        return Y4m(done.stdout).pictures, done.stderr.decode()

    def damaged(self, packet):
        """The stream with one byte inside `packet` changed."""
        _, begin, end = packet
        stream = bytearray(self.stream)
        stream[(begin + end) // 2] ^= 0x55
        return bytes(stream)

    def test_packets_cover_the_stream(self):
        ends = [4] + [end for _, _, end in packets(self.stream)]
        self.assertEqual(ends[:-1], [begin for _, begin, _ in packets(self.stream)])
        self.assertEqual(ends[-1], len(self.stream))

    def test_cut_stream_shows_the_whole_groups(self):
        shown = 0
        for _, begin, end in self.motion[1:]:
            for cut in (begin + 1, end - 1):
                pictures, report = self.keep_going(self.stream[:cut])
                self.assertEqual(pictures, self.whole.pictures[:len(pictures)], "not the pictures of the whole stream")
                self.assertIn(f"bad.fbs: stream ends inside a packet (at byte {begin})", report)
            self.assertGreater(len(pictures), shown, "a whole group is missing")
            shown = len(pictures)

    def test_stream_without_its_end_packet_shows_all(self):
        pictures, _ = self.keep_going(self.stream[:self.motion[-1][2]] + b"\x06")
        self.assertEqual(pictures, self.whole.pictures)

    def test_cut_at_every_byte_of_a_group_is_reported(self):
        _, begin, end = self.motion[-1]
        for cut in range(begin + 1, end):
            self.write("bad.fbs", self.stream[:cut])
            done = self.fbs("decode", "bad.fbs", "null:")
            self.assertEqual(done.returncode, FAILED, cut)
            self.assertIn(f"(at byte {begin})".encode(), done.stderr)

    def test_damaged_group_is_reported_and_those_before_it_shown(self):
        for packet in self.motion[1:]:
            stream = self.damaged(packet)
            pictures, report = self.keep_going(stream)
            self.assertEqual(pictures[:1], self.whole.pictures[:1])
            self.assertIn(f"bad.fbs: packet is damaged (at byte {packet[1]})", report)
            self.assertIn(f"{len(self.whole.pictures) - len(pictures)} of {len(self.whole.pictures)} pictures missing", report)

    def test_damage_without_keep_going_leaves_nothing(self):
        for packet in packets(self.stream):
            self.write("bad.fbs", self.damaged(packet))
            self.fail_cleanly("decode", "bad.fbs", "out.y4m", says=["bad.fbs", f"at byte {packet[1]}"])

    def test_any_changed_byte_ends_well(self):
        for at in range(0, len(self.stream), max(len(self.stream) // 60, 1)):
            stream = bytearray(self.stream)
            stream[at] ^= 0xFF
            self.write("bad.fbs", bytes(stream))
            done = self.fbs("decode", "bad.fbs", "null:", "--keep-going")
            self.assertIn(done.returncode, (0, FAILED), f"byte {at}")
            self.assertTrue(done.stderr, f"byte {at}: not noticed")

    def test_doubled_and_dropped_groups_end_well(self):
        _, begin, end = self.motion[1]
        group = self.stream[begin:end]
        for stream in (self.stream[:end] + group + self.stream[end:], self.stream[:begin] + self.stream[end:],
                       self.stream + self.stream[4:], self.stream + self.stream):
            self.write("bad.fbs", stream)
            self.assertIn(self.fbs("decode", "bad.fbs", "null:", "--keep-going").returncode, (0, FAILED))
