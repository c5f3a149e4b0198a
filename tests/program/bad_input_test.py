"""Bad input gives one line of error and exit code 2, and leaves no files behind."""
import os
import wave

from harness import TALK_FBS, TALK_Y4M, ProgramTest, ffmpeg, flat_y4m, talker

NO_FACE = "no face"
NO_FILE = "No such file or directory"


def marks(text):
    return {"marks.json": text}


def cut(end):
    """A part of the talker's stream; a function, since the table below is read before the stream exists."""
    return lambda: TALK_FBS.read_bytes()[:end]


# name: (files to create, arguments, words that the error line must contain)
# The content of a file is bytes, a function that returns them, or the target of a link.
TABLE = {
    # INPUT of encode
    "encode_missing_file":      ({}, "encode absent.mkv out.fbs", ["absent.mkv", NO_FILE]),
    "encode_missing_y4m":       ({}, "encode absent.y4m out.fbs", ["absent.y4m", NO_FILE]),
    "encode_missing_images":    ({}, "encode absent_%05d.png out.fbs", ["absent_%05d.png", "no such images"]),
    "encode_folder_without_images": ({"folder/readme": b"hello"}, "encode folder out.fbs", ["folder", "no such images"]),
    "encode_folder_named_y4m":  ({"folder.y4m/readme": b"hello"}, "encode folder.y4m out.fbs", ["folder.y4m"]),
    "encode_text":              ({"text.mkv": b"not a video\n" * 100}, "encode text.mkv out.fbs", ["text.mkv", "not a video"]),
    "encode_text_named_y4m":    ({"text.y4m": b"not a video\n" * 100}, "encode text.y4m out.fbs", ["text.y4m", "not a Y4M"]),
    "encode_stream":            ({}, "encode TALK.fbs out.fbs", ["TALK.fbs", "an fbs stream", "fbs decode"]),
    "track_stream":             ({}, "track TALK.fbs out.csv", ["TALK.fbs", "an fbs stream"]),
    "encode_empty_file":        ({"empty.mkv": b""}, "encode empty.mkv out.fbs", ["empty.mkv"]),
    "encode_empty_y4m":         ({"empty.y4m": b""}, "encode empty.y4m out.fbs", ["empty.y4m", "empty"]),
    "encode_empty_standard_input": ({}, "encode - out.fbs", ["standard input"]),
    "encode_no_picture":        ({"none.y4m": flat_y4m(128, 96, 0)}, "encode none.y4m out.fbs", ["none.y4m", "no picture"]),
    "encode_flat_pictures":     ({"flat.y4m": flat_y4m(128, 96, 5)}, "encode flat.y4m out.fbs", ["flat.y4m", NO_FACE, "--allow-no-face"]),
    "encode_gradient":          ({"ramp.y4m": flat_y4m(128, 96, 5, lambda x, y: x + y)}, "encode ramp.y4m out.fbs",
                                 ["ramp.y4m", NO_FACE]),
    "encode_small_pictures":    ({"small.y4m": flat_y4m(62, 62, 3)}, "encode small.y4m out.fbs", ["small.y4m", "62x62", "64"]),
    "encode_cut_picture":       ({"cut.y4m": flat_y4m(128, 96, 3)[:-100]}, "encode cut.y4m out.fbs", ["cut.y4m"]),
    "encode_damaged_y4m_header": ({"bad.y4m": b"YUV4MPEG2 W128 Hx F25:1\nFRAME\n"}, "encode bad.y4m out.fbs",
                                  ["bad.y4m", "header"]),
    "encode_unknown_chroma":    ({"bad.y4m": b"YUV4MPEG2 W128 H96 F25:1 C999\nFRAME\n"}, "encode bad.y4m out.fbs",
                                 ["bad.y4m", "chroma", "999"]),
    "encode_huge_y4m":          ({"huge.y4m": b"YUV4MPEG2 W999999999 H999999999 F25:1\nFRAME\n"}, "encode huge.y4m out.fbs",
                                 ["huge.y4m", "8192"]),
    "encode_no_camera":         ({}, "encode camera:77 out.fbs", ["camera:77"]),
    "encode_camera_without_number": ({}, "encode camera:front out.fbs", ["camera:front"]),
    # OUTPUT of encode
    "encode_into_missing_folder": ({}, "encode TALK.y4m absent/out.fbs", ["absent/out.fbs", NO_FILE]),
    "encode_onto_folder":       ({"out.fbs/readme": b"hello"}, "encode TALK.y4m out.fbs", ["out.fbs", "directory"]),
    "encode_onto_full_disk":    ({}, "encode TALK.y4m /dev/full", ["/dev/full", "No space left"]),
    "encode_overlay_into_missing_folder": ({}, "encode TALK.y4m out.fbs --overlay absent/see.mp4", ["absent/see.mp4", NO_FILE]),
    "encode_overlay_of_unknown_kind": ({}, "encode TALK.y4m out.fbs --overlay see.docx", ["see.docx"]),
    # --marks
    "marks_missing":            ({}, "encode TALK.y4m out.fbs --marks absent.json", ["absent.json", NO_FILE]),
    "marks_not_json":           (marks(b"{"), "encode TALK.y4m out.fbs --marks marks.json", ["marks.json"]),
    "marks_not_an_object":      (marks(b"[1, 2]"), "encode TALK.y4m out.fbs --marks marks.json", ["marks.json"]),
    "marks_empty":              (marks(b"{}"), "encode TALK.y4m out.fbs --marks marks.json", ["marks.json"]),
    "marks_too_few_landmarks":  (marks(b'{"landmarks": [[1, 2], [3, 4]]}'), "encode TALK.y4m out.fbs --marks marks.json",
                                 ["marks.json"]),
    "marks_not_numbers":        (marks(b'{"nose_tip": ["a", "b"]}'), "encode TALK.y4m out.fbs --marks marks.json", ["marks.json"]),
    "marks_infinite":           (marks(b'{"nose_tip": [1e999, 5]}'), "encode TALK.y4m out.fbs --marks marks.json", ["marks.json"]),
    # streams
    "decode_missing_file":      ({}, "decode absent.fbs out.y4m", ["absent.fbs", NO_FILE]),
    "decode_folder":            ({"folder/readme": b"hello"}, "decode folder out.y4m", ["folder"]),
    "decode_empty_file":        ({"empty.fbs": b""}, "decode empty.fbs out.y4m", ["empty.fbs", "not an fbs stream"]),
    "decode_empty_standard_input": ({}, "decode - out.y4m", ["standard input", "not an fbs stream"]),
    "decode_text":              ({"text.fbs": b"not a stream\n" * 100}, "decode text.fbs out.y4m", ["text.fbs", "not an fbs stream"]),
    "decode_magic_alone":       ({"magic.fbs": cut(4)}, "decode magic.fbs out.y4m", ["magic.fbs"]),
    "decode_cut_stream":        ({"cut.fbs": cut(-3)}, "decode cut.fbs out.y4m", ["cut.fbs", "ends inside a packet", "at byte"]),
    "decode_cut_stream_to_mp4": ({"cut.fbs": cut(-3)}, "decode cut.fbs out.mp4", ["cut.fbs", "ends inside a packet"]),
    "decode_cut_stream_to_images": ({"cut.fbs": cut(1000)}, "decode cut.fbs out_%03d.png", ["cut.fbs", "ends inside a packet"]),
    "decode_from_past_the_end": ({}, "decode TALK.fbs out.y4m --from 4", ["TALK.fbs", "--from", "4.00 s long"]),
    "decode_from_before_the_start": ({}, "decode TALK.fbs out.y4m --from -1", ["--from"]),
    "decode_from_no_stream":    ({"text.fbs": b"not a stream\n" * 100}, "decode text.fbs out.y4m --from 1",
                                 ["text.fbs", "not an fbs stream"]),
    "inspect_text":             ({"text.fbs": b"not a stream\n" * 100}, "inspect text.fbs", ["text.fbs", "not an fbs stream"]),
    "inspect_cut_stream":       ({"cut.fbs": cut(-3)}, "inspect cut.fbs --json", ["cut.fbs", "at byte"]),
    "export_cut_stream":        ({"cut.fbs": cut(-3)}, "export cut.fbs out.csv", ["cut.fbs", "at byte"]),
    "evaluate_cut_stream":      ({"cut.fbs": cut(-3)}, "evaluate TALK.y4m cut.fbs --json", ["cut.fbs", "at byte"]),
    "evaluate_missing_source":  ({}, "evaluate absent.mkv", ["absent.mkv", NO_FILE]),
    "evaluate_flat_pictures":   ({"flat.y4m": flat_y4m(128, 96, 5)}, "evaluate flat.y4m", ["flat.y4m", NO_FACE]),
    "evaluate_other_length":    ({"short.y4m": flat_y4m(176, 144, 5)}, "evaluate short.y4m TALK.fbs", ["TALK.fbs", "short.y4m", "more"]),
    "evaluate_other_size":      ({"other.y4m": flat_y4m(128, 96, 120)}, "evaluate other.y4m TALK.fbs", ["TALK.fbs", "size"]),
    "evaluate_missing_folder":  ({}, "evaluate absent --jobs 2", ["absent", NO_FILE]),
    "retarget_missing_face":    ({}, "retarget --motion TALK.fbs --face absent.jpg out.fbs", ["absent.jpg", NO_FILE]),
    "play_missing_file":        ({}, "play absent.fbs", ["absent.fbs", NO_FILE]),
    # OUTPUT of decode and export
    "decode_into_missing_folder": ({}, "decode TALK.fbs absent/out.y4m", ["absent/out.y4m", NO_FILE]),
    "decode_mp4_into_missing_folder": ({}, "decode TALK.fbs absent/out.mp4", ["absent/out.mp4", NO_FILE]),
    "decode_images_into_missing_folder": ({}, "decode TALK.fbs absent/out_%03d.png", ["absent/out_", NO_FILE]),
    "decode_to_unknown_kind":   ({}, "decode TALK.fbs out.docx", ["out.docx"]),
    "decode_sound_missing":     ({}, "decode TALK.fbs out.mkv --sound absent.wav", ["absent.wav", NO_FILE]),
    "decode_sound_to_y4m":      ({}, "decode TALK.fbs out.y4m --sound TALK.y4m", ["out.y4m", "sound"]),
    "thumbnail_to_standard_output": ({}, "decode TALK.fbs - --thumbnail 64", ["--thumbnail", "OUTPUT"]),
    "thumbnail_into_missing_folder": ({}, "decode TALK.fbs absent/out.png --thumbnail 64", ["absent/out.png", NO_FILE]),
    "thumbnail_onto_full_disk": ({"out.png": "/dev/full"}, "decode TALK.fbs out.png --thumbnail 64", ["out.png", "No space left"]),
    "thumbnail_of_text":        ({"text.fbs": b"not a stream\n"}, "decode text.fbs out.png --thumbnail 64", ["text.fbs", "not an fbs stream"]),
    "thumbnail_of_no_size":     ({}, "decode TALK.fbs out.png --thumbnail 0", ["--thumbnail"]),
    "thumbnail_and_md5":        ({}, "decode TALK.fbs out.png --thumbnail 64 --md5", ["--thumbnail", "--md5"]),
    "export_to_unknown_kind":   ({}, "export TALK.fbs out.docx", ["out.docx"]),
    "export_model_of_cut_stream": ({"cut.fbs": cut(-3)}, "export cut.fbs head.glb", ["cut.fbs", "at byte"]),
    "export_missing_file":      ({}, "export absent.fbs head.glb", ["absent.fbs", NO_FILE]),
    "export_model_into_missing_folder": ({}, "export TALK.fbs absent/head.glb", ["absent/head.glb", NO_FILE]),
    "export_mesh_into_missing_folder": ({}, "export TALK.fbs absent/head_%05d.obj", ["absent/head_00001.obj", NO_FILE]),
    "export_model_onto_full_disk": ({"out.glb": "/dev/full"}, "export TALK.fbs out.glb", ["out.glb", "No space left"]),
    "export_into_missing_folder": ({}, "export TALK.fbs absent/out.csv", ["absent/out.csv", NO_FILE]),
    "export_onto_full_disk":    ({"out.csv": "/dev/full"}, "export TALK.fbs out.csv", ["out.csv", "No space left"]),
    "decode_y4m_onto_full_disk": ({"out.y4m": "/dev/full"}, "decode TALK.fbs out.y4m", ["out.y4m", "No space left"]),
    "decode_mkv_onto_full_disk": ({"out.mkv": "/dev/full"}, "decode TALK.fbs out.mkv", ["out.mkv", "No space left"]),
    # the command line
    "no_verb":                  ({}, "", ["--help"]),
    "unknown_verb":             ({}, "transmogrify TALK.y4m", ["no verb transmogrify", "--help"]),
    "option_before_the_verb":   ({}, "--quality 5 encode TALK.y4m out.fbs", ["--quality before the verb"]),
    "verb_without_names":       ({}, "retarget out.fbs", ["--motion", "see fbs retarget --help"]),
    "unknown_option":           ({}, "encode TALK.y4m out.fbs --colour", ["--colour"]),
    "encode_without_output":    ({}, "encode TALK.y4m", ["OUTPUT"]),
    "too_many_names":           ({}, "inspect TALK.fbs TALK.fbs TALK.fbs", ["--help"]),
    "quality_too_high":         ({}, "encode TALK.y4m out.fbs --quality 101", ["--quality", "101"]),
    "quality_negative":         ({}, "encode TALK.y4m out.fbs --quality -1", ["--quality", "-1"]),
    "quality_not_a_number":     ({}, "encode TALK.y4m out.fbs --quality best", ["--quality", "best"]),
    "quality_missing":          ({}, "encode TALK.y4m out.fbs --quality", ["--quality"]),
    "bitrate_zero":             ({}, "encode TALK.y4m out.fbs --bitrate 0", ["--bitrate"]),
    "motion_bitrate_negative":  ({}, "encode TALK.y4m out.fbs --motion-bitrate -1", ["--motion-bitrate", "-1"]),
    "face_negative":            ({}, "encode TALK.y4m out.fbs --face -1", ["--face", "-1"]),
    "face_that_is_not_there":   ({}, "encode TALK.y4m out.fbs --face 3", ["TALK.y4m", "face"]),
    "frames_zero":              ({}, "encode TALK.y4m out.fbs --frames 0", ["--frames", "0"]),
    "frames_not_whole":         ({}, "encode TALK.y4m out.fbs --frames 1.5", ["--frames", "1.5"]),
    "frames_not_a_number":      ({}, "encode TALK.y4m out.fbs --frames all", ["--frames", "all"]),
    "duration_zero":            ({}, "encode TALK.y4m out.fbs --duration 0", ["--duration", "0"]),
    "duration_negative":        ({}, "encode TALK.y4m out.fbs --duration -2", ["--duration", "-2"]),
    "duration_not_finite":      ({}, "encode TALK.y4m out.fbs --duration nan", ["--duration", "nan"]),
    "duration_with_a_unit":     ({}, "encode TALK.y4m out.fbs --duration 2min", ["--duration", "2min"]),
    "bitrate_not_a_number":     ({}, "encode TALK.y4m out.fbs --bitrate nan", ["--bitrate", "nan"]),
    "rate_zero":                ({}, "encode TALK.y4m out.fbs --rate 0", ["--rate"]),
    # options that would do nothing
    "delay_without_live":       ({}, "encode TALK.y4m out.fbs --delay 1", ["--delay", "--live"]),
    "threads_zero":             ({}, "encode TALK.y4m out.fbs --threads 0", ["--threads"]),
    "buffer_without_bitrate":   ({}, "encode TALK.y4m out.fbs --live --buffer 1", ["--buffer", "--bitrate"]),
    "start_without_bitrate":    ({}, "encode TALK.y4m out.fbs --start 1", ["--start", "--bitrate"]),
    "start_negative":           ({}, "encode TALK.y4m out.fbs --bitrate 5 --start -1", ["--start", "-1"]),
    "start_not_a_number":       ({}, "encode TALK.y4m out.fbs --bitrate 5 --start nan", ["--start", "nan"]),
    "start_of_one_pattern":     ({}, "encode TALK.y4m out.fbs --bitrate 5 --start 1 --patterns 1", ["start", "pattern"]),
    "start_where_all_need_it":  ({}, "encode TALK.y4m out.fbs --live --bitrate 5 --start 1 --resilience strong",
                                 ["start", "strong"]),
    "rate_of_a_video":          ({}, "encode TALK.y4m out.fbs --rate 10", ["--rate", "images", "TALK.y4m"]),
    "track_rate_of_a_video":    ({}, "track TALK.y4m out.csv --rate 10", ["--rate", "images", "TALK.y4m"]),
    "vfr_of_what_has_times":    ({}, "decode TALK.fbs out.mp4 --vfr", ["--vfr", "Y4M"]),
    "evaluate_quality_too_high": ({}, "evaluate TALK.y4m --quality 20 200", ["--quality", "200"]),
}


