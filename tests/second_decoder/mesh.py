"""Head, ring and surround as one mesh (SPEC 8.7, 10.1, 10.2, 11.1)."""

from dataclasses import dataclass

import numpy as np

from .animate import SKINNING, HeadPose, INNER_LIP_VERTICES, light_at_vertices, lip_gap, move_vertices
from .grid import Grid
from .head import (HEAD, INNER_LIPS, LEFT_LOWER_LID, LEFT_PUPIL, LEFT_UPPER_LID, OUTER_LIPS, RIGHT_LOWER_LID,
                   RIGHT_PUPIL, RIGHT_UPPER_LID, VERTICES)
from .integers import clamp, nearest, quotient
from .limits import MAX_SCREEN

MOUTH, RIGHT_EYE, LEFT_EYE, FACE, HAIR, BODY, GROUND = range(7)
REGIONS = 7
FULL_SHARE = 16
REGION_FEATURES = {MOUTH: (OUTER_LIPS, INNER_LIPS),
                   RIGHT_EYE: (RIGHT_UPPER_LID, RIGHT_LOWER_LID, RIGHT_PUPIL),
                   LEFT_EYE: (LEFT_UPPER_LID, LEFT_LOWER_LID, LEFT_PUPIL)}
FLATTEST = 63  # depth of a plane, head units
_RING = len(HEAD.outline)
_RING_DEPTH = 2048  # of the ring behind the outline, head units


def _head_triangles():
    """Triangles of head and ring, in the order of drawing; vertices from 105 on are the ring's."""
    triangles = [list(triangle) for triangle in HEAD.triangles]
    for i in range(_RING):
        j = (i + 1) % _RING
        triangles.append([HEAD.outline[i], VERTICES + i, VERTICES + j])
        triangles.append([HEAD.outline[i], VERTICES + j, HEAD.outline[j]])
    return np.array(triangles)


def _vertex_shares():
    """Shares of the regions at the vertices of the head."""
    shares = np.zeros((VERTICES, REGIONS), np.int64)
    left = np.full(VERTICES, FULL_SHARE)
    for region, features in REGION_FEATURES.items():
        controls = [c for feature in features for c in HEAD.features[feature].control_range()]
        shares[:, region] = np.minimum(SKINNING[:, controls].sum(axis=1) * FULL_SHARE // 4096, left)
        left -= shares[:, region]
    shares[:, FACE] = left
    return shares


HEAD_TRIANGLES = _head_triangles()
MOUTH_INTERIOR = np.isin(HEAD_TRIANGLES, INNER_LIP_VERTICES).all(axis=1)  # which of them belong to it
_VERTEX_SHARES = _vertex_shares()


@dataclass
class Placement:
    """The points of the mesh in one state: those of the grid row by row, 105 vertices, then the ring."""
    x: np.ndarray  # on the screen, 1/64 sample
    y: np.ndarray
    z: np.ndarray  # head units; 0 in the grid
    offset: np.ndarray  # light, 1/16 grey level
    gain: np.ndarray
    gap: int  # between the lips, head units


class Mesh:
    """The mesh of a scene with geometry: its triangles, and what belongs to its points in every state."""

    def __init__(self, setup, surround, adapted, rest):
        self._adapted = adapted
        self.grid = Grid(setup, surround, rest)
        self.grid_points = self.grid.rest_x.size
        self.cells = self.grid.cells()
        self.head_triangles = HEAD_TRIANGLES + self.grid_points
        self._outline = adapted[HEAD.outline]
        self.is_plane = bool((np.abs(adapted[:, 2]) <= FLATTEST).all())
        self.rest_scale = HeadPose(rest).scale
        self.atlas = None  # of the head: atlas.Atlas
        self._attach_ring(rest)
        self.shares = np.concatenate([self._grid_shares(), _VERTEX_SHARES, self._ring_shares()])

    def surround_triangles(self):
        """Corners of the triangles that move the surround, in their order (SPEC 10.3)."""
        halves = np.stack([self.cells[:, [0, 1, 2]], self.cells[:, [0, 2, 3]]], axis=1).reshape(-1, 3)
        return np.concatenate([halves, self.head_triangles]) if self.is_plane else halves

    def place(self, state):
        x, y = self.grid.positions(state)
        ring_x, ring_y = (at + self._in_cells(now - rest) for at, now, rest in
                          ((self._ring_x, x, self.grid.rest_x), (self._ring_y, y, self.grid.rest_y)))
        pose = HeadPose(state)
        vertices = move_vertices(self._adapted, state)
        head = pose.project(vertices)
        ring_z = pose.project(self._outline + (0, 0, _RING_DEPTH))[:, 2]
        head_x = np.concatenate([head[:, 0], clamp(ring_x, -MAX_SCREEN, MAX_SCREEN)])
        head_y = np.concatenate([head[:, 1], clamp(ring_y, -MAX_SCREEN, MAX_SCREEN)])
        offset, gain = light_at_vertices(self._adapted, state)
        without, unlit = np.zeros(self.grid_points, np.int64), np.zeros(_RING, np.int64)
        return Placement(x=np.concatenate([x.ravel(), head_x]),
                         y=np.concatenate([y.ravel(), head_y]),
                         z=np.concatenate([without, head[:, 2], ring_z]),
                         offset=np.concatenate([without, offset, unlit]),
                         gain=np.concatenate([without, gain, unlit]),
                         gap=lip_gap(vertices))

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
        shares = np.zeros((_RING, REGIONS), np.int64)
        shares[:, HAIR] = self._in_cells(4 * f)
        shares[:, BODY] = np.minimum(self._in_cells((4 - f) * g), FULL_SHARE - shares[:, HAIR])
        shares[:, GROUND] = FULL_SHARE - shares[:, HAIR] - shares[:, BODY]
        return shares
