"""The head laid out flat, and what patterns show there (SPEC 10.12, 11.5)."""

import numpy as np

from .integers import clamp, complete, quotient
from .limits import MAX_SCREEN
from .nodes import Nodes, rounded_weights
from .patches import blended
from .raster import NO_TRIANGLE, Fragments, Triangles, planes
from .samples import sample_texture, take_back_light
from .weights import ONE

_UNCOVERED = (0, 128, 128)  # samples that no triangle covers
_MARGIN = 573  # to the right of the vertices and below, head units


def _triangles(frame):
    """Those of head and ring, then the skirt's."""
    triangles = frame.all_triangles.tolist()
    ring, skirt = frame.vertices, frame.vertices + frame.ring
    for i in range(frame.ring):
        j = (i + 1) % frame.ring
        triangles += [[ring + i, skirt + i, skirt + j], [ring + i, skirt + j, ring + j]]
    return np.array(triangles)


def _with_skirt(frame, positions):
    """One coordinate of the vertices of head and ring, and of the skirt."""
    ring, outline = positions[frame.vertices:], positions[frame.outline]
    return np.concatenate([positions, clamp(ring + quotient(ring - outline, 2), -MAX_SCREEN, MAX_SCREEN)])


class Atlas:
    """The atlas of a scene; `scale` is that of the rest state."""

    def __init__(self, frame, scale):
        self._frame = frame
        self._triangles = _triangles(frame)
        table = np.array(frame.atlas, np.int64)
        eyes = 16 * clamp(((5 * scale >> 18) + 15) // 16, 4, 10)
        self.x, self.y = (_with_skirt(frame, (table[:, k] * eyes + 32) >> 6) for k in range(2))
        self.width, self.height = (((int(size) + _MARGIN) * eyes + 32 >> 6 >> 6) // 16 * 16 + 16
                                   for size in table.max(axis=0))
        self.planes = planes(self.width, self.height)
        self.nodes = Nodes(self.width, self.height, self._triangles, self.x, self.y)
        self.nodes.take_nearest(self.x, self.y)
        self._fragments = []
        triangles = Triangles(self.x[self._triangles], self.y[self._triangles])
        for plane in self.planes[:2]:
            shown = np.full((plane.height, plane.width), NO_TRIANGLE)
            triangles.draw(shown, plane)
            self._fragments.append(Fragments(triangles, shown, plane))

    def of_pattern(self, pattern_planes, x, y, offset, gain):
        """What a pattern shows: planes Y, U, V. The others are of the vertices of head and ring in the pattern."""
        corners_x, corners_y = (_with_skirt(self._frame, at)[self._triangles] for at in (x, y))
        result = []
        for number, (texture, plane) in enumerate(zip(pattern_planes, self.planes)):
            fragments = self._fragments[min(number, 1)]
            samples = sample_texture(texture, fragments.texture_positions(corners_x),
                                     fragments.texture_positions(corners_y))
            unlit = np.zeros(self._frame.ring, np.int64)
            if number == 0 and offset.any() | gain.any():
                o, g = (fragments.quantities(np.concatenate([light, unlit])[self._triangles])
                        for light in (offset, gain))
                samples = take_back_light(samples, o, g)
            atlas = np.full((plane.height, plane.width), _UNCOVERED[number])
            atlas[fragments.rows, fragments.columns] = samples
            result.append(atlas)
        return result

    def blend(self, atlases, weights):
        """The texture of the head: planes Y, U, V of the patterns' atlases, by atlas_weights()."""
        corners = np.concatenate([weights, weights[:, self._frame.vertices:]], axis=1)
        nodes = rounded_weights(np.array([self.nodes.at(w) for w in corners]), 1)
        return [blended(plane, [atlas[k] for atlas in atlases], nodes) for k, plane in enumerate(self.planes)]


def atlas_weights(frame, weights):
    """Weights in the atlas, from those of the warped sources (rows) at the vertices of head and ring."""
    def rounded(x):
        total = x.sum(axis=0)
        return complete((x * ONE + total // 2) // total, ONE)

    def where_none(x, instead):
        return np.where(x.sum(axis=0) == 0, instead, x)

    head, ring = weights[:, :frame.vertices], weights[:, frame.vertices:]
    first_alone = np.eye(len(weights), 1, dtype=np.int64)
    head = rounded(where_none(head, where_none(head.sum(axis=1, keepdims=True), first_alone)))
    return np.concatenate([head, rounded(where_none(ring, head[:, frame.outline]))], axis=1)
