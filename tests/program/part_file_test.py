"""The .part file of an output: locked while a process writes it, replaced when it was left behind."""
import subprocess
import time

from harness import FBS, FAILED, TALK_FBS, TALK_Y4M, ProgramTest


class PartFile(ProgramTest):
    def start_encoder(self):
        running = subprocess.Popen([FBS, "encode", "-", "out.fbs", "--quiet"], stdin=subprocess.PIPE, cwd=self.folder)
        self.addCleanup(running.communicate)
        self.addCleanup(running.kill)
        running.stdin.write(TALK_Y4M.read_bytes())
        running.stdin.flush()
        for _ in range(1000):
            if (self.folder / "out.fbs.part").exists():
                return running
            time.sleep(0.02)
        self.fail("no output")

    def test_second_encoder_to_a_name_is_refused(self):
        running = self.start_encoder()
        done = self.fbs("encode", TALK_Y4M, "out.fbs", "--frames", 3)
        self.assertEqual(done.returncode, FAILED)
        self.assertEqual(done.stderr.decode(), "fbs: cannot write out.fbs: another process is writing out.fbs.part\n")
        running.stdin.close()
        self.assertEqual(running.wait(60), 0)
        self.assertEqual(self.files(), {"out.fbs": TALK_FBS.read_bytes()})

    def test_leftover_of_a_killed_encoder_is_replaced(self):
        running = self.start_encoder()
        running.kill()
        running.wait()
        done = self.fbs("encode", TALK_Y4M, "out.fbs", "--quiet")
        self.assertEqual((done.returncode, done.stderr), (0, b"fbs: replaced out.fbs.part, left by an earlier run\n"))
        self.assertEqual(self.files(), {"out.fbs": TALK_FBS.read_bytes()})

    def test_leftover_of_every_kind_of_output_is_replaced(self):
        for output, part in (("out.y4m", "out.y4m.part"), ("out.mkv", "out.mkv.part"), ("out_%03d.png", "out_001.png.part")):
            self.write(part, b"leftover")
            done = self.fbs("decode", TALK_FBS, output, "--quiet")
            self.assertEqual(done.returncode, 0)
            self.assertEqual(done.stderr.decode(), f"fbs: replaced {output}.part, left by an earlier run\n")
            self.assertNotIn(part, self.files())
