"""Which triangle each sample of a plane shows, and quantities between its corners (SPEC 10.5 to 10.7, 10.9)."""

from dataclasses import dataclass

import numpy as np

from .integers import clamp, quotient

MAX_GRADIENT = 2**30
FARTHEST = 2**31 - 1
NO_TRIANGLE = -1


@dataclass
class Plane:
    """Size in samples; a sample has 2^bits positions of 1/64 luma sample."""
    width: int
    height: int
    bits: int

    def centres(self, samples):
        """Positions of the centres of these columns or rows."""
        return (samples << self.bits) + (1 << (self.bits - 1))

    def samples_between(self, low, high, size):
        """The first of the columns or rows whose centres are in low..high, and the one after the last."""
        half = 1 << (self.bits - 1)
        return clamp((low + half - 1) >> self.bits, 0, size), clamp((high + half) >> self.bits, 0, size)


def planes(width, height):
    """The planes Y, U and V of a picture."""
    chroma = Plane((width + 1) // 2, (height + 1) // 2, 7)
    return [Plane(width, height, 6), chroma, chroma]


def signed_areas(x, y):
    """Twice the areas of triangles, in 1/64 sample squared; positive if clockwise. Rows of x and y are triangles."""
    return (x[:, 1] - x[:, 0]) * (y[:, 2] - y[:, 0]) - (y[:, 1] - y[:, 0]) * (x[:, 2] - x[:, 0])


class Triangles:
    """Triangles on the screen; rows of x and y have their corners in 1/64 sample."""

    def __init__(self, x, y):
        self.x, self.y = x, y
        self.areas = signed_areas(x, y)

    def gradients(self, values, shift):
        """Gradients per sample of quantities, whose values at the corners are the rows of `values`."""
        ax, ay = self.x[:, 1] - self.x[:, 0], self.y[:, 1] - self.y[:, 0]
        bx, by = self.x[:, 2] - self.x[:, 0], self.y[:, 2] - self.y[:, 0]
        first, second = values[:, 1] - values[:, 0], values[:, 2] - values[:, 0]
        areas = np.maximum(self.areas, 1)  # the others are not drawn
        return (clamp(quotient((first * by - second * ay) << shift, areas), -MAX_GRADIENT, MAX_GRADIENT),
                clamp(quotient((second * ax - first * bx) << shift, areas), -MAX_GRADIENT, MAX_GRADIENT))

    def pieces(self, plane, first=0):
        """Yields, in order, a Piece of each triangle from `first` on that may cover samples of a plane."""
        left, right = plane.samples_between(self.x.min(axis=1), self.x.max(axis=1), plane.width)
        top, bottom = plane.samples_between(self.y.min(axis=1), self.y.max(axis=1), plane.height)
        is_visible = (self.areas > 0) & (left < right) & (top < bottom)
        for t in first + np.flatnonzero(is_visible[first:]):
            x = plane.centres(np.arange(left[t], right[t])) - self.x[t, 0]
            y = plane.centres(np.arange(top[t], bottom[t]))[:, None] - self.y[t, 0]
            covered = _inside((self.x[t] - self.x[t, 0]).tolist(), (self.y[t] - self.y[t, 0]).tolist(), x, y)
            yield Piece(t, (slice(top[t], bottom[t]), slice(left[t], right[t])), x, y, covered)

    def draw(self, shown, plane):
        """Writes into `shown`, for each sample, the last triangle that covers it."""
        for piece in self.pieces(plane):
            shown[piece.place][piece.covered] = piece.triangle

    def draw_with_depth(self, shown, plane, z, first):
        """Writes into `shown` the nearest triangle, of those from `first` on; z are the depths of the corners."""
        depth = np.full(shown.shape, FARTHEST)
        gx, gy = self.gradients(z, plane.bits)
        for piece in self.pieces(plane, first):
            t = piece.triangle
            here = z[t, 0] + (gx[t] * piece.x + gy[t] * piece.y >> plane.bits)
            here = clamp(here, -2**31, FARTHEST - 1)
            nearer = piece.covered & (here < depth[piece.place])
            depth[piece.place][nearer] = here[nearer]
            shown[piece.place][nearer] = t


@dataclass
class Piece:
    """The rectangle of samples around a triangle."""
    triangle: int
    place: tuple  # rows and columns, two slices
    x: np.ndarray  # centres of the columns less corner 0, 1/64 luma sample
    y: np.ndarray  # centres of the rows, one in each row
    covered: np.ndarray  # is a sample covered


def _inside(corner_x, corner_y, x, y):
    """Which of the points (x, y) a triangle covers."""
    covered = True
    for i in range(3):
        j = (i + 1) % 3
        xf, yf, xt, yt = corner_x[i], corner_y[i], corner_x[j], corner_y[j]
        is_left_or_top = yt < yf or yt == yf and xt > xf
        covered = covered & ((yf - yt) * (x - xf) + (xt - xf) * (y - yf) >= (0 if is_left_or_top else 1))
    return covered


class Fragments:
    """The samples of a plane that show a triangle."""

    def __init__(self, triangles, shown, plane):
        self._triangles = triangles
        self._bits = plane.bits
        self.rows, self.columns = np.nonzero(shown != NO_TRIANGLE)
        self.triangle = shown[self.rows, self.columns]
        self._x = plane.centres(self.columns) - triangles.x[self.triangle, 0]
        self._y = plane.centres(self.rows) - triangles.y[self.triangle, 0]

    def _interpolate(self, values, gradient_shift, value_shift):
        gx, gy = self._triangles.gradients(values, gradient_shift)
        t = self.triangle
        return (values[t, 0] << value_shift) + (gx[t] * self._x + gy[t] * self._y >> self._bits)

    def texture_positions(self, corners):
        """Positions in 2^-16 sample of the plane; those of the corners are in 1/64 luma sample."""
        return self._interpolate(corners, 16, 16 - self._bits)

    def quantities(self, corners):
        """Weights, light and the like, in 2^-16 of the unit of the corners."""
        return self._interpolate(corners, 16 + self._bits, 16)
