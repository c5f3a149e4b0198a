"""encode --live: what has been seen is sent, before more comes."""
import os
import select
import subprocess

from harness import (BLEND, FBS, MAX_SECONDS, MOTION, PATTERN, SETUP, SURROUND, TALK_Y4M, UNIT, ProgramTest, packets,
                     read_y4m)

PICTURE = len(b"FRAME\n") + 176 * 144 * 3 // 2     # bytes of the talker's
RATE = 30
GROUP = 6                                          # pictures of the delay of 0.2 s


def arrivals(stream):
    """(bytes, pictures) of each piece of a stream that ends with the blends of a group: the pictures it releases come then."""
    found, begin, in_scene, shown = [], 4, 0, 0
    for kind, _, end in packets(stream):
        if kind == SETUP:
            in_scene = 0
        if kind in (BLEND, UNIT):
            count = 1 if in_scene == 0 else GROUP
            in_scene += count
            found.append((end - begin, count))
            begin = end
    return found


def blends(stream):
    """Groups whose blends are in the beginning of a stream."""
    try:
        return sum(kind in (BLEND, UNIT) and end <= len(stream) for kind, _, end in packets(stream))
    except IndexError:  # it ends inside the length of a packet
        return 0


class Live(ProgramTest):
    def start(self, *arguments):
        running = subprocess.Popen([FBS, "encode", "-", "-", "--live", "--quiet", *map(str, arguments)],
                                   stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.addCleanup(running.communicate)
        self.addCleanup(running.kill)
        return running

    def read_some(self, running):
        ready, _, _ = select.select([running.stdout], [], [], MAX_SECONDS)
        self.assertTrue(ready, "nothing comes")
        return os.read(running.stdout.fileno(), 1 << 16)

    def test_each_group_leaves_before_more_is_fed(self):
        head, _, pictures = TALK_Y4M.read_bytes().partition(b"\n")
        running = self.start()
        running.stdin.write(head + b"\n")
        stream, fed = b"", 0
        for group in range(6):
            until = 1 + group * GROUP
            running.stdin.write(pictures[fed * PICTURE:until * PICTURE])
            running.stdin.flush()
            fed = until
            while blends(stream) < group + 1:
                stream += self.read_some(running)
        stream += running.communicate(timeout=MAX_SECONDS)[0]
        self.assertEqual(running.returncode, 0)
        self.write("out.fbs", stream)
        self.assertEqual(len(self.decoded("out.fbs").pictures), fed)

    def test_pictures_are_fit(self):
        self.succeed("encode", TALK_Y4M, "out.fbs", "--live")
        shown = self.decoded("out.fbs")
        self.assertGreater(read_y4m(TALK_Y4M).luma_psnr(shown), 29.0)

    def test_the_map_of_the_surround_is_refined(self):
        self.succeed("encode", TALK_Y4M, "out.fbs", "--live")
        kinds = [kind for kind, _, _ in packets((self.folder / "out.fbs").read_bytes())]
        self.assertEqual(kinds.count(SETUP), 1)
        self.assertEqual(kinds.count(SURROUND), 2)
        self.assertGreater(kinds.index(SURROUND, kinds.index(MOTION)), kinds.index(BLEND))

    def test_one_pattern(self):
        self.succeed("encode", TALK_Y4M, "out.fbs", "--live", "--patterns", 1)
        kinds = [kind for kind, _, _ in packets((self.folder / "out.fbs").read_bytes())]
        self.assertEqual((kinds.count(PATTERN), kinds.count(MOTION)), (1, 1 + 119 // GROUP + 1))
        self.assertEqual(len(self.decoded("out.fbs").pictures), 120)

    def test_nothing_waits_longer_than_the_buffer(self):
        kbps, buffer = 6, 2
        for scenes in ([], ["--key-interval", 1]):
            with self.subTest(scenes=scenes):
                self.succeed("encode", TALK_Y4M, "out.fbs", "--live", "--bitrate", kbps, "--buffer", buffer, *scenes)
                waiting = worst = 0
                for size, pictures in arrivals((self.folder / "out.fbs").read_bytes()):
                    waiting += size / (kbps * 125)
                    worst = max(worst, waiting)
                    waiting = max(0, waiting - pictures / RATE)
                self.assertLess(worst, 1.15 * buffer)   # a pattern's size is predicted
                self.assertGreater(worst, 0.5 * buffer)

    def test_viewers_join_at_each_key_interval(self):
        self.succeed("encode", TALK_Y4M, "out.fbs", "--live", "--key-interval", 1)
        stream = (self.folder / "out.fbs").read_bytes()
        whole = self.decoded("out.fbs").pictures
        begins = [begin for kind, begin, _ in packets(stream) if kind == SETUP]
        self.assertGreater(len(begins), 3)
        self.write("joined.fbs", stream[:4] + stream[begins[2]:])
        joined = self.decoded("joined.fbs").pictures
        self.assertEqual(joined, whole[-len(joined):])

    def test_several_patterns_are_not_counted_live(self):
        self.fail_cleanly("encode", TALK_Y4M, "out.fbs", "--live", "--patterns", 5, says=["live"])


