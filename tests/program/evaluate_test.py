"""fbs evaluate: reports, runs that go on, other codecs, folders, and what is refused. See measure_test.py for its values."""
import csv
import json
import os
import re
import shutil
import signal
import subprocess
import time
import unittest

from harness import FBS, TALK_FBS, TALK_ONE_FBS, TALK_TRUTH, TALK_Y4M, ProgramTest, flat_y4m, talker

PICTURES = 24


class EvaluateTest(ProgramTest):
    def setUp(self):
        super().setUp()
        talker(self.folder / "talk.y4m", "--size", "176x144", "--frames", str(PICTURES), "--seed", "3")

    def modified(self, pattern):
        """Time of change of each file that fits."""
        return {path.name: path.stat().st_mtime_ns for path in self.folder.glob(pattern)}


class Reports(EvaluateTest):
    def test_csv_has_a_line_for_each_picture_of_each_stream(self):
        self.succeed("evaluate", "talk.y4m", "--quality", "30", "60", "--csv", "out.csv", "--quiet")
        with open(self.folder / "out.csv", newline="") as file:
            lines = list(csv.DictReader(file))
        self.assertEqual(len(lines), 2 * PICTURES)
        self.assertEqual({line["point"] for line in lines}, {"quality 30", "quality 60"})
        for number, line in enumerate(lines[:PICTURES]):
            self.assertEqual(int(line["picture"]), number)
            self.assertAlmostEqual(float(line["time_s"]), number / 30, places=4)
            self.assertTrue(15 < float(line["face_psnr_y"]) < 60 and 15 < float(line["psnr_u"]) < 60)
            self.assertTrue(0 < float(line["face_ms_ssim"]) <= 1)
            self.assertGreater(int(line["face_samples"]), 500)

    def test_html_loads_nothing_and_has_curves_and_pictures(self):
        self.succeed("evaluate", "talk.y4m", "--quality", "20", "50", "--html", "out.html", "--quiet")
        page = (self.folder / "out.html").read_text()
        self.assertNotRegex(page, r"https?://|<script|@import|url\(|<link")
        self.assertNotIn("{{", page)
        self.assertGreaterEqual(page.count("<svg"), 4)
        pictures = re.findall(r'src="([^"]{30})', page)
        self.assertEqual(len(pictures), 4)  # source and fbs, twice
        for source in pictures:
            self.assertTrue(source.startswith("data:image/jpeg;base64,/9j/"), source)
        self.assertIn("24 of 24 pictures", page)
        self.assertRegex(page, r'class="summary">At [\d.]+ kbit/s')

    def test_results_go_to_files_or_standard_output(self):
        call = "evaluate", TALK_Y4M, TALK_ONE_FBS, "--quiet"
        table = self.succeed(*call, "--json", "out.json", "--csv", "out.csv", "--html", "out.html")
        self.assertIn(b"kbit/s", table)
        for option, file in (("--json", "out.json"), ("--csv", "out.csv"), ("--html", "out.html")):
            self.assertEqual(self.succeed(*call, option, "-"), (self.folder / file).read_bytes(), option)
        self.assertEqual(self.succeed(*call, "--json"), (self.folder / "out.json").read_bytes())

    def test_streams_share_the_face_of_the_first(self):
        report = json.loads(self.succeed("evaluate", TALK_Y4M, TALK_ONE_FBS, TALK_FBS, "--json", "--csv", "out.csv"))
        self.assertEqual([point["point"] for point in report["points"]], [str(TALK_ONE_FBS), str(TALK_FBS)])
        self.assertIn(str(TALK_ONE_FBS), report["region"]["from"])
        with open(self.folder / "out.csv", newline="") as file:
            lines = list(csv.DictReader(file))
        samples = [[line["face_samples"] for line in lines if line["point"] == str(name)] for name in (TALK_ONE_FBS, TALK_FBS)]
        self.assertEqual(samples[0], samples[1])

    def test_region_from_landmarks(self):
        own, given = (json.loads(self.succeed("evaluate", TALK_Y4M, TALK_FBS, "--json", *region))
                      for region in ((), ("--region", TALK_TRUTH)))
        self.assertEqual(given["region"], {"from": str(TALK_TRUTH), "frames": 120})
        self.assertEqual(own["points"][0]["psnr_frame"], given["points"][0]["psnr_frame"])
        self.assertNotEqual(own["points"][0]["psnr_face"], given["points"][0]["psnr_face"])

    def test_region_from_a_stream_that_is_not_measured(self):
        both = json.loads(self.succeed("evaluate", TALK_Y4M, TALK_ONE_FBS, TALK_FBS, "--json"))
        one = json.loads(self.succeed("evaluate", TALK_Y4M, TALK_FBS, "--region", TALK_ONE_FBS, "--json"))
        self.assertEqual(one["points"], both["points"][1:])
        self.assertEqual(one["region"], both["region"])

    def test_first_pictures_only(self):
        self.succeed("encode", "talk.y4m", "ten.fbs", "--quality", "50", "--frames", "10", "--quiet")
        given = json.loads(self.succeed("evaluate", "talk.y4m", "ten.fbs", "--frames", "10", "--json"))["points"][0]
        own = json.loads(self.succeed("evaluate", "talk.y4m", "--quality", "50", "--frames", "10", "--json"))["points"][0]
        self.assertEqual(given["frames"], 10)
        for value in ("bytes", "kbps", "psnr_face", "psnr_frame"):
            self.assertEqual(given[value], own[value], value)
        self.fail_cleanly("evaluate", "talk.y4m", "ten.fbs", "--frames", "11", says=["fewer pictures than"])

    def test_stills_are_files(self):
        self.succeed("evaluate", "talk.y4m", "--quality", "50", "--stills", "new/stills", "--quiet")
        written = sorted((self.folder / "new/stills").iterdir())
        self.assertEqual([path.name for path in written],
                         [f"{why}-{what}.jpg" for why in ("typical", "worst") for what in ("difference", "fbs", "source")])
        for path in written:
            self.assertTrue(path.read_bytes().startswith(b"\xff\xd8"), path)
        self.assertEqual(len({path.read_bytes() for path in written}), 6)

    def test_says_in_how_many_pictures_the_face_is_believed(self):
        header, *lines = TALK_TRUTH.read_text().splitlines()
        self.write("half.csv", "\n".join([header] + lines[:60]).encode() + b"\n")
        report = json.loads(self.succeed("evaluate", TALK_Y4M, TALK_FBS, "--json", "--region", "half.csv"))
        self.assertEqual(report["region"]["frames"], 60)
        self.assertIn(b"60 of 120 pictures", self.succeed("evaluate", TALK_Y4M, TALK_FBS, "--region", "half.csv"))

    def test_source_from_a_pipe(self):
        data = (self.folder / "talk.y4m").read_bytes()
        points = json.loads(self.succeed("evaluate", "-", "--quality", "30", "50", "--json", stdin=data))["points"]
        self.assertEqual([point["frames"] for point in points], [PICTURES, PICTURES])


    def test_stream_from_a_pipe(self):
        piped, named = (json.loads(self.succeed("evaluate", TALK_Y4M, name, "--json", stdin=TALK_FBS.read_bytes()))["points"][0]
                        for name in ("-", TALK_FBS))
        self.assertEqual({**piped, "point": ""}, {**named, "point": ""})