class BadInput(ProgramTest):
    def test_table(self):
        for name, row in TABLE.items():
            with self.subTest(name):
                self.new_folder()
                self.row(*row)

    def row(self, files, arguments, says):
        for name, source in (("TALK.y4m", TALK_Y4M), ("TALK.fbs", TALK_FBS)):
            if name in arguments:
                os.symlink(source, self.folder / name)
        for name, content in files.items():
            path = self.folder / name
            path.parent.mkdir(exist_ok=True)
            if isinstance(content, str):
                os.symlink(content, path)
            else:
                path.write_bytes(content() if callable(content) else content)
        self.fail_cleanly(*arguments.split(), says=says)

    def test_encode_sound_alone(self):
        with wave.open(str(self.folder / "sound.wav"), "wb") as sound:
            sound.setparams((1, 2, 8000, 0, "NONE", ""))
            sound.writeframes(bytes(16000))
        self.fail_cleanly("encode", "sound.wav", "out.fbs", says=["sound.wav", "no video"])

    def test_encode_images_of_different_sizes(self):
        for name, size in (("1.png", "176x144"), ("2.png", "128x96")):
            ffmpeg("-f", "lavfi", "-i", "testsrc=size=" + size, "-frames:v", "1", self.folder / name)
        self.fail_cleanly("encode", "%d.png", "out.fbs", "--allow-no-face", says=["2.png", "128x96"])

    def test_evaluate_shorter_stream(self):
        talker(self.folder / "long.y4m", "--size", "176x144", "--frames", "125")
        self.fail_cleanly("evaluate", "long.y4m", TALK_FBS, says=["long.y4m", "fewer"])

    def test_failed_encode_keeps_the_old_file(self):
        self.write("flat.y4m", flat_y4m(128, 96, 5))
        self.write("out.fbs", b"as it was")
        self.fail_cleanly("encode", "flat.y4m", "out.fbs", says=["flat.y4m", NO_FACE])

    def test_failed_decode_keeps_the_old_file(self):
        self.write("cut.fbs", cut(-3)())
        self.write("out.y4m", b"as it was")
        self.fail_cleanly("decode", "cut.fbs", "out.y4m", says=["cut.fbs"])

    def test_disk_that_fills_leaves_no_y4m(self):
        self.fail_cleanly("decode", TALK_FBS, "out.y4m", says=["out.y4m"], largest_file=100_000)

    def test_disk_that_fills_leaves_no_mp4(self):
        self.fail_cleanly("decode", TALK_FBS, "out.mp4", says=["out.mp4"], largest_file=2_000)

    def test_disk_that_fills_leaves_no_image(self):
        self.fail_cleanly("decode", TALK_FBS, "out_%03d.png", says=["out_001.png"], largest_file=2_000)

    def test_disk_that_fills_leaves_no_stream(self):
        self.fail_cleanly("encode", TALK_Y4M, "out.fbs", says=["out.fbs"], largest_file=1_000)

    def test_disk_that_fills_leaves_no_stream_of_what_memory_does_not_hold(self):
        head, end, pictures = TALK_Y4M.read_bytes().partition(b"\n")
        self.write("long.y4m", head + end + 2 * pictures)
        self.fail_cleanly("encode", "long.y4m", "out.fbs", says=["temporary directory"], largest_file=1_000)

    def test_disk_that_fills_leaves_no_table(self):
        self.fail_cleanly("export", TALK_FBS, "out.csv", says=["out.csv"], largest_file=10_000)

    def test_full_standard_output(self):
        for arguments in (("decode", TALK_FBS, "-"), ("decode", TALK_FBS, "--md5"), ("decode", TALK_FBS, "out.y4m", "--md5"),
                          ("encode", TALK_Y4M, "-", "--frames", 5), ("inspect", TALK_FBS),
                          ("inspect", TALK_FBS, "--json"), ("inspect", TALK_FBS, "--packets"), ("evaluate", TALK_Y4M, TALK_FBS),
                          ("evaluate", TALK_Y4M, TALK_FBS, "--json"), ("--help",), ("inspect", "--help"), ("--version",)):
            with self.subTest(arguments), open("/dev/full", "wb") as full:
                self.fail_cleanly(*arguments, says=["cannot write standard output"], stdout=full)

    def test_full_standard_output_of_the_overlay(self):
        with open("/dev/full", "wb") as full:
            self.fail_cleanly("encode", TALK_Y4M, "out.fbs", "--frames", 5, "--overlay", "-",
                              says=["standard output", "No space left"], stdout=full)
