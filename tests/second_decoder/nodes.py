"""Nodes, the corners of patches: in which triangle of a mesh each lies, and values between them (SPEC 10.3, 11.5)."""

import numpy as np

from .integers import nearest, quotient
from .raster import NO_TRIANGLE, Plane, Triangles

PATCH = 8  # luma samples from node to node
_FIRST = 32  # place of node 0, 1/64 luma sample
_STEP_BITS = 9


class Nodes:
    """The nodes of a picture of this size, and their places in the triangles of a mesh.

    corners  points of each triangle, rows
    x, y     of the points, 1/64 luma sample
    """

    def __init__(self, width, height, corners, x, y):
        self.columns, self.rows = (2 * -(-size // (2 * PATCH)) + 1 for size in (width, height))  # of whole blocks
        column, row = np.meshgrid(np.arange(self.columns), np.arange(self.rows))
        self.x, self.y = (column << _STEP_BITS) + _FIRST, (row << _STEP_BITS) + _FIRST
        self._corners = corners
        self._owner = self._find_owners(x[corners], y[corners])
        self.is_covered = self._owner != NO_TRIANGLE
        self._place(x, y)

    def _find_owners(self, x, y):
        """The last triangle that covers each node."""
        shift = (1 << (_STEP_BITS - 1)) - _FIRST  # to where a plane has the centres of samples
        owner = np.full(self.x.shape, NO_TRIANGLE)
        Triangles(x + shift, y + shift).draw(owner, Plane(self.columns, self.rows, _STEP_BITS))
        return owner

    def _place(self, x, y):
        """The points of the triangle of each node, and the shares of the second and the third."""
        self._points = self._corners[np.where(self.is_covered, self._owner, 0)]
        x0, x1, x2 = (x[self._points[..., k]] for k in range(3))
        y0, y1, y2 = (y[self._points[..., k]] for k in range(3))
        area = np.maximum((x1 - x0) * (y2 - y0) - (y1 - y0) * (x2 - x0), 1)
        m_20 = (y2 - y0) * (self.x - x2) + (x0 - x2) * (self.y - y2)
        m_01 = (y0 - y1) * (self.x - x0) + (x1 - x0) * (self.y - y0)
        self._l1, self._l2 = quotient(m_20 << 14, area), quotient(m_01 << 14, area)

    def at(self, values):
        """A quantity at the nodes, by its values at the points of the mesh."""
        v0, v1, v2 = (values[self._points[..., k]] for k in range(3))
        return v0 + nearest((v1 - v0) * self._l1 + (v2 - v0) * self._l2, 14)

    def take_nearest(self, x, y):
        """Puts nodes that no triangle covers at the nearest point."""
        for row, column in zip(*np.nonzero(~self.is_covered)):
            distances = (x - self.x[row, column]) ** 2 + (y - self.y[row, column]) ** 2
            self._points[row, column] = distances.argmin()
            self._l1[row, column] = self._l2[row, column] = 0
        self.is_covered[:] = True


def rounded_weights(weights, step):
    """Weights of the sources (first axis) at nodes, from those in 1/4096: sums of the first ones are rounded to steps in 1/256."""
    sums = step * nearest(weights.cumsum(axis=0), 3 + step.bit_length())
    return np.diff(sums, axis=0, prepend=0)


def corners_of_patches(nodes):
    """The values at the upper left, upper right, lower left and lower right node of each patch."""
    return np.stack([nodes[:-1, :-1], nodes[:-1, 1:], nodes[1:, :-1], nodes[1:, 1:]])


class Samples:
    """The samples of a plane in their patches.

    bits  of the plane: 6 for luma, 7 for chroma, whose samples are where every second luma sample is
    """

    def __init__(self, plane):
        step = plane.bits - 5
        self.columns, self.rows = np.arange(plane.width), np.arange(plane.height)[:, None]
        self._i, self._k = self.columns * step // PATCH, self.columns * step % PATCH
        self._j, self._l = self.rows[:, 0] * step // PATCH, self.rows * step % PATCH

    def of_patches(self, values):
        """For each sample the value of its patch."""
        return values[:, self._i][self._j]

    def between(self, corners):
        """Values between the four corners of each sample's patch, times 64."""
        upper, lower = (self._beside(left, right) for left, right in (corners[:2], corners[2:]))
        return upper[self._j] * (PATCH - self._l) + lower[self._j] * self._l

    def _beside(self, left, right):
        return left[:, self._i] * (PATCH - self._k) + right[:, self._i] * self._k
