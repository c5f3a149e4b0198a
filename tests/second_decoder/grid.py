"""The grid of the surround, and how head, body and ground move it (SPEC 10.1)."""

import numpy as np

from .animate import HeadPose
from .integers import clamp, nearest, quotient
from .limits import MAX_SCREEN

_MIN_FRONTAL = 2**11  # of the determinant of the rest state's head, 2^-14


def _rest_line(size, cells):
    """Rest positions of points -1..cells + 1 along one side of the picture; size in samples, result in 1/64."""
    inner = [128 + (64 * size - 256) * c // cells for c in range(cells + 1)]
    return np.array([128 - 32 * size] + inner + [96 * size - 128])


class Grid:
    """Points of the grid with their margin. Arrays have columns + 3 columns and rows + 3 rows, from -1."""

    def __init__(self, setup, surround, rest):
        self.columns, self.rows = surround.columns, surround.rows
        self.x_line = _rest_line(setup.width, self.columns)
        self.y_line = _rest_line(setup.height, self.rows)
        self.rest_x, self.rest_y = np.meshgrid(self.x_line, self.y_line)
        base_column = np.clip(np.arange(self.columns + 3), 1, self.columns + 1)
        base_row = np.clip(np.arange(self.rows + 3), 1, self.rows + 1)
        self.base = np.ix_(base_row, base_column)
        self._base_x, self._base_y = self.rest_x[self.base], self.rest_y[self.base]
        self.head_layer = np.pad(np.array(surround.head), 1, "edge")
        self.body_layer = np.pad(np.array(surround.body), 1, "edge")
        self._rest = rest
        self._rest_head = HeadPose(rest)

    def index(self, column, row):
        """Place of a point among all, row by row."""
        return (row + 1) * (self.columns + 3) + column + 1

    def cells(self):
        """The corners a, b, d, e of each cell, in the order of drawing (SPEC 10.3)."""
        column, row = np.meshgrid(np.arange(-1, self.columns + 1), np.arange(-1, self.rows + 1))
        corners = np.stack([self.index(column, row), self.index(column + 1, row),
                            self.index(column + 1, row + 1), self.index(column, row + 1)], axis=-1).reshape(-1, 4)
        values = (8 * self.head_layer + self.body_layer).ravel()
        return corners[np.argsort(values[corners].sum(axis=1), kind="stable")]

    def positions(self, state):
        """Positions x, y of the points on the screen, 1/64 sample."""
        head = self._head_displacement(state)
        body = self._similarity(state.body, self._rest.body)
        ground = self._similarity(state.ground, self._rest.ground)
        result = []
        for rest, h, b, g in zip((self.rest_x, self.rest_y), head, body, ground):
            similar = g + quotient((b - g) * self.body_layer, 4)
            displacement = similar + quotient((h - similar) * self.head_layer, 4)
            result.append(clamp(rest + displacement, -MAX_SCREEN, MAX_SCREEN))
        return result

    def _similarity(self, values, rest_values):
        """Displacement of the points by the motion of body or ground."""
        dx, dy, a, b = (now - then for now, then in zip(values, rest_values))
        u = clamp(quotient((self._base_x - self._rest.tx) * 2**18, self._rest_head.scale), -2**14, 2**14)
        v = clamp(quotient((self._base_y - self._rest.ty) * 2**18, self._rest_head.scale), -2**14, 2**14)
        return (clamp(dx + nearest(a * u - b * v, 8), -MAX_SCREEN, MAX_SCREEN),
                clamp(dy + nearest(a * v + b * u, 8), -MAX_SCREEN, MAX_SCREEN))

    def _head_displacement(self, state):
        """Displacement of the points by the motion of the plane z = 0 of the head."""
        rest = self._rest_head.rotation
        determinant = nearest(rest[0][0] * rest[1][1] - rest[0][1] * rest[1][0], 14)
        if state.pose == self._rest.pose or determinant < _MIN_FRONTAL:
            return np.zeros_like(self.rest_x), np.zeros_like(self.rest_y)
        now = HeadPose(state)
        inverse = ((rest[1][1], -rest[0][1]), (-rest[1][0], rest[0][0]))
        larger = (now.scale << 16) // self._rest_head.scale
        x0, y0 = self._base_x - self._rest.tx, self._base_y - self._rest.ty
        result = []
        for a, t, base in zip(now.rotation, (state.tx, state.ty), (self._base_x, self._base_y)):
            m = [clamp(nearest(quotient(a[0] * inverse[0][j] + a[1] * inverse[1][j], determinant) * larger, 14),
                       -2**20, 2**20) for j in range(2)]
            result.append(clamp(t + nearest(m[0] * x0 + m[1] * y0, 16) - base, -MAX_SCREEN, MAX_SCREEN))
        return result
