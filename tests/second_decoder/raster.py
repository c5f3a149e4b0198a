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
        """The range of columns or rows whose centres are in low..high."""
        half = 1 << (self.bits - 1)
        return max(0, (low - half + 2 * half - 1) >> self.bits), min(size, ((high - half) >> self.bits) + 1)


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

    def coverage(self, t, plane):
        """Rows and columns around triangle t, as slices, and which of these samples it covers."""
        left, right = plane.samples_between(min(self.x[t]), max(self.x[t]), plane.width)
        top, bottom = plane.samples_between(min(self.y[t]), max(self.y[t]), plane.height)
        x = plane.centres(np.arange(left, max(left, right)))
        y = plane.centres(np.arange(top, max(top, bottom)))[:, None]
        covered = np.ones((y.size, x.size), bool)
        for i in range(3):
            j = (i + 1) % 3
            xf, yf, xt, yt = self.x[t, i], self.y[t, i], self.x[t, j], self.y[t, j]
            is_left_or_top = yt < yf or yt == yf and xt > xf
            covered &= (yf - yt) * (x - xf) + (xt - xf) * (y - yf) >= (0 if is_left_or_top else 1)
        return slice(top, top + y.size), slice(left, left + x.size), covered

    def draw(self, shown, plane):
        """Writes into `shown`, for each sample, the last triangle that covers it."""
        for t in np.flatnonzero(self.areas > 0):
            rows, columns, covered = self.coverage(t, plane)
            shown[rows, columns][covered] = t

    def draw_with_depth(self, shown, plane, z, first):
        """Writes into `shown` the nearest triangle, of those from `first` on; z are the depths of the corners."""
        depth = np.full(shown.shape, FARTHEST)
        gx, gy = self.gradients(z, plane.bits)
        for t in first + np.flatnonzero(self.areas[first:] > 0):
            rows, columns, covered = self.coverage(t, plane)
            x = plane.centres(np.arange(columns.start, columns.stop)) - self.x[t, 0]
            y = plane.centres(np.arange(rows.start, rows.stop))[:, None] - self.y[t, 0]
            here = clamp(z[t, 0] + (gx[t] * x + gy[t] * y >> plane.bits), -2**31, FARTHEST - 1)
            nearer = covered & (here < depth[rows, columns])
            depth[rows, columns][nearer] = here[nearer]
            shown[rows, columns][nearer] = t


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