class Runs(EvaluateTest):
    ARGUMENTS = ("evaluate", "talk.y4m", "--quality", "30", "60", "--html", "out.html", "--quiet")

    def test_second_run_makes_nothing_again(self):
        first = self.succeed(*self.ARGUMENTS)
        before = self.modified("out.fbs-run/*")
        self.assertIn("quality-30.fbs", before)
        self.assertEqual(self.succeed(*self.ARGUMENTS), first)
        self.assertEqual(self.modified("out.fbs-run/*"), before)

    def test_what_is_half_done_is_not_taken_for_done(self):
        first = self.succeed(*self.ARGUMENTS)
        run = self.folder / "out.fbs-run"
        stream = (run / "quality-30.fbs").read_bytes()
        (run / "quality-30.fbs").write_bytes(stream[:-20])
        before = self.modified("out.fbs-run/*")
        self.assertEqual(self.succeed(*self.ARGUMENTS), first)
        self.assertEqual((run / "quality-30.fbs").read_bytes(), stream)
        after = self.modified("out.fbs-run/*")
        self.assertEqual({name for name in after if after[name] != before[name] and "60" in name}, set())

    def test_another_source_is_measured_anew(self):
        self.succeed(*self.ARGUMENTS)
        talker(self.folder / "talk.y4m", "--size", "176x144", "--frames", str(PICTURES), "--seed", "4")
        again = self.succeed(*self.ARGUMENTS)
        shutil.rmtree(self.folder / "out.fbs-run")
        self.assertEqual(self.succeed(*self.ARGUMENTS), again)

    def test_interrupted_run_leaves_no_report_and_goes_on(self):
        arguments = [*self.ARGUMENTS[:3], *map(str, range(0, 96, 8)), *self.ARGUMENTS[5:]]
        running = subprocess.Popen([FBS, *arguments], cwd=self.folder, stderr=subprocess.PIPE, stdout=subprocess.PIPE)
        first = self.folder / "out.fbs-run/quality-0.json"
        while not first.exists() and running.poll() is None:
            time.sleep(0.01)
        running.send_signal(signal.SIGINT)
        _, error = running.communicate(timeout=60)
        self.assertEqual(running.returncode, 130, error)
        self.assertIn(b"goes on from there", error)
        self.assertFalse((self.folder / "out.html").exists())
        self.assertEqual(list(self.folder.rglob("*.part")), [])
        before = first.stat().st_mtime_ns
        self.succeed(*arguments)
        self.assertEqual(first.stat().st_mtime_ns, before)
        self.assertTrue((self.folder / "out.html").exists())

    def test_without_a_place_to_keep_nothing_is_left(self):
        temporary = self.folder / "temporary"
        temporary.mkdir()
        self.succeed("evaluate", "talk.y4m", "--quality", "30", environment={**os.environ, "TMPDIR": str(temporary)})
        self.assertEqual(list(temporary.iterdir()), [])


