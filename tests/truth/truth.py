"""Tables of poses and landmarks, and their differences. Python's standard library only.

The talker counts (0, 0) at the centre of the first pixel, fbs at its corner: read_truth() adds the half.
"""
import csv
import math
import statistics

FEATURES = {"jaw": range(0, 17), "brows": range(17, 27), "nose": range(27, 36), "eyes": range(36, 48),
            "outer": range(48, 60), "inner": range(60, 68)}
ANGLES = ("rx_deg", "ry_deg", "rz_deg")


class Picture:
    """One row: angles in degrees (pitch, yaw, roll), shift in pixels, scale = eye distance in pixels when frontal,
    68 points in pixels, and which of them are visible."""

    def __init__(self, row, half):
        value = lambda name: float(row[name])
        self.angles = tuple(map(value, ANGLES))
        self.shift = (value("tx_px") + half, value("ty_px") + half)
        self.scale = value("scale")
        self.points = [(value(f"x{k}") + half, value(f"y{k}") + half) for k in range(68)]
        self.seen = [row.get(f"v{k}", "1") == "1" and math.isfinite(self.points[k][0]) for k in range(68)]
        self.rotation = rotation(self.angles)


def read(path, half=0.0):
    with open(path, newline="") as table:
        return [Picture(row, half) for row in csv.DictReader(table)]


def read_truth(path):
    return read(path, 0.5)


def rotation(angles):
    """Rz(roll) Ry(yaw) Rx(pitch); tests/talker/README.md and SPEC agree on it."""
    (cx, sx), (cy, sy), (cz, sz) = ((math.cos(math.radians(a)), math.sin(math.radians(a))) for a in angles)
    return ((cz * cy, cz * sy * sx - sz * cx, cz * sy * cx + sz * sx),
            (sz * cy, sz * sy * sx + cz * cx, sz * sy * cx - cz * sx),
            (-sy, cy * sx, cy * cx))


def turn(a, b):
    """a * transpose(b): the rotation from b to a."""
    return tuple(tuple(sum(a[i][k] * b[j][k] for k in range(3)) for j in range(3)) for i in range(3))


def degrees(r):
    """Pitch, yaw, roll of a rotation."""
    return tuple(map(math.degrees, (math.atan2(r[2][1], r[2][2]), math.asin(max(-1, min(1, -r[2][0]))),
                                    math.atan2(r[1][0], r[0][0]))))


def angle(r):
    """Angle of a rotation, degrees. From its antisymmetric part, which is exact for small angles."""
    sine = math.hypot(r[2][1] - r[1][2], r[0][2] - r[2][0], r[1][0] - r[0][1]) / 2
    return math.degrees(math.atan2(sine, (r[0][0] + r[1][1] + r[2][2] - 1) / 2))


def distance(a, b):
    return math.hypot(a[0] - b[0], a[1] - b[1])


def origin_between(found, truth):
    """Origin of the found head frame in the true one (eye distances): the 3-vector c that makes
    found.shift = truth.shift + truth.scale * R * c hold best over all pictures. Two heads need not agree on it, and a
    turn shows the difference as a shift. Least squares, with so little of a prior that a head that never turns has
    no depth."""
    a, b = [[1e-6 * (i == j) for j in range(3)] for i in range(3)], [0.0] * 3
    for f, t in zip(found, truth):
        for axis in range(2):
            row = [t.scale * t.rotation[axis][k] for k in range(3)]
            off = f.shift[axis] - t.shift[axis]
            for i in range(3):
                b[i] += row[i] * off
                for j in range(3):
                    a[i][j] += row[i] * row[j]
    for i in range(3):  # Gauss; the matrix is positive definite
        for j in range(i + 1, 3):
            share = a[j][i] / a[i][i]
            b[j] -= share * b[i]
            a[j] = [x - share * y for x, y in zip(a[j], a[i])]
    c = [0.0] * 3
    for i in (2, 1, 0):
        c[i] = (b[i] - sum(a[i][j] * c[j] for j in range(i + 1, 3))) / a[i][i]
    return c


def mean_offsets(found, truth):
    """Mean of found - true of each point, pixels: trackers disagree on where a landmark is, not on how it moves."""
    out = []
    for k in range(68):
        off = [(f.points[k][0] - t.points[k][0], f.points[k][1] - t.points[k][1])
               for f, t in zip(found, truth) if f.seen[k] and t.seen[k]]
        out.append((statistics.fmean(o[0] for o in off), statistics.fmean(o[1] for o in off)) if off else (0.0, 0.0))
    return out


def landmark_error(f, t, points, offsets=None):
    """Distances of the points of a picture to the visible true ones, percent of the eye distance."""
    out = []
    for k in points:
        if f.seen[k] and t.seen[k]:
            ox, oy = offsets[k] if offsets else (0.0, 0.0)
            out.append(100 * distance((f.points[k][0] - ox, f.points[k][1] - oy), t.points[k]) / t.scale)
    return out


def openings(picture):
    """Expression measured on the landmarks, relative to the eye distance: mouth, brows, eyes."""
    p = picture.points
    middle = lambda ks: tuple(statistics.fmean(p[k][axis] for k in ks) for axis in range(2))
    eye = distance(middle(range(36, 42)), middle(range(42, 48)))
    return {"mouth": distance(p[62], p[66]) / eye,
            "brows": (distance(middle(range(17, 22)), middle(range(36, 42))) +
                      distance(middle(range(22, 27)), middle(range(42, 48)))) / eye,
            "eyes": sum(distance(p[a], p[b]) for a, b in ((37, 41), (38, 40), (43, 47), (44, 46))) / eye}


def correlation(a, b):
    """nan when one of them does not move."""
    try:
        return statistics.correlation(a, b)
    except statistics.StatisticsError:
        return math.nan
