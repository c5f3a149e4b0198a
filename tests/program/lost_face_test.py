"""A lost face is found again, and the pictures in between stay plausible.

The talker's pictures are covered, shifted or blacked out; the true position of the face is known all the time. Each test
prints the pictures that are out of bounds."""
import math
import pathlib
import statistics
import sys

from edited_pictures import black, covered, flat, hand, pushed_aside, y4m_bytes
from harness import CLOSE_TRUTH, CLOSE_Y4M, ProgramTest, read_y4m

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "truth"))
import truth  # noqa: E402  (lives beside the programs that measure)

FIRST_LOST = 70          # after the two seconds that the encoder collects first
GONE = 30                # pictures, one second
WITHIN = 15              # pictures from its return until it must be found: half a second
FOUND_PERCENT = 8.0      # mean landmark error in eye distances; undisturbed it is 6.8
SIZE_OFF, PLACE_OFF = 0.30, 1.0  # of the last good size; eye distances from the last good place
FACE = range(17, 68)     # without the jaw, which is hidden at times
GAP_DB = 16              # luma PSNR of the face in between, against the picture without the hand
WORSE_DB = 0.75          # allowed loss of PSNR after the return, against the run without: patterns of what covers cost rate


def box_of(true, margin):
    xs, ys = [p[0] for p in true.points], [p[1] for p in true.points]
    return int(min(xs) - margin), int(min(ys) - margin), int(max(xs) + margin), int(max(ys) + margin)


def psnr(a, b, width, box):
    left, top, right, bottom = box
    error = sum((p - q) ** 2 for y in range(top, bottom)
                for p, q in zip(a[y * width + left:y * width + right], b[y * width + left:y * width + right]))
    return 10 * math.log10(255 ** 2 * (right - left) * (bottom - top) / max(error, 1e-6))


