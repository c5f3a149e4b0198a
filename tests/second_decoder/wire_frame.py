"""A wire-frame: the mesh of a head and how control points move it (SPEC 4.8, 8.7, 9.2, 10.10, 11.1)."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

LANDMARKS = 68
CONTROLS = 36
(OUTER_LIPS, INNER_LIPS, RIGHT_BROW, LEFT_BROW, RIGHT_UPPER_LID, LEFT_UPPER_LID, RIGHT_LOWER_LID, LEFT_LOWER_LID,
 RIGHT_PUPIL, LEFT_PUPIL) = range(10)
FEATURES = 10

MOUTH, RIGHT_EYE, LEFT_EYE, FACE, HAIR, BODY, GROUND = range(7)
REGIONS = 7
FULL_SHARE = 16
REGION_FEATURES = {MOUTH: (OUTER_LIPS, INNER_LIPS),
                   RIGHT_EYE: (RIGHT_UPPER_LID, RIGHT_LOWER_LID, RIGHT_PUPIL),
                   LEFT_EYE: (LEFT_UPPER_LID, LEFT_LOWER_LID, LEFT_PUPIL)}
RIGHT_MOUTH_CORNER, LEFT_MOUTH_CORNER = 60, 64  # landmarks


@dataclass
class Feature:
    closed: bool
    first_control: int
    controls: int
    vertices: list

    def control_range(self):
        return range(self.first_control, self.first_control + self.controls)


@dataclass
class WireFrame:
    positions: list  # x, y, z of each vertex, head units
    triangles: list  # three vertices each
    outline: list
    mirror: list
    landmark_vertices: list  # vertex of each iBUG-68 landmark
    skinning: list  # of each vertex: (control point, weight) pairs, 4096 is a weight of one
    features: list
    atlas: list  # u, v of the vertices and of the ring, head units

    @cached_property
    def vertices(self):
        """Their number."""
        return len(self.positions)

    @cached_property
    def ring(self):
        """The number of vertices of outline and ring, each."""
        return len(self.outline)

    @cached_property
    def skinning_matrix(self):
        """Weight of each control point (columns) for each vertex (rows)."""
        matrix = np.zeros((self.vertices, CONTROLS), np.int64)
        for v, pairs in enumerate(self.skinning):
            for control, weight in pairs:
                matrix[v, control] = weight
        return matrix

    @cached_property
    def all_triangles(self):
        """Triangles of head and ring, in the order of drawing; the vertices of the ring follow those of the head."""
        triangles = [list(triangle) for triangle in self.triangles]
        for i in range(self.ring):
            j = (i + 1) % self.ring
            triangles.append([self.outline[i], self.vertices + i, self.vertices + j])
            triangles.append([self.outline[i], self.vertices + j, self.outline[j]])
        return np.array(triangles)

    @cached_property
    def shares(self):
        """Shares of the regions at the vertices of the head."""
        shares = np.zeros((self.vertices, REGIONS), np.int64)
        left = np.full(self.vertices, FULL_SHARE)
        for region, features in REGION_FEATURES.items():
            controls = [c for feature in features for c in self.features[feature].control_range()]
            weights = self.skinning_matrix[:, controls].sum(axis=1)
            shares[:, region] = np.clip(weights * FULL_SHARE // 4096, 0, left)
            left -= shares[:, region]
        shares[:, FACE] = left
        return shares
