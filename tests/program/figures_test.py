"""The paper's figures can be drawn: the one with teeth shows the effect of repulsion, and another face opens its mouth as
the one that is followed does. So can the pictures of docs/how-it-works.md."""
import re
import struct
import subprocess

from harness import BUILD, MAX_SECONDS, ProgramTest

TALKERS = tuple(f"talker_figure{number}.png" for number in (1, 3, 4, 5, 6, 7))
FIGURES = ("figure2.png", "painted_figure1.png", *TALKERS)
STEPS = {"adaptation": 3, "contours": 3, "patterns": 4, "decoded": 4}  # panels of step_pictures


def png_size(data):
    assert data[:8] == b"\x89PNG\r\n\x1a\n" and data.endswith(b"IEND\xaeB`\x82"), "not a whole PNG"
    return struct.unpack(">2I", data[16:24])


class Figures(ProgramTest):
    def test_step_pictures(self):
        done = subprocess.run([BUILD / "step_pictures", self.folder / "out"], capture_output=True, text=True,
                              timeout=MAX_SECONDS)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        files = self.files()
        self.assertEqual(set(files), {f"out/{name}_{i + 1}.png" for name, count in STEPS.items() for i in range(count)})
        for name in STEPS:  # they stand beside each other
            heights = {png_size(data)[1] for file, data in files.items() if file.startswith(f"out/{name}_")}
            self.assertEqual(len(heights), 1, name)
        self.assertEqual(len(set(files.values())), len(files), "no panel shows the same as another")

    def test_paper_figures(self):
        done = subprocess.run([BUILD / "paper_figures", self.folder / "out"], capture_output=True, text=True,
                              timeout=MAX_SECONDS)
        self.assertEqual(done.returncode, 0, done.stderr)
        files = self.files()
        self.assertEqual(sorted(files), sorted("out/" + name for name in FIGURES))
        for name, data in files.items():
            width, height = png_size(data)
            self.assertTrue(500 < width < 2000 and 300 < height < 1500, (name, width, height))
            # Drawn pictures: blank panels compress to nothing.
            self.assertGreater(len(data), 0.05 * width * height, name)

        heights = {name: list(map(float, numbers)) for name, *numbers in
                   re.findall(r"^teeth (\S+) without (\S+) with (\S+) true (\S+)$", done.stdout, re.MULTILINE)}
        self.assertEqual(set(heights), {"painted", "talker"})
        without, with_repulsion, _ = heights["painted"]
        self.assertLess(without, 0.7 * with_repulsion, "teeth no longer collapse the contour: show another case")
        _, with_repulsion, true = heights["talker"]
        self.assertAlmostEqual(with_repulsion, true, delta=0.1 * true)

        own_shut, own_open, other_shut, other_open = map(float, re.search(
            r"^lips talker own (\S+) (\S+) other (\S+) (\S+)$", done.stdout, re.MULTILINE).groups())
        self.assertGreater(own_open - own_shut, 0.05, "the contours alone open the mouth")
        self.assertAlmostEqual(other_open - other_shut, own_open - own_shut, delta=0.25 * (own_open - own_shut))
