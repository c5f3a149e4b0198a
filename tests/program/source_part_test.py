"""--frames and --duration encode the beginning of a source."""
import subprocess

from harness import FBS, TALK_Y4M, ProgramTest, Y4m, ffmpeg


class SourcePart(ProgramTest):
    def pictures(self, *options, source=TALK_Y4M):
        self.succeed("encode", source, "out.fbs", *options)
        return len(Y4m(self.succeed("decode", "out.fbs", "-", "--vfr")).pictures)

    def test_frames(self):
        self.assertEqual(self.pictures("--frames", 1), 1)
        self.assertEqual(self.pictures("--frames", 25), 25)
        self.assertEqual(self.pictures("--frames", 500), 120)

    def test_duration(self):
        self.assertEqual(self.pictures("--duration", 0.5), 15)
        self.assertEqual(self.pictures("--duration", 0.51), 16)  # the last one begins within it
        self.assertEqual(self.pictures("--duration", 100), 120)

    def test_whichever_comes_first(self):
        self.assertEqual(self.pictures("--frames", 10, "--duration", 0.5), 10)
        self.assertEqual(self.pictures("--frames", 20, "--duration", 0.5), 15)

    def test_duration_is_source_time(self):
        ffmpeg("-i", TALK_Y4M, "-vf", "select='not(between(n,5,34))'", "-fps_mode", "vfr", "-c:v", "ffv1",
               self.folder / "in.mkv")
        self.assertEqual(self.pictures("--duration", 1.5, source="in.mkv"), 15)  # 45 less the 30 that are missing

    def test_frames_do_not_wait_for_the_next_picture(self):
        running = subprocess.Popen([FBS, "encode", "-", "out.fbs", "--frames", "3"], stdin=subprocess.PIPE, cwd=self.folder,
                                   stderr=subprocess.DEVNULL)
        data = TALK_Y4M.read_bytes()
        running.stdin.write(data[:data.index(b"\n") + 1 + 3 * (6 + 176 * 144 * 3 // 2)])
        running.stdin.flush()  # and the pipe stays open
        self.assertEqual(running.wait(60), 0)
        running.stdin.close()
        self.assertEqual(len(self.decoded("out.fbs").pictures), 3)
