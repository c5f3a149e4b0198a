"""Every intact packet of a damaged stream still decodes, and the damage is reported with its position."""
from harness import (BLEND, FAILED, LITTLE_LOST, MOTION, MUCH_LOST, PATTERN, TALK_FBS, TALK_ONE_FBS, ProgramTest, Y4m,
                     packets)

DAMAGED = "packet is damaged, or its scene has lost its head"


class DamagedStream(ProgramTest):
    def setUp(self):
        super().setUp()
        self.use(TALK_FBS)

    def use(self, stream):
        """Tests go on with another stream."""
        self.stream = stream.read_bytes()
        self.whole = self.decoded(stream)
        self.motion = self.of_kind(MOTION)
        self.showing = self.of_kind(BLEND) or self.motion  # each brings the pictures of a group to the screen
        self.assertGreaterEqual(len(self.showing), 3, "too few groups to test with")

    def of_kind(self, kind):
        return [packet for packet in packets(self.stream) if packet[0] == kind]

    def of_each_kind_of_stream(self):
        for stream in (TALK_FBS, TALK_ONE_FBS):
            print(stream.name)
            self.use(stream)
            yield

    def keep_going(self, stream, code=LITTLE_LOST):
        """Decodes as much as possible. Returns the pictures and the messages."""
        self.write("bad.fbs", stream)
        done = self.fbs("decode", "bad.fbs", "-", "--keep-going")
        self.assertEqual(done.returncode, code, done.stderr)
        return Y4m(done.stdout).pictures if done.stdout else [], done.stderr.decode()

    def damaged(self, packet):
        """The stream with one byte inside `packet` changed."""
        _, begin, end = packet
        stream = bytearray(self.stream)
        stream[(begin + end) // 2] ^= 0x55
        return bytes(stream)

    def expect_the_rest_held(self, stream, at, message):
        """Expects of a stream that is damaged at byte `at`: the pictures before that, the last of them up to the end, one
        message with that byte, and a sum of what is lost."""
        before, _ = self.keep_going(self.stream[:at])
        missing = len(self.whole.pictures) - len(before)
        self.assertGreater(missing, 0)
        pictures, report = self.keep_going(stream, MUCH_LOST if missing >= 12 else LITTLE_LOST)
        self.assertEqual(pictures, before + [before[-1]] * missing, "the last is not held")
        self.assertIn(f"bad.fbs: {message} (at byte {at})", report)
        self.assertIn(f"damaged places: 1; pictures lost: {missing} of 120, held: {missing}, interpolated: 0", report)

    def expect_noticed(self, stream, at, *messages):
        """Expects of a stream in which something is wrong at byte `at`: the pictures before that, as many as in the whole
        stream, and one of the messages."""
        before, _ = self.keep_going(self.stream[:at])
        self.write("bad.fbs", stream)
        done = self.fbs("decode", "bad.fbs", "-", "--keep-going")
        self.assertIn(done.returncode, (LITTLE_LOST, MUCH_LOST), done.stderr)
        pictures = Y4m(done.stdout).pictures
        self.assertEqual(len(pictures), len(self.whole.pictures))
        self.assertEqual(pictures[:len(before)], before)
        self.assertTrue(any(message in done.stderr.decode() for message in messages), done.stderr)
        self.assertIn(b"damaged places: 1;", done.stderr)

    def test_packets_cover_the_stream(self):
        ends = [4] + [end for _, _, end in packets(self.stream)]
        self.assertEqual(ends[:-1], [begin for _, begin, _ in packets(self.stream)])
        self.assertEqual(ends[-1], len(self.stream))

    def test_cut_stream_shows_the_whole_groups(self):
        for _ in self.of_each_kind_of_stream():
            shown = 0
            for _, begin, end in self.showing[1:]:
                for cut in (begin + 1, end - 1):
                    pictures, report = self.keep_going(self.stream[:cut])
                    self.assertEqual(pictures, self.whole.pictures[:len(pictures)], "not the pictures of the whole stream")
                    self.assertIn(f"bad.fbs: stream ends inside a packet (at byte {begin})", report)
                self.assertGreater(len(pictures), shown, "a whole group is missing")
                shown = len(pictures)
                pictures, report = self.keep_going(self.stream[:end])
                self.assertEqual(pictures, self.whole.pictures[:len(pictures)], "not the pictures of the whole stream")
                self.assertGreater(len(pictures), shown, "the group is not shown as soon as it is there")

    def test_stream_without_its_end_packet_shows_all(self):
        for _ in self.of_each_kind_of_stream():
            for end in (b"", b"\x06"):
                pictures, report = self.keep_going(self.stream[:self.showing[-1][2]] + end)
                self.assertEqual(pictures, self.whole.pictures)
                self.assertIn("the end packet is missing: the stream was cut after 120 pictures", report)

    def test_stream_without_its_end_packet_is_an_error(self):
        self.write("bad.fbs", self.stream[:self.showing[-1][2]])
        self.fail_cleanly("decode", "bad.fbs", "out.y4m", says=["bad.fbs", "end packet is missing", "120 pictures"])

    def test_cut_at_every_byte_of_a_group_is_reported(self):
        for packet in (self.motion[-1], self.showing[-1], self.of_kind(PATTERN)[-1]):
            _, begin, end = packet
            for cut in range(begin + 1, end):
                self.write("bad.fbs", self.stream[:cut])
                done = self.fbs("decode", "bad.fbs", "null:")
                self.assertEqual(done.returncode, FAILED, cut)
                self.assertIn(f"(at byte {begin})".encode(), done.stderr)

    def test_damaged_group_is_reported_and_those_before_it_shown(self):
        for _ in self.of_each_kind_of_stream():
            for packet in self.motion[1:] + self.showing[1:] + self.of_kind(PATTERN)[1:]:
                self.expect_noticed(self.damaged(packet), packet[1], f"bad.fbs: {DAMAGED} (at byte {packet[1]})")

    def test_damage_without_keep_going_leaves_nothing(self):
        for _ in self.of_each_kind_of_stream():
            for packet in packets(self.stream):
                self.write("bad.fbs", self.damaged(packet))
                self.fail_cleanly("decode", "bad.fbs", "out.y4m", says=["bad.fbs", f"at byte {packet[1]}"])

    def test_any_changed_byte_ends_well(self):
        for _ in self.of_each_kind_of_stream():
            for at in range(0, len(self.stream), max(len(self.stream) // 60, 1)):
                stream = bytearray(self.stream)
                stream[at] ^= 0xFF
                self.write("bad.fbs", bytes(stream))
                done = self.fbs("decode", "bad.fbs", "null:", "--keep-going")
                self.assertIn(done.returncode, (FAILED, LITTLE_LOST, MUCH_LOST), f"byte {at}")
                self.assertTrue(done.stderr, f"byte {at}: not noticed")

    def test_removed_packet_is_noticed_at_the_next(self):
        for _ in self.of_each_kind_of_stream():
            for _, begin, end in (self.motion[1], self.showing[1], *self.of_kind(PATTERN)[1:-1][:1]):
                self.expect_noticed(self.stream[:begin] + self.stream[end:], begin, "missing", "not known how")

    def test_removed_last_group_is_noticed_at_the_end(self):
        for _ in self.of_each_kind_of_stream():
            _, begin, end = self.showing[-1]
            self.assertEqual(packets(self.stream)[-1][1], end, "the last group is not the last packet")
            before, _ = self.keep_going(self.stream[:begin])
            missing = len(self.whole.pictures) - len(before)
            self.expect_the_rest_held(self.stream[:begin] + self.stream[end:], begin, f"{missing} pictures are missing")

    def test_removed_beginning_leaves_nothing(self):
        for _ in self.of_each_kind_of_stream():
            for _, begin, end in packets(self.stream)[:4]:
                self.write("bad.fbs", self.stream[:begin] + self.stream[end:])
                self.fail_cleanly("decode", "bad.fbs", "out.y4m", says=["bad.fbs", DAMAGED, f"at byte {begin}"])
                pictures, report = self.keep_going(self.stream[:begin] + self.stream[end:], FAILED)
                self.assertFalse(pictures)
                self.assertIn("contains no pictures", report)

    def test_packets_out_of_their_place_are_noticed(self):
        for _ in self.of_each_kind_of_stream():
            _, begin, middle = self.motion[1]
            end = next(end for _, after, end in packets(self.stream) if after == middle)
            one, other = self.stream[begin:middle], self.stream[middle:end]
            self.expect_noticed(self.stream[:begin] + other + one + self.stream[end:], begin, "missing", "not known how")
            pictures, _ = self.keep_going(self.stream[:middle] + one + self.stream[middle:], 0)
            self.assertEqual(pictures, self.whole.pictures, "one that comes twice does harm")

    def test_stream_behind_a_stream_ends_well(self):
        for _ in self.of_each_kind_of_stream():
            for stream in (self.stream + self.stream[4:], self.stream + self.stream):
                self.write("bad.fbs", stream)
                self.assertIn(self.fbs("decode", "bad.fbs", "null:", "--keep-going").returncode,
                              (0, FAILED, LITTLE_LOST, MUCH_LOST))