class LostFace(ProgramTest):
    maxDiff = None

    def setUp(self):
        super().setUp()
        self.clip, self.true = read_y4m(CLOSE_Y4M), truth.read_truth(CLOSE_TRUTH)
        self.width, self.height = self.clip.width, self.clip.height

    def encode(self, video, stream):
        """With patterns of one size: half size takes a third of the rate off, and is compared with full size."""
        self.succeed("encode", video, stream, "--quiet", "--full-size-patterns")

    def coded(self, pictures):
        """(exported pictures, decoded Y4M)"""
        self.write("in.y4m", y4m_bytes(self.width, self.height, pictures))
        self.encode("in.y4m", "out.fbs")
        self.succeed("export", "out.fbs", "out.csv")
        return truth.read(self.folder / "out.csv"), self.decoded("out.fbs")

    def error(self, found, true):
        """Mean landmark error in percent; nan where nothing is given."""
        distances = truth.landmark_error(found, true, FACE)
        return statistics.fmean(distances) if len(distances) > len(FACE) // 2 else math.nan

    def check(self, found, true, lost, back):
        """`lost`: the first picture without the face; `back`: the first that shows all of it again."""
        complaints, good = [], found[lost - 1]
        errors = [self.error(f, t) for f, t in zip(found, true, strict=True)]
        for i, f in enumerate(found):
            if not math.isfinite(f.scale):  # no face in this scene: allowed while there is none
                if i >= back + WITHIN:
                    complaints.append(f"picture {i}: no face")
                continue
            if errors[i] <= FOUND_PERCENT:
                good = f
                continue
            if i >= back + WITHIN:
                complaints.append(f"picture {i}: landmarks off by {errors[i]:.1f} %")
            if i < lost:
                continue
            if abs(f.scale / good.scale - 1) > SIZE_OFF:
                complaints.append(f"picture {i}: size {f.scale:.1f} px, was {good.scale:.1f}")
            # A wild pose is neither where the face was nor where it is or returns: that may be elsewhere.
            farthest = max(min(truth.distance(p, q), *(truth.distance(p, t.points[k]) for t in (true[i], true[back])))
                           for k, (p, q) in enumerate(zip(f.points, good.points)) if math.isfinite(p[0] + q[0]))
            if farthest > PLACE_OFF * good.scale:
                complaints.append(f"picture {i}: a landmark {farthest / good.scale:.2f} eye distances away")
        recovered = next((i for i in range(back, len(found)) if all(e <= FOUND_PERCENT for e in errors[i:])), None)
        before = statistics.fmean(errors[:lost])
        print(f"lost {lost}, back {back}, found again {recovered}; error before {before:.1f} %, "
              f"most in between {max((e for e in errors[lost:back] if math.isfinite(e)), default=math.nan):.1f} %, "
              f"at the end {statistics.fmean(errors[-10:]):.1f} %; from the return on:",
              *(f"{e:.1f}" for e in errors[back:back + 2 * WITHIN]))
        self.assertEqual(complaints, [])

    def check_pictures(self, decoded, sources, lost, back):
        """`sources`: the acceptable pictures for each picture; the closest one counts."""
        plain = self.decoded_plain()
        box = [box_of(t, 4) for t in self.true]
        box = [(max(0, l), max(0, t), min(self.width, r), min(self.height, b)) for l, t, r, b in box]
        gap = [max(psnr(decoded.pictures[i], s[i], self.width, box[i]) for s in sources) for i in range(lost, back)]
        self.assertGreater(min(gap), GAP_DB, [round(g, 1) for g in gap])
        after = range(back + WITHIN, len(self.clip.pictures))
        mean = lambda video: statistics.fmean(
            psnr(video.pictures[i], self.clip.pictures[i], self.width, box[i]) for i in after)
        ours, theirs = mean(decoded), mean(plain)
        print(f"face in between {min(gap):.1f} to {max(gap):.1f} dB; after the return {ours:.2f} dB, "
              f"without the loss {theirs:.2f} dB")
        self.assertGreater(ours, theirs - WORSE_DB)

    def decoded_plain(self):
        """The clip in which the face is never lost."""
        self.encode(CLOSE_Y4M, "plain.fbs")
        return self.decoded("plain.fbs")

    def test_without_a_loss_every_picture_is_good(self):
        """Otherwise the other tests prove nothing."""
        found, _ = self.coded(self.clip.pictures)
        errors = [self.error(f, t) for f, t in zip(found, self.true, strict=True)]
        print(f"mean {statistics.fmean(errors):.1f} %, worst {max(errors):.1f} % at picture {errors.index(max(errors))}")
        self.assertLess(max(errors), FOUND_PERCENT)

    def cover(self, colour, first=FIRST_LOST, box_at=lambda box, k: box):
        """`colour` in a box over the face from picture `first` on; `box_at` says where it is after k pictures."""
        box, back = box_of(self.true[first], 8), first + GONE
        pictures = list(self.clip.pictures)
        for k in range(GONE):
            pictures[first + k] = covered(pictures[first + k], self.width, self.height, box_at(box, k), colour)
        found, decoded = self.coded(pictures)
        self.check(found, self.true, first, back)
        # Patterns may show what covers the face.
        self.check_pictures(decoded, [self.clip.pictures, pictures], first, back)

    def test_covered_by_something_flat(self):
        self.cover(flat)

    def test_covered_by_a_hand(self):
        self.cover(hand)

    def test_covered_before_the_stream_begins(self):
        """Within the two seconds from which the encoder learns the layers."""
        self.cover(hand, first=15)

    def test_a_hand_over_mouth_and_chin(self):
        self.cover(hand, box_at=lambda box, k: (box[0], (box[1] + box[3]) // 2, box[2], box[3]))

    def test_a_hand_that_wipes_across(self):
        def wiping(box, k):
            left = box[0] + round((box[2] - box[0]) * (2 * k / (GONE - 1) - 1))
            return left, box[1], left + box[2] - box[0], box[3]
        self.cover(hand, box_at=wiping)

    def test_out_of_the_picture_and_back(self):
        steps = 25
        way = [2 * round(self.width / 2 * (0.5 - 0.5 * math.cos(math.pi * k / steps))) for k in range(steps + 1)]
        by = [0] * (FIRST_LOST - steps) + way + [self.width] * GONE + way[::-1]
        by += [0] * (len(self.clip.pictures) - len(by))
        pictures = [pushed_aside(p, self.width, self.height, b) for p, b in zip(self.clip.pictures, by, strict=True)]
        for true, b in zip(self.true, by):
            true.points = [(x + b, y) for x, y in true.points]
        inside = [max(p[0] for p in true.points) < self.width for true in self.true]
        lost = inside.index(False)
        back = inside.index(True, lost)
        found, _ = self.coded(pictures)
        self.check(found, self.true, lost, back)

    def cut_to_black(self, elsewhere=0):
        """`elsewhere`: how far to the right of its expected position the face returns, pixels."""
        pictures, back = list(self.clip.pictures), FIRST_LOST + GONE
        pictures[FIRST_LOST:back] = [black(pictures[0], self.width, self.height)] * GONE
        for i in range(back, len(pictures)):
            pictures[i] = pushed_aside(pictures[i], self.width, self.height, elsewhere)
            self.true[i].points = [(x + elsewhere, y) for x, y in self.true[i].points]
        found, decoded = self.coded(pictures)
        self.check(found, self.true, FIRST_LOST, back)
        return decoded, pictures

    def test_cut_to_black_and_back(self):
        decoded, pictures = self.cut_to_black()
        self.check_pictures(decoded, [self.clip.pictures, pictures], FIRST_LOST, FIRST_LOST + GONE)

    def test_cut_to_black_and_back_elsewhere(self):
        """One and a half eye distances away: out of reach for flow and alignment, so the search must find it."""
        self.cut_to_black(elsewhere=2 * round(0.75 * self.true[0].scale))
