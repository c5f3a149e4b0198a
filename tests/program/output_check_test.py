"""Outputs that would overwrite an input, or each other, and names of another format: refused before anything is written."""
import os
import subprocess

from harness import FBS, TALK_FBS, TALK_Y4M, ProgramTest


class SameFile(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("talk.y4m", TALK_Y4M.read_bytes())
        self.write("talk.fbs", TALK_FBS.read_bytes())
        os.mkdir(self.folder / "folder")
        os.symlink("talk.y4m", self.folder / "link.fbs")
        os.symlink("talk.y4m", self.folder / "link.y4m")
        os.link(self.folder / "talk.y4m", self.folder / "hard.fbs")
        os.symlink("talk.fbs", self.folder / "stream.mkv")

    def refused(self, arguments, *says):
        self.fail_cleanly(*arguments.split(), says=["the same file", *says])

    def test_encode(self):
        self.refused("encode talk.y4m link.fbs", "OUTPUT link.fbs", "INPUT talk.y4m")
        self.refused("encode talk.y4m hard.fbs", "OUTPUT hard.fbs")
        self.refused("encode link.y4m folder/../link.fbs")
        self.assertTrue((self.folder / "link.fbs").is_symlink())

    def test_overlay(self):
        self.refused("encode talk.y4m out.fbs --overlay talk.y4m", "--overlay talk.y4m", "INPUT talk.y4m")
        self.refused("encode talk.y4m out.fbs --overlay link.y4m", "--overlay link.y4m")
        self.refused("encode talk.y4m out.fbs --overlay folder/../out.fbs", "OUTPUT out.fbs")  # neither exists
        self.refused("encode talk.y4m - --overlay -", "OUTPUT -")

    def test_decode(self):
        os.symlink("talk.fbs", self.folder / "in.y4m")
        self.refused("decode talk.fbs in.y4m", "OUTPUT in.y4m", "INPUT talk.fbs")
        self.refused("decode talk.fbs stream.mkv", "stream.mkv")

    def test_sound(self):
        self.write("sound.mkv", b"sound")
        self.refused("decode talk.fbs sound.mkv --sound sound.mkv", "--sound sound.mkv")

    def test_marks(self):
        os.symlink("marks.json", self.folder / "marks.fbs")
        self.write("marks.json", b"{}")
        self.refused("encode talk.y4m marks.fbs --marks marks.json", "--marks marks.json")

    def test_export(self):
        os.symlink("talk.fbs", self.folder / "table.csv")
        self.refused("export talk.fbs table.csv", "OUTPUT table.csv")

    def test_redirected_standard_input(self):
        before = self.files()
        with open(self.folder / "talk.y4m", "rb") as source:
            done = subprocess.run([FBS, "encode", "-", "link.fbs"], stdin=source, capture_output=True, cwd=self.folder)
        self.assertEqual(done.returncode, 2)
        self.assertIn(b"the same file", done.stderr)
        self.assertEqual(self.files(), before)


class Names(ProgramTest):
    def refused(self, output, better):
        os.path.exists(self.folder / "in.y4m") or os.symlink(TALK_Y4M, self.folder / "in.y4m")
        self.fail_cleanly("encode", "in.y4m", output, says=["cannot write " + output, "ends in .fbs", "use " + better])

    def test_stream_with_the_name_of_another_format(self):
        self.refused("talk.mp4", "talk.fbs")
        self.refused("talk.y4m", "talk.fbs")
        self.refused("talk.tmp", "talk.fbs")
        self.refused("talk", "talk.fbs")

    def test_streams_to_names_that_will_do(self):
        os.mkfifo(self.folder / "pipe")
        reader = subprocess.Popen(["cat", "pipe"], stdout=subprocess.PIPE, cwd=self.folder)
        self.succeed("encode", TALK_Y4M, "pipe", "--frames", 5)
        self.assertTrue(reader.communicate()[0].startswith(TALK_FBS.read_bytes()[:4]))
        for output in ("/dev/null", "/dev/stdout", "OUT.FBS"):
            self.succeed("encode", TALK_Y4M, output, "--frames", 5)
        self.assertTrue((self.folder / "OUT.FBS").exists())

    def test_pictures_with_the_name_of_a_stream(self):
        self.fail_cleanly("decode", TALK_FBS, "out.fbs", says=["cannot write out.fbs", "pictures", ".mp4"])
