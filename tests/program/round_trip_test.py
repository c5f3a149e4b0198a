"""Encoding and decoding keep size, number and rate of the pictures, for every kind of file and pipe."""
import hashlib
import json
import os
import select
import subprocess
import wave

from harness import FBS, GREY_FIRST, TALK_FBS, TALK_Y4M, TWO_SCENES_FBS, ProgramTest, ffmpeg, ffprobe, flat_y4m, read_y4m, talker

TALK_SHAPE = (176, 144, 120, 30.0)


def video_shape(path):
    stream = ffprobe(path, "stream=width,height,r_frame_rate,nb_read_packets", "-count_packets")["streams"][0]
    numerator, denominator = map(int, stream["r_frame_rate"].split("/"))
    return stream["width"], stream["height"], int(stream["nb_read_packets"]), round(numerator / denominator, 3)


class RoundTrip(ProgramTest):
    def test_y4m(self):
        self.succeed("encode", TALK_Y4M, "out.fbs")
        self.succeed("decode", "out.fbs", "out.y4m")
        out = read_y4m(self.folder / "out.y4m")
        self.assertEqual(out.shape, TALK_SHAPE)
        self.assertGreater(out.luma_psnr(read_y4m(TALK_Y4M)), 28)

    def test_encoding_again_gives_the_same_bytes(self):
        self.succeed("encode", TALK_Y4M, "out.fbs")
        self.assertEqual((self.folder / "out.fbs").read_bytes(), TALK_FBS.read_bytes())

    def test_y4m_through_standard_input(self):
        self.succeed("encode", "-", "out.fbs", stdin=TALK_Y4M.read_bytes())
        self.assertEqual((self.folder / "out.fbs").read_bytes(), TALK_FBS.read_bytes())

    def test_stream_through_standard_output(self):
        self.assertEqual(self.succeed("encode", TALK_Y4M, "-"), TALK_FBS.read_bytes())

    def test_pictures_through_standard_output(self):
        self.succeed("decode", TALK_FBS, "out.y4m")
        self.assertEqual(self.succeed("decode", TALK_FBS, "-"), (self.folder / "out.y4m").read_bytes())

    def test_stream_through_standard_input(self):
        self.assertEqual(self.succeed("decode", "-", "-", stdin=TALK_FBS.read_bytes()),
                         self.succeed("decode", TALK_FBS, "-"))

    def test_pictures_are_decoded_as_the_stream_arrives(self):
        decoder = subprocess.Popen([FBS, "decode", "-", "-"], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        decoder.stdin.write(TALK_FBS.read_bytes()[:-10])  # the last group is incomplete, and the pipe stays open
        decoder.stdin.flush()
        came, _, _ = select.select([decoder.stdout], [], [], 10)
        decoder.kill()
        decoder.communicate()
        self.assertTrue(came, "waits for the end of the stream")

    def test_null(self):
        self.assertEqual(self.succeed("decode", TALK_FBS, "null:"), b"")
        self.assertEqual(self.files(), {})

    def test_md5_of_each_picture(self):
        lines = self.succeed("decode", TALK_FBS, "--md5").decode().splitlines()
        self.succeed("decode", TALK_FBS, "out.y4m")
        pictures = read_y4m(self.folder / "out.y4m").pictures
        self.assertEqual(lines, [f"{hashlib.md5(p).hexdigest()} {n}" for n, p in enumerate(pictures)])
        self.assertEqual(self.succeed("decode", TALK_FBS, "again.y4m", "--md5").decode().splitlines(), lines)
        self.fail_cleanly("decode", TALK_FBS, says=["OUTPUT is required"])
        self.fail_cleanly("decode", TALK_FBS, "-", "--md5", says=["--md5", "standard output"])

    def test_mkv(self):
        self.succeed("decode", TALK_FBS, "out.mkv")
        self.assertEqual(video_shape(self.folder / "out.mkv"), TALK_SHAPE)

    def test_mp4(self):
        self.succeed("decode", TALK_FBS, "out.mp4")
        self.assertEqual(video_shape(self.folder / "out.mp4"), TALK_SHAPE)

    def test_mp4_of_odd_size(self):
        talker(self.folder / "odd.y4m", "--size", "175x143", "--frames", "10")
        self.succeed("encode", "odd.y4m", "out.fbs")
        self.succeed("decode", "out.fbs", "out.mp4")
        self.assertEqual(video_shape(self.folder / "out.mp4"), (175, 143, 10, 30.0))

    def test_mkv_with_sound(self):
        with wave.open(str(self.folder / "sound.wav"), "wb") as sound:
            sound.setparams((1, 2, 8000, 0, "NONE", ""))
            sound.writeframes(bytes(8000 * 2 * 4))
        self.succeed("decode", TALK_FBS, "out.mkv", "--sound", "sound.wav")
        self.assertEqual(video_shape(self.folder / "out.mkv"), TALK_SHAPE)
        kinds = subprocess.run(["ffprobe", "-v", "error", "-show_entries", "stream=codec_type", "-of", "csv=p=0",
                                self.folder / "out.mkv"], capture_output=True, check=True).stdout.split()
        self.assertCountEqual(kinds, [b"video", b"audio"])

    def test_images_out_and_in(self):
        os.mkdir(self.folder / "images")
        self.succeed("decode", TALK_FBS, "images/frame_%05d.png")
        names = sorted(os.listdir(self.folder / "images"))
        self.assertEqual(names, [f"frame_{n:05d}.png" for n in range(1, 121)])
        source = self.decoded()
        for images in ("images/frame_%05d.png", "images"):
            self.succeed("encode", images, "out.fbs", "--rate", "30")
            again = self.decoded("out.fbs")
            self.assertEqual(again.shape, TALK_SHAPE)
            self.assertGreater(again.luma_psnr(source), 30)

    def test_odd_size(self):
        talker(self.folder / "odd.y4m", "--size", "175x143", "--frames", "20")
        self.succeed("encode", "odd.y4m", "out.fbs")
        out = self.decoded("out.fbs")
        self.assertEqual(out.shape, (175, 143, 20, 30.0))
        self.assertGreater(out.luma_psnr(read_y4m(self.folder / "odd.y4m")), 28)

    def test_one_picture(self):
        talker(self.folder / "one.y4m", "--size", "176x144", "--frames", "1")
        self.succeed("encode", "one.y4m", "out.fbs")
        out = self.decoded("out.fbs")
        self.assertEqual(out.shape, (176, 144, 1, 30.0))
        self.assertGreater(out.luma_psnr(read_y4m(self.folder / "one.y4m")), 28)

    def test_rate_of_films(self):
        talker(self.folder / "film.y4m", "--size", "176x144", "--frames", "10", "--fps", "24000/1001")
        self.succeed("encode", "film.y4m", "out.fbs")
        self.assertTrue(self.succeed("decode", "out.fbs", "-").startswith(b"YUV4MPEG2 W176 H144 F24000:1001"))

    def test_face_that_comes_late(self):
        flat = flat_y4m(176, 144, 15).replace(b"F25:1", b"F30:1")
        self.write("late.y4m", flat + TALK_Y4M.read_bytes().partition(b"\n")[2])
        self.succeed("encode", "late.y4m", "out.fbs")
        out = self.decoded("out.fbs")
        self.assertEqual(out.shape, (176, 144, 135, 30.0))
        self.assertGreater(out.luma_psnr(read_y4m(self.folder / "late.y4m")), 25)

    def test_no_face_where_allowed(self):
        self.write("ramp.y4m", flat_y4m(128, 96, 7, lambda x, y: x + y))
        self.succeed("encode", "ramp.y4m", "out.fbs", "--allow-no-face")
        out = self.decoded("out.fbs")
        self.assertEqual(out.shape, (128, 96, 7, 25.0))
        self.assertGreater(out.luma_psnr(read_y4m(self.folder / "ramp.y4m")), 28)

    def test_marks_by_hand(self):
        talker(self.folder / "talk.y4m", "--size", "176x144", "--frames", "10", "--marks", self.folder / "marks.json")
        self.succeed("encode", "talk.y4m", "out.fbs", "--marks", "marks.json")
        self.assertGreater(self.decoded("out.fbs").luma_psnr(read_y4m(self.folder / "talk.y4m")), 28)

    def test_output_that_exists_is_replaced(self):
        self.write("out.fbs", b"old" * 10000)
        self.succeed("encode", TALK_Y4M, "out.fbs")
        self.assertEqual(self.files(), {"out.fbs": TALK_FBS.read_bytes()})

    def test_names_with_blanks(self):
        os.symlink(TALK_Y4M, self.folder / "a talk.y4m")
        self.succeed("encode", "a talk.y4m", "a stream.fbs")
        self.succeed("decode", "a stream.fbs", "a film.mkv")
        self.assertEqual(video_shape(self.folder / "a film.mkv"), TALK_SHAPE)

    def test_overlay(self):
        for see in ("see.mp4", "see.y4m"):
            self.succeed("encode", TALK_Y4M, "out.fbs", "--overlay", see)
        self.assertEqual((self.folder / "out.fbs").read_bytes(), TALK_FBS.read_bytes())
        width, height, pictures, rate = video_shape(self.folder / "see.mp4")
        self.assertEqual((width % 176, height % 144, pictures, rate), (0, 0, 120, 30.0))
        self.assertEqual(read_y4m(self.folder / "see.y4m").shape, (width, height, 120, 30.0))

    def test_reader_that_leaves_ends_the_decoder(self):
        decoder = subprocess.Popen([FBS, "decode", TALK_FBS, "-"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
        decoder.stdout.read(100)
        decoder.stdout.close()
        self.assertNotEqual(decoder.wait(30), 0)

    def thumbnail(self, stream, *options):
        """Number of the picture that a thumbnail of full size shows."""
        self.succeed("decode", stream, "thumbnail", "--thumbnail", "999", *options)
        ffmpeg("-f", "png_pipe", "-i", self.folder / "thumbnail", "-pix_fmt", "yuv420p", self.folder / "shown.y4m")
        shown, pictures = read_y4m(self.folder / "shown.y4m"), self.decoded(stream).pictures
        luma = slice(0, 176 * 144)
        return min(range(len(pictures)), key=lambda n: sum(abs(a - b) for a, b in
                                                           zip(pictures[n][luma], shown.pictures[0][luma])))

    def test_thumbnail_is_a_png_of_that_size_whatever_its_name(self):
        self.write("out", b"")
        for size, shape in (("88", (88, 72)), ("1000", (176, 144))):  # never enlarged
            with open(self.folder / "out", "rb") as made_by_the_file_manager:
                self.succeed("decode", TALK_FBS, "out", "--thumbnail", size)
                png = made_by_the_file_manager.read()
            self.assertEqual(png[:8] + png[12:16], b"\x89PNG\r\n\x1a\nIHDR")
            self.assertEqual((int.from_bytes(png[16:20], "big"), int.from_bytes(png[20:24], "big")), shape)

    def test_thumbnail_shows_a_face_from_the_front(self):
        self.assertEqual(self.thumbnail(TWO_SCENES_FBS), GREY_FIRST)
        talker(self.folder / "turns.y4m", "--size", "176x144", "--frames", "60", "--motion", "turns", "--yaw", "30")
        self.succeed("encode", "turns.y4m", "turns.fbs")
        self.succeed("export", "turns.fbs", "turns.json")
        rows = json.loads((self.folder / "turns.json").read_text())["frames"]
        turned, frontal = (next(n for n in range(15, 60) if (abs(rows[n]["face"]["pose"]["ry_deg"]) > 15) == is_turned)
                           for is_turned in (True, False))
        self.assertLess(turned, frontal)
        self.assertEqual(self.thumbnail("turns.fbs", "--from", "0.5"), frontal)

    def test_thumbnail_of_a_cut_stream(self):
        self.write("cut.fbs", TALK_FBS.read_bytes()[:-100])
        self.succeed("decode", "cut.fbs", "out.png", "--thumbnail", "88")
