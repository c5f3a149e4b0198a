"""Output on the terminal: help, a progress bar for terminals only, and silence with --quiet."""
import json
import os
import pty
import shutil
import subprocess
import time
import unittest

from harness import FBS, TALK_FBS, TALK_Y4M, ProgramTest

VERBS = ("encode", "decode", "play", "evaluate", "inspect", "export", "track")


class Terminal(ProgramTest):
    def test_help_shows_every_verb_and_examples(self):
        text = self.succeed("--help").decode()
        for verb in VERBS:
            self.assertRegex(text, rf"(?m)^ +{verb} +\S")
            self.assertIn(f"fbs {verb} ", text.partition("Examples")[2])

    def test_help_of_every_verb_teaches(self):
        for verb in VERBS:
            with self.subTest(verb):
                text = self.succeed(verb, "--help").decode()
                self.assertIn(f"fbs {verb} ", text)
                self.assertIn("Examples", text)
                self.assertIn("INPUT" if verb != "evaluate" else "SOURCE", text)

    def test_hidden_switch_stays_hidden(self):
        self.assertNotIn(b"snakes", self.succeed("encode", "--help").replace(b"mesh and snakes", b""))

    def test_version(self):
        self.assertRegex(self.succeed("--version").decode(), r"\Afbs \d+\.\d+\.\d+\n\Z")

    def test_doctor_says_what_loads(self):
        report = json.loads(self.succeed("doctor", "--json"))
        self.assertEqual(f"fbs {report['fbs']}\n".encode(), self.succeed("--version"))
        self.assertLessEqual({"dav1d", "Draco", "Highway", "Opus", "Codec 2"}, set(report["libraries"]))
        self.assertTrue(all(module["loads"] for module in report["modules"].values()), report["modules"])
        self.assertLessEqual({"libaom", "OpenCV"}, set(report["modules"]["fbs_encoder"]["libraries"]))
        text = self.succeed("doctor").decode()
        for name in [*report, *report["modules"]]:
            if name != "modules":
                self.assertRegex(text, rf"(?m)^{name} +\S")
        shutil.copy(FBS, self.folder / "alone")  # without its modules
        alone = subprocess.run([self.folder / "alone", "doctor"], capture_output=True, text=True, check=True)
        self.assertRegex(alone.stdout, r"(?m)^fbs_av +missing: module fbs_av\.so not found")

    def test_quiet_prints_nothing(self):
        for arguments in (("encode", TALK_Y4M, "out.fbs"), ("decode", TALK_FBS, "out.y4m")):
            done = self.fbs(*arguments, "--quiet")
            self.assertEqual((done.returncode, done.stdout, done.stderr), (0, b"", b""), arguments)

    def test_quiet_evaluate_prints_its_table_alone(self):
        done = self.fbs("evaluate", TALK_Y4M, TALK_FBS, "--quiet")
        self.assertEqual((done.returncode, done.stderr), (0, b""))
        self.assertEqual(len(done.stdout.splitlines()), 2)

    def test_no_control_characters_in_a_pipe(self):
        for arguments in (("encode", TALK_Y4M, "out.fbs"), ("decode", TALK_FBS, "out.y4m"), ("evaluate", TALK_Y4M, TALK_FBS),
                          ("inspect", TALK_FBS), ("export", TALK_FBS, "out.csv")):
            done = self.fbs(*arguments)
            text = (done.stdout + done.stderr).decode()
            self.assertFalse([c for c in text if c < " " and c != "\n"], arguments)

    def test_encode_closes_with_one_line(self):
        done = self.fbs("encode", TALK_Y4M, "out.fbs")
        size = os.path.getsize(self.folder / "out.fbs")
        self.assertRegex(done.stderr.decode(), rf"\Aout\.fbs: 120 pictures, {size} bytes, total [\d.]+ kbit/s \(motion [\d.]+\), PSNR face"
                                               r" [\d.]+ dB, frame [\d.]+ dB\n\Z")

    def reports(self, *arguments, number=None):
        """What fbs writes to the descriptor of FBS_REPORT_FD."""
        ours, theirs = os.pipe()
        subprocess.run([FBS, *arguments], stderr=subprocess.DEVNULL, cwd=self.folder, pass_fds=[theirs],
                       env={**os.environ, "FBS_REPORT_FD": number or str(theirs)})
        os.close(theirs)
        with open(ours) as pipe:
            return pipe.read().splitlines()

    def test_reports_for_programs(self):
        lines = self.reports("encode", TALK_Y4M, "out.fbs", "--quiet")
        self.assertEqual(lines[-1], "progress 120 120 encoding")
        for line in lines:
            self.assertRegex(line, r"\Aprogress \d+ 120 encoding\Z")
        self.assertRegex(self.reports("decode", TALK_FBS, "null:")[-1], r"\Aprogress 120 - decoding\Z")
        for kind, arguments in (("io", ("encode", "none.mkv", "out.fbs")), ("not_fbs", ("decode", TALK_Y4M, "null:")),
                                ("argument", ("decode",))):
            self.assertEqual(self.reports(*arguments), [f"error {kind}"])
        for number in ("", "x", "99"):
            self.assertEqual(self.reports("decode", TALK_FBS, "null:", number=number or " "), [])

    def test_bar_on_a_terminal(self):
        try:
            ours, theirs = pty.openpty()
        except OSError as lacking:
            raise unittest.SkipTest(f"no pseudo-terminal available: {lacking}")
        subprocess.run([FBS, "encode", TALK_Y4M, "out.fbs"], stderr=theirs, cwd=self.folder, check=True)
        os.close(theirs)
        text = os.read(ours, 1 << 16).decode()
        os.close(ours)
        self.assertRegex(text, r"encoding +\d+ %")
        self.assertIn("\r", text)


class Play(ProgramTest):
    def without_display(self):
        return {key: value for key, value in os.environ.items()
                if key not in ("DISPLAY", "WAYLAND_DISPLAY", "SDL_VIDEODRIVER")}

    def test_play_without_display_fails_cleanly(self):
        self.fail_cleanly("play", TALK_FBS, says=["window"], environment=self.without_display())

    def test_play_of_something_else_opens_no_window(self):
        self.fail_cleanly("play", TALK_Y4M, says=[TALK_Y4M.name, "not an fbs stream"],
                          environment=self.without_display() | {"SDL_VIDEODRIVER": "dummy"})

    def test_play_runs_in_a_window(self):
        player = subprocess.Popen([FBS, "play", TALK_FBS], stderr=subprocess.PIPE,
                                  env=self.without_display() | {"SDL_VIDEODRIVER": "dummy"})
        time.sleep(3)
        still_there = player.poll() is None
        player.kill()
        said = player.communicate()[1].decode(errors="replace")
        self.assertTrue(still_there, said)
