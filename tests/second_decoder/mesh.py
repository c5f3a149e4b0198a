"""Head, ring and surround as one mesh (SPEC 8.7, 10.1, 10.2, 11.1)."""

from dataclasses import dataclass

import numpy as np

from .animate import HeadPose, light_at_vertices, lip_gap, move_vertices
from .grid import Grid
from .integers import clamp, nearest, quotient
from .limits import MAX_SCREEN
from .wire_frame import BODY, FULL_SHARE, GROUND, HAIR, REGIONS

FLATTEST = 63  # depth of a plane, head units
_RING_DEPTH = 2048  # of the ring behind the outline, head units


@dataclass
class Placement:
    """The points of the mesh in one state: those of the grid row by row, of the wire-frame, then of the ring."""
    x: np.ndarray  # on the screen, 1/64 sample
    y: np.ndarray
    z: np.ndarray  # head units; 0 in the grid
    offset: np.ndarray  # light, 1/16 grey level
    gain: np.ndarray
    gap: int  # between the lips, head units


class Mesh:
    """The mesh of a scene with geometry: its triangles, and what belongs to its points in every state."""

    def __init__(self, setup, surround, frame, adapted, rest):
        self.frame = frame
        self._adapted = adapted
        self.grid = Grid(setup, surround, rest)
        self.grid_points = self.grid.rest_x.size
        self.cells = self.grid.cells()
        self.head_triangles = frame.all_triangles + self.grid_points
        self._outline = adapted[frame.outline]
        self.is_plane = bool((np.abs(adapted[:, 2]) <= FLATTEST).all())
        self.rest_scale = HeadPose(rest).scale
        self.atlas = None  # of the head: atlas.Atlas
        self._attach_ring(rest)
        self.shares = np.concatenate([self._grid_shares(), frame.shares, self._ring_shares()])

    def surround_triangles(self):
        """Corners of the triangles that move the surround, in their order (SPEC 10.3)."""
        halves = np.stack([self.cells[:, [0, 1, 2]], self.cells[:, [0, 2, 3]]], axis=1).reshape(-1, 3)
        return np.concatenate([halves, self.head_triangles]) if self.is_plane else halves

    def place(self, state):
        x, y = self.grid.positions(state)
        ring_x, ring_y = (at + self._in_cells(now - rest) for at, now, rest in
                          ((self._ring_x, x, self.grid.rest_x), (self._ring_y, y, self.grid.rest_y)))
        pose = HeadPose(state)
        vertices = move_vertices(self.frame, self._adapted, state)
        head = pose.project(vertices)
        ring_z = pose.project(self._outline + (0, 0, _RING_DEPTH))[:, 2]
        head_x = np.concatenate([head[:, 0], clamp(ring_x, -MAX_SCREEN, MAX_SCREEN)])
        head_y = np.concatenate([head[:, 1], clamp(ring_y, -MAX_SCREEN, MAX_SCREEN)])
        offset, gain = light_at_vertices(self._adapted, state)
        without, unlit = np.zeros(self.grid_points, np.int64), np.zeros(self.frame.ring, np.int64)
        return Placement(x=np.concatenate([x.ravel(), head_x]),
                         y=np.concatenate([y.ravel(), head_y]),
                         z=np.concatenate([without, head[:, 2], ring_z]),
                         offset=np.concatenate([without, offset, unlit]),
                         gain=np.concatenate([without, gain, unlit]),
                         gap=lip_gap(self.frame, vertices))

    def _attach_ring(self, rest):
        """Finds the cell in which each vertex of the ring is at rest, and where in it, in 1/256."""
        x, y, z = self._outline.T
        wider = np.stack([x + quotient(x * 36, 256), y + quotient(y * 36, 256), z], axis=1)
        self._ring_x, self._ring_y, _ = HeadPose(rest).project(wider).T
        self._ring_column, self._p = self._cell_along(self._ring_x, self.grid.x_line)
        self._ring_row, self._q = self._cell_along(self._ring_y, self.grid.y_line)

    @staticmethod
    def _cell_along(at, line):
        """Cells 0.. along one side that contain the positions `at`, and the places in them."""
        inner = line[1:-1]
        at = np.clip(at, inner[0], inner[-1])
        cell = np.clip(np.searchsorted(inner, at, side="right") - 1, 0, len(inner) - 2)
        return cell, (at - inner[cell]) * 256 // (inner[cell + 1] - inner[cell])

    def _in_cells(self, values):
        """Values of the grid's points, interpolated at the ring."""
        column, row, p, q = self._ring_column + 1, self._ring_row + 1, self._p, self._q
        a, b = values[row, column], values[row, column + 1]
        e, d = values[row + 1, column], values[row + 1, column + 1]
        return nearest((a * (256 - p) + b * p) * (256 - q) + (e * (256 - p) + d * p) * q, 16)

    def _grid_shares(self):
        f, g = self.grid.head_layer.ravel(), self.grid.body_layer.ravel()
        shares = np.zeros((self.grid_points, REGIONS), np.int64)
        shares[:, HAIR] = 4 * f
        shares[:, BODY] = (4 - f) * g
        shares[:, GROUND] = (4 - f) * (4 - g)
        return shares

    def _ring_shares(self):
        f, g = self.grid.head_layer, self.grid.body_layer
        shares = np.zeros((self.frame.ring, REGIONS), np.int64)
        shares[:, HAIR] = self._in_cells(4 * f)
        shares[:, BODY] = np.minimum(self._in_cells((4 - f) * g), FULL_SHARE - shares[:, HAIR])
        shares[:, GROUND] = FULL_SHARE - shares[:, HAIR] - shares[:, BODY]
        return shares
