"""Pictures with something over the face, pushed aside, or black. 8 bits, 4:2:0; Python's standard library only."""
import math


class Rows:
    """Luma and chroma of one picture as rows that can be written."""

    def __init__(self, data, width, height):
        self.planes, at = [], 0
        for w, h in ((width, height), *2 * [((width + 1) // 2, (height + 1) // 2)]):
            self.planes.append([bytearray(data[at + y * w:at + (y + 1) * w]) for y in range(h)])
            at += w * h

    def bytes(self):
        return b"".join(b"".join(map(bytes, plane)) for plane in self.planes)


def y4m_bytes(width, height, pictures):
    return b"YUV4MPEG2 W%d H%d F30:1 Ip A1:1 C420jpeg XCOLORRANGE=LIMITED\n" % (width, height) + b"".join(
        b"FRAME\n" + p for p in pictures)


def covered(data, width, height, box, colour):
    """The picture with `colour`(x, y) -> (Y, U, V) in a box."""
    rows = Rows(data, width, height)
    left, top, right, bottom = (max(0, box[0]), max(0, box[1]), min(width, box[2]), min(height, box[3]))
    for y in range(top, bottom):
        for x in range(left, right):
            rows.planes[0][y][x], u, v = colour(x, y)
            rows.planes[1][y // 2][x // 2], rows.planes[2][y // 2][x // 2] = u, v
    return rows.bytes()


def pushed_aside(data, width, height, by):
    """The picture moved `by` (even) pixels to the right; its left column fills the gap."""
    rows = Rows(data, width, height)
    for plane, step in zip(rows.planes, (by, by // 2, by // 2)):
        for row in plane:
            row[:] = (row[:1] * step + row)[:len(row)]
    return rows.bytes()


def flat(x, y):
    return 90, 128, 128


def hand(x, y):
    """Skin with folds and the dark between fingers."""
    finger = abs(x % 14 - 7) / 7
    return int(150 - 70 * finger ** 4 + 8 * math.sin(0.9 * y + 0.3 * x)), 112, 150


def black(data, width, height):
    rows = Rows(data, width, height)
    rows.planes = [[bytearray([level]) * len(row) for row in plane]
                   for plane, level in zip(rows.planes, (16, 128, 128))]
    return rows.bytes()