@unittest.skipUnless(shutil.which("ffmpeg"), "no ffmpeg")
class Peers(EvaluateTest):
    def test_other_codecs_are_measured_alike(self):
        report = json.loads(self.succeed("evaluate", "talk.y4m", "--quality", "20", "35", "50", "80", "--peers", "--json", "--html",
                                         "out.html", "--quiet"))
        self.assertTrue(report["peers"])
        most = max(point["kbps"] for point in report["points"])
        for codec in {point["codec"] for point in report["peers"]}:
            rates = [point["kbps"] for point in report["peers"] if point["codec"] == codec]
            self.assertGreater(max(rates), most, codec)
        for point in report["peers"]:
            self.assertEqual(point["frames"], PICTURES, point["point"])
            self.assertTrue(10 < point["psnr_face"] < 60 and 10 < point["psnr_v_frame"] < 60, point["point"])
        self.assertEqual(set(report["bd_rate"]), {"face", "frame"})
        self.assertEqual((self.folder / "out.html").read_text().count("data:image/jpeg"), 6)

    def test_a_call_is_compared_with_av1_in_real_time(self):
        report = json.loads(self.succeed("evaluate", "talk.y4m", "--live", "--bitrate", "3", "10", "--peers", "--peer-size", "1",
                                         "--json", "--html", "out.html", "--quiet"))
        self.assertEqual([point["point"] for point in report["points"]], ["3 kbit/s", "10 kbit/s"])
        slow, fast = (point["kbps"] for point in report["points"])
        self.assertLess(slow, 0.7 * fast)
        self.assertEqual({point["codec"] for point in report["peers"]}, {"AV1"})
        self.assertIn("10 kbit/s", (self.folder / "out.html").read_text())

    def test_only_the_peers_that_are_asked_for(self):
        self.succeed("encode", "talk.y4m", "best.fbs", "--quality", "50", "--quiet")
        report = json.loads(self.succeed("evaluate", "talk.y4m", "best.fbs", "--peers", "--peer-codec", "x264", "--peer-size", "2",
                                         "--peer-rate", "3", "1", "--json"))
        self.assertEqual({point["point"].partition(" crf")[0] for point in report["peers"]},
                         {"x264 1/2 size", "x264 1/2 size 1/3 rate"})
        self.fail_cleanly("evaluate", "talk.y4m", "best.fbs", "--peer-codec", "x264", says=["--peer-codec requires --peers"])

    def test_a_quarter_of_the_size_is_for_large_pictures(self):
        talker(self.folder / "large.y4m", "--size", "448x448", "--frames", "6")
        of_a_quarter = "--quality", "50", "--peers", "--peer-codec", "x264", "--peer-size", "4", "--peer-rate", "1", "--json"
        large = json.loads(self.succeed("evaluate", "large.y4m", *of_a_quarter))
        self.assertEqual({point["point"].partition(" crf")[0] for point in large["peers"]}, {"x264 1/4 size"})
        self.assertEqual(json.loads(self.succeed("evaluate", "talk.y4m", *of_a_quarter))["peers"], [])
        self.fail_cleanly("evaluate", "talk.y4m", "--peers", "--peer-size", "3", says=["--peer-size", "3"])

    def test_needs_ffmpeg(self):
        self.fail_cleanly("evaluate", "talk.y4m", "--peers", says=["--peers needs ffmpeg"],
                          environment={**os.environ, "PATH": "/nowhere"})


