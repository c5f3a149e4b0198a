"""Loss costs no more than the scenes that it is in, and what is shown then is held. measure_loss.py measures it at length."""
import random
import subprocess
import time

from harness import BLEND, END, FBS, KEYED_FBS, MOTION, PATTERN, SETUP, SURROUND, TALK_Y4M, ProgramTest, read_y4m
from loss import Whole, burst_loss, decode, random_loss, with_flipped_bits, without


class Loss(ProgramTest):
    def setUp(self):
        super().setUp()
        self.whole = Whole(KEYED_FBS)
        self.assertGreaterEqual(len(self.whole.scenes), 6)

    def expect_right_or_held(self, viewing):
        for i, right in enumerate(viewing.right):
            if not right and i >= viewing.black:
                self.assertGreater(i, 0)
                self.assertEqual(viewing.digests[i], viewing.digests[i - 1], f"picture {i} is neither right nor held")

    def scenes_hit(self, lost):
        """Numbers of the scenes that have lost a packet. The end packet is of no scene."""
        scene, hit = -1, set()
        for (kind, _, _), gone in zip(self.whole.packets, lost, strict=True):
            scene += kind == SETUP
            if gone and kind != END:
                hit.add(scene)
        return hit

    def test_lost_packets_cost_their_scenes_alone(self):
        for channel in (random_loss, burst_loss):
            for seed in range(8):
                lost = channel(len(self.whole.packets), 0.06, random.Random(seed))
                viewing = self.whole.seen(without(self.whole.stream, lost))
                self.expect_right_or_held(viewing)
                hit = self.scenes_hit(lost)
                for i, right in enumerate(viewing.right):
                    self.assertTrue(right or self.whole.scene_of(i) in hit, f"{channel.__name__} {seed}: picture {i}")
                self.assertEqual(viewing.exit_code == 0, not any(lost), "noticed")

    def test_a_flipped_bit_of_a_payload_or_check_is_set_right(self):
        for kind, begin, end in self.whole.packets[::3]:
            for byte in (begin + 3 if end - begin > 5 else end - 2, (begin + end) // 2, end - 1):
                viewing = self.whole.seen(with_flipped_bits(self.whole.stream, 8 * byte + byte % 8))
                self.assertTrue(all(viewing.right), f"byte {byte} of a packet {kind}")
                self.assertEqual(viewing.exit_code, 0)

    def test_flipped_bits_cost_at_most_their_scene(self):
        for bit in range(32 + 5, 8 * len(self.whole.stream) - 9, 8 * len(self.whole.stream) // 40):
            viewing = self.whole.seen(with_flipped_bits(self.whole.stream, bit, bit + 9))
            self.expect_right_or_held(viewing)
            self.assertNotEqual(viewing.exit_code, 0, f"bit {bit} is not noticed")
            wrong = {self.whole.scene_of(i) for i, right in enumerate(viewing.right) if not right}
            self.assertLessEqual(len(wrong), 1, f"bit {bit}")

    def test_a_resilient_stream_goes_on_without_what_is_lost(self):
        source = read_y4m(TALK_Y4M)
        for resilience, most in (("strong", 0.7), ("packet", 0.8)):
            self.succeed("encode", TALK_Y4M, "live.fbs", "--live", "--resilience", resilience)
            whole = Whole(self.folder / "live.fbs")
            head = 1 + next(k for k, (kind, _, _) in enumerate(whole.packets) if kind == PATTERN)
            right = source.luma_psnr(whole.video)
            shown = []
            for seed in range(4):
                channel = random_loss(len(whole.packets) - head - 1, 0.1, random.Random(seed))
                viewing = whole.seen(without(whole.stream, [False] * head + channel + [False]))
                self.assertEqual(len(viewing.decoded), len(source.pictures), "motion that is lost is interpolated")
                shown.append(source.luma_psnr(viewing.video))
            self.assertGreater(sum(shown) / len(shown), right - most, resilience)

    def test_a_group_that_is_sent_again_takes_the_place_of_a_lost_one(self):
        self.succeed("encode", TALK_Y4M, "live.fbs", "--live", "--resilience", "strong", "--bitrate", 12)
        whole = Whole(self.folder / "live.fbs")
        content = [whole.stream[begin:end] for _, begin, end in whole.packets]
        kinds = [kind for kind, _, _ in whole.packets]
        # Packets of groups that come again, and how many packets after the first time. (What is drawn late has the surround
        # that has come meanwhile.)
        again = {k: k - content.index(packet) for k, packet in enumerate(content)
                 if kinds[k] in (MOTION, PATTERN, BLEND) and SURROUND not in kinds[content.index(packet):k]}
        again = {k: after for k, after in again.items() if after > 0}
        self.assertTrue(any(kinds[k] == PATTERN for k in again))
        for gone in (set(again), {k - after for k, after in again.items()}):
            viewing = whole.seen(without(whole.stream, [k in gone for k in range(len(content))]))
            self.assertTrue(all(viewing.right))
            self.assertEqual(viewing.exit_code, 0)

    def test_a_stream_is_joined_by_the_parts_of_its_head(self):
        self.succeed("encode", TALK_Y4M, "live.fbs", "--live", "--patterns", 1, "--resilience", "packet", "--join", 1,
                     "--key-interval", 100)
        whole = Whole(self.folder / "live.fbs")
        for packet in (6, len(whole.packets) // 2):
            video, _ = decode(whole.stream[:4] + whole.stream[whole.packets[packet][1]:])
            self.assertGreater(len(video.pictures), len(whole.pictures) // 5)
            # Of the first groups not all is known, and the surround is repeated.
            self.assertTrue(video.pictures[-1] == whole.pictures[-1])

    def test_killed_encoder_leaves_what_can_be_played(self):
        encoder = subprocess.Popen([FBS, "encode", "-", "out.fbs", "--quiet", "--key-interval", "0.5"], cwd=self.folder,
                                   stdin=subprocess.PIPE, bufsize=0)
        self.addCleanup(encoder.wait)
        self.addCleanup(encoder.kill)
        self.addCleanup(encoder.stdin.close)
        source, part, fed = read_y4m(TALK_Y4M), self.folder / "out.fbs.part", 0
        encoder.stdin.write(source.header)
        while not part.exists() or part.stat().st_size < len(self.whole.stream) // 2:
            if fed == len(source.pictures):
                time.sleep(0.01)  # pictures are coded behind those that are read
                continue
            encoder.stdin.write(b"FRAME\n" + source.pictures[fed])
            fed += 1
        encoder.kill()
        encoder.wait()
        video, _ = decode(part.read_bytes())
        self.assertIn(len(video.pictures), range(len(self.whole.pictures) // 3, fed + 1))
        self.assertEqual(video.pictures, self.whole.pictures[:len(video.pictures)])

    def test_channels_lose_as_much_as_asked(self):
        for channel, burst in ((random_loss, 1 / 0.9), (burst_loss, 3)):
            lost = channel(200000, 0.1, random.Random(1))
            begins = sum(gone and not before for gone, before in zip(lost, [False, *lost]))
            self.assertAlmostEqual(sum(lost) / len(lost), 0.1, delta=0.005)
            self.assertAlmostEqual(sum(lost) / begins, burst, delta=0.1)
