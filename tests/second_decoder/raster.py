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

    def covered_samples(self, plane):
        """Triangle, row and column of every sample that a triangle covers, in the order of the triangles."""
        left, right = plane.samples_between(self.x.min(axis=1), self.x.max(axis=1), plane.width)
        top, bottom = plane.samples_between(self.y.min(axis=1), self.y.max(axis=1), plane.height)
        columns = np.maximum(right - left, 0)
        counts = np.where(self.areas > 0, columns * np.maximum(bottom - top, 0), 0)  # in the rectangle around each
        triangle = np.repeat(np.arange(len(counts)), counts)
        n = np.arange(len(triangle)) - np.repeat(counts.cumsum() - counts, counts)
        row, column = top[triangle] + n // columns[triangle], left[triangle] + n % columns[triangle]
        covered = self._inside(triangle, plane.centres(column), plane.centres(row))
        return triangle[covered], row[covered], column[covered]

    def _inside(self, triangle, x, y):
        """Which of the points (x, y) are covered, each by its triangle."""
        covered = True
        for i in range(3):
            j = (i + 1) % 3
            along_x, along_y = self.x[:, j] - self.x[:, i], self.y[:, j] - self.y[:, i]
            is_left_or_top = (along_y < 0) | (along_y == 0) & (along_x > 0)
            least = np.where(is_left_or_top, 0, 1) + along_x * self.y[:, i] - along_y * self.x[:, i]
            covered = covered & (along_x[triangle] * y - along_y[triangle] * x >= least[triangle])
        return covered

    def draw(self, shown, plane):
        """Writes into `shown`, for each sample, the last triangle that covers it."""
        triangle, row, column = self.covered_samples(plane)
        np.maximum.at(shown, (row, column), triangle)

    def draw_with_depth(self, shown, depths, plane, z):
        """Writes into `shown` the nearest triangle, the first of several, and its depth; z are those of the corners."""
        triangle, row, column = self.covered_samples(plane)
        gx, gy = self.gradients(z, plane.bits)
        x, y = plane.centres(column) - self.x[triangle, 0], plane.centres(row) - self.y[triangle, 0]
        depth = clamp(z[triangle, 0] + (gx[triangle] * x + gy[triangle] * y >> plane.bits), -2**31, FARTHEST - 1)
        place = row * plane.width + column
        order = np.lexsort((triangle, depth, place))
        _, nearest = np.unique(place[order], return_index=True)
        shown.flat[place[order][nearest]] = triangle[order][nearest]
        depths.flat[place[order][nearest]] = depth[order][nearest]


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
