"""The colours inside the mouth, between the curves of the inner lips (SPEC 10.10)."""

import numpy as np

from .integers import clamp, quotient
from .wire_frame import INNER_LIPS, LEFT_MOUTH_CORNER, MOUTH

WIDTH_LOG2 = 12  # places are in 2^-12 of the mouth's width
WIDTH = 1 << WIDTH_LOG2
MAX_DOWN = 2**15
MAX_AMOUNT = 256  # of mouth colour


def amount(sources, now):
    """How much of the mouth colours shows, of MAX_AMOUNT; `now` is the placement of the mesh in the picture."""
    seen = [(source.regions[MOUTH], source.pattern.placement.gap) for source in sources if not source.still]
    total = sum(weight * clamp(now.gap - max(gap, 2 * gap), 0, MAX_AMOUNT) for weight, gap in seen)
    return (total + 128) // 256


class Opening:
    """The part of a picture between the inner lips.

    frame  wire-frame
    x, y   positions of the head's vertices on the screen, 1/64 luma sample
    """

    def __init__(self, frame, x, y):
        lips = frame.features[INNER_LIPS].vertices
        left = lips.index(frame.landmark_vertices[LEFT_MOUTH_CORNER])
        self._x0, self._y0 = int(x[lips[0]]), int(y[lips[0]])
        self._ax, self._ay = int(x[lips[left]]) - self._x0, int(y[lips[left]]) - self._y0
        square = self._ax * self._ax + self._ay * self._ay
        self.is_drawn = square >= 2**12
        if self.is_drawn:
            self._ux, self._uy = (int(quotient(a << 28, square)) for a in (self._ax, self._ay))
            self._upper, self._lower = (
                _curve([(int(along), int(down)) for along, down in (self._place(int(x[v]), int(y[v])) for v in vertices)])
                for vertices in (lips[:left + 1], lips[:1] + lips[left:][::-1]))

    def _place(self, x, y):
        along = (self._ux * (x - self._x0) + self._uy * (y - self._y0)) >> 16
        return along, clamp((self._ux * (y - self._y0) - self._uy * (x - self._x0)) >> 16, -MAX_DOWN, MAX_DOWN)

    def mix(self, samples, plane, colours, offsets, most):
        """The samples of a plane with the colours mixed in.

        colours  of the plane at the upper and at the lower lip
        offsets  first, middle and last, 1/16 grey level
        most     amount()
        """
        t, h = self._place(plane.centres(np.arange(plane.width))[None, :], plane.centres(np.arange(plane.height))[:, None])
        is_between = (t >= 0) & (t < WIDTH)
        i, f = clamp(t, 0, WIDTH - 1) >> 6, t % 64
        upper, lower = (c[i] + ((c[i + 1] - c[i]) * f >> 6) for c in (self._upper, self._lower))
        depth = np.minimum(h - upper, lower - h)
        gap = np.maximum(lower - upper, 1)
        fade = np.maximum(max(2**18 // max(abs(self._ax), abs(self._ay)), 1), gap * 77 >> 8)
        here = (most * np.minimum(256, np.maximum(depth, 0) * 256 // fade) + 128) // 256
        here = np.where(is_between & (depth > 0), here, 0)
        base = (16 * colours[0], 8 * (colours[0] + colours[1]), 16 * colours[1])
        c0, c1, c2 = (clamp((colour + offset + 8) >> 4, 0, 255) for colour, offset in zip(base, offsets))
        at = clamp((h - upper) * 256 // gap, 0, 256)
        colour = np.where(at < 128, (c0 * (128 - at) + c1 * at + 64) >> 7, (c1 * (256 - at) + c2 * (at - 128) + 64) >> 7)
        return (samples * (256 - here) + colour * here + 128) >> 8


def _curve(points):
    """Heights at 65 places of a curve through points (along, down)."""
    m = len(points) - 1
    t, h = [along for along, _ in points], [down for _, down in points]
    t[0], h[0], t[m], h[m] = 0, 0, WIDTH, 0
    for k in range(1, m):
        t[k] = int(clamp(t[k], t[k - 1] + 1, WIDTH - (m - k)))

    def slope(j, k):
        return int(quotient((h[k] - h[j]) << 12, t[k] - t[j]))
    d = [slope(0, m)] * (m + 1)
    for k in range(1, m):
        d[k] = slope(k - 1, k + 1)
    if m > 1:
        d[0] = int(quotient(3 * slope(0, 1) - d[1], 2))
        d[m] = int(quotient(3 * slope(m - 1, m) - d[m - 1], 2))
    heights = []
    for place in range(0, WIDTH + 1, 64):
        k = max(k for k in range(m) if k == 0 or t[k] <= place)
        w = t[k + 1] - t[k]
        p = ((place - t[k]) << 12) // w
        q = WIDTH - p
        share = p * p * (3 * WIDTH - 2 * p) >> 24
        bend = d[k] * (p * q * q >> 24) - d[k + 1] * (p * p * q >> 24) >> 12
        heights.append(int(clamp(h[k] + ((h[k + 1] - h[k]) * share >> 12) + (w * bend >> 12), -MAX_DOWN, MAX_DOWN)))
    return np.array(heights)