class Folders(EvaluateTest):
    def setUp(self):
        super().setUp()
        (self.folder / "clips").mkdir()
        (self.folder / "talk.y4m").rename(self.folder / "clips/a.y4m")
        talker(self.folder / "clips/b.y4m", "--size", "128x96", "--frames", "12", "--seed", "5")

    def test_one_report_of_all_videos(self):
        report = json.loads(self.succeed("evaluate", "clips", "--quality", "50", "--jobs", "2", "--json", "--html", "all.html", "--csv",
                                         "all.csv", "--quiet"))
        self.assertEqual([clip["source"] for clip in report["clips"]], ["clips/a.y4m", "clips/b.y4m"])
        self.assertEqual([clip["points"][0]["frames"] for clip in report["clips"]], [PICTURES, 12])
        page = (self.folder / "all.html").read_text()
        self.assertEqual(page.count('<section class="clip">'), 2)
        self.assertEqual(len((self.folder / "all.csv").read_text().splitlines()), 1 + PICTURES + 12)

    def test_a_video_that_fails_does_not_stop_the_others(self):
        self.write("clips/grey.y4m", flat_y4m(128, 96, 3))
        done = self.fbs("evaluate", "clips", "--quality", "50", "--json", "--quiet")
        self.assertEqual(done.returncode, 2)
        self.assertRegex(done.stderr.decode(), r"\Afbs: left out: clips/grey.y4m: [^\n]*face[^\n]*\n\Z")
        report = json.loads(done.stdout)
        self.assertEqual((len(report["clips"]), len(report["failed"])), (2, 1))


class Refused(EvaluateTest):
    def test_what_does_not_go_together(self):
        (self.folder / "clips").mkdir()
        shutil.copy(self.folder / "talk.y4m", self.folder / "clips")
        self.write("talk.fbs", TALK_FBS.read_bytes())
        self.write("faces.csv", TALK_TRUTH.read_bytes())
        for line, says in (("clips talk.fbs", "STREAM goes with one video"),
                           ("clips --region faces.csv", "--region goes with one video"),
                           ("clips --stills out", "--stills goes with one video"),
                           ("talk.y4m --stills talk.fbs/out", "cannot make the folder"),
                           ("talk.y4m --jobs 2", "--jobs is for a folder"),
                           ("talk.y4m talk.fbs --quality 50", "--quality is for encoding"),
                           ("talk.y4m talk.fbs --live", "--live is for encoding"),
                           ("talk.y4m talk.fbs --bitrate 6", "--bitrate is for encoding"),
                           ("talk.y4m talk.fbs --allow-no-face", "--allow-no-face is for encoding"),
                           ("talk.y4m --csv talk.y4m", "--csv talk.y4m is the same file as SOURCE"),
                           ("talk.y4m talk.fbs --html talk.fbs", "--html talk.fbs is the same file as STREAM"),
                           ("clips --html clips/talk.y4m", "the same file as the video"),
                           ("talk.y4m --html out --csv out", "the same file"),
                           ("talk.y4m --csv - --json", "the same file"),
                           ("--json talk.y4m talk.fbs", "--json talk.y4m: the name of the file ends in .json"),
                           ("talk.y4m --html absent/out.html", "there is no folder absent"),
                           ("talk.y4m --region faces.csv", "more than talk.y4m"),
                           ("talk.y4m --region talk.y4m", "has no columns"),
                           ("talk.y4m --keep talk.fbs/run", "cannot make the folder"),
                           ("- -", "read once only"),
                           ("camera:0", "record it first")):
            with self.subTest(line):
                self.fail_cleanly("evaluate", *line.split(), "--quiet", says=[says])
