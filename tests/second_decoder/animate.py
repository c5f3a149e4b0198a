"""From a state to the vertices of the head on the screen, and their light (SPEC 8, 10.11)."""

import numpy as np

from .integers import clamp, cos, exp2, nearest, quotient, sin
from .limits import MAX_LIGHT, MAX_SCREEN
from .wire_frame import (LEFT_LOWER_LID, LEFT_PUPIL, LEFT_UPPER_LID, RIGHT_LOWER_LID, RIGHT_PUPIL,
                         RIGHT_UPPER_LID)

_EYES = ((RIGHT_PUPIL, RIGHT_UPPER_LID, RIGHT_LOWER_LID), (LEFT_PUPIL, LEFT_UPPER_LID, LEFT_LOWER_LID))
_UPPER_LIP, _LOWER_LIP = 62, 66  # landmarks
_LIGHT_MIDDLE_Y = 2048  # head units


class HeadPose:
    """Rotation and scale of a state (SPEC 8.3, 8.4)."""

    def __init__(self, state):
        sp, cp = sin(state.pitch), cos(state.pitch)
        sy, cy = sin(state.yaw), cos(state.yaw)
        sr, cr = sin(state.roll), cos(state.roll)

        def q(a):
            return nearest(a, 14)

        u, w = q(sy * sp), q(sy * cp)
        self.rotation = [[q(cr * cy), q(cr * u - sr * cp), q(cr * w + sr * sp)],  # 2^-14
                         [q(sr * cy), q(sr * u + cr * cp), q(sr * w - cr * sp)],
                         [-sy, q(cy * sp), q(cy * cp)]]
        self.scale = exp2(state.log_scale)  # 2^-16 samples per eye distance
        self.tx, self.ty = state.tx, state.ty  # 1/64 sample

    def project(self, points):
        """Columns x, y (1/64 sample) and z (head units) of points x, y, z in head units."""
        t = nearest(points @ np.array(self.rotation).T, 14)
        x = clamp(self.tx + nearest(self.scale * t[:, 0], 22), -MAX_SCREEN, MAX_SCREEN)
        y = clamp(self.ty + nearest(self.scale * t[:, 1], 22), -MAX_SCREEN, MAX_SCREEN)
        return np.stack([x, y, t[:, 2]], axis=1)


def move_vertices(frame, adapted, state):
    """The vertices of the adapted head, moved by control points and lids; head units (SPEC 8.5, 8.6)."""
    vertices = adapted.copy()
    vertices[:, :2] += nearest(frame.skinning_matrix @ state.controls, 12)
    for pupil, upper_lid, lower_lid in _EYES:
        upper = int(max(vertices[frame.features[upper_lid].vertices, 1]))
        lower = int(min(vertices[frame.features[lower_lid].vertices, 1]))
        v = frame.features[pupil].vertices[0]
        vertices[v, 1] = _between_lids(int(vertices[v, 1]), upper, lower)
    return vertices


def _between_lids(y, upper, lower):
    if lower > upper:
        quarter = (lower - upper) // 4
        return clamp(y, upper + quarter, lower - quarter)
    return upper + quotient(lower - upper, 2)


def lip_gap(frame, vertices):
    """Opening between the inner lips, head units (SPEC 10.10)."""
    upper, lower = (int(vertices[frame.landmark_vertices[k], 1]) for k in (_UPPER_LIP, _LOWER_LIP))
    return lower - upper


def light_at_vertices(adapted, state):
    """Offset and gain of each vertex, 1/16 grey level (SPEC 10.11)."""
    offset, gain, slope_x, slope_y, xx, yy, xy = state.light
    x, m = adapted[:, 0], adapted[:, 1] - _LIGHT_MIDDLE_Y
    slopes = nearest(slope_x * x + slope_y * adapted[:, 1], 12)
    squares = nearest(xx * x * x + yy * m * m + xy * x * m, 24)
    return clamp(offset + slopes + squares, -MAX_LIGHT, MAX_LIGHT), np.full(len(adapted), gain)
