"""The head laid out flat, and what patterns show there (SPEC 10.12, 11.5)."""

import pathlib
import re

import numpy as np

from .head import HEAD, VERTICES
from .integers import checksum, clamp, complete, quotient
from .limits import MAX_SCREEN
from .mesh import HEAD_TRIANGLES
from .nodes import Nodes, rounded_weights
from .patches import NODE_ONE, blended
from .raster import NO_TRIANGLE, Fragments, Triangles, planes
from .samples import sample_texture, take_back_light
from .weights import ONE

_FILE = pathlib.Path(__file__).parents[2] / "decoder/atlas/atlas_layout_table.cpp"
_CHECKSUM = 0x7EF7D415AFF39EB7
_SIZE = (15365, 17039)  # of the table
_RING = len(HEAD.outline)


def _read_table():
    pairs = re.findall(r"\{(\d+), (\d+)\}", _FILE.read_text())
    table = np.array(pairs, np.int64)
    assert len(table) == VERTICES + _RING and checksum(table.ravel().tolist()) == _CHECKSUM
    return table


def _triangles():
    """Those of head and ring, then the skirt's."""
    triangles = HEAD_TRIANGLES.tolist()
    ring, skirt = VERTICES, VERTICES + _RING
    for i in range(_RING):
        j = (i + 1) % _RING
        triangles += [[ring + i, skirt + i, skirt + j], [ring + i, skirt + j, ring + j]]
    return np.array(triangles)


_TABLE = _read_table()
_TRIANGLES = _triangles()


def _with_skirt(positions):
    """One coordinate of the vertices of head and ring, and of the skirt."""
    ring, outline = positions[VERTICES:], positions[HEAD.outline]
    return np.concatenate([positions, clamp(ring + quotient(ring - outline, 2), -MAX_SCREEN, MAX_SCREEN)])


class Atlas:
    """The atlas of a scene; `scale` is that of the rest state."""

    def __init__(self, scale):
        eyes = 16 * clamp(((5 * scale >> 18) + 15) // 16, 4, 10)
        self.x, self.y = (_with_skirt((_TABLE[:, k] * eyes + 32) >> 6) for k in range(2))
        self.width, self.height = (((size * eyes + 32) >> 6 >> 6) // 16 * 16 + 16 for size in _SIZE)
        self.planes = planes(self.width, self.height)
        self.nodes = Nodes(self.width, self.height, _TRIANGLES, self.x, self.y)
        self.nodes.take_nearest(self.x, self.y)
        self._fragments = []
        triangles = Triangles(self.x[_TRIANGLES], self.y[_TRIANGLES])
        for plane in self.planes[:2]:
            shown = np.full((plane.height, plane.width), NO_TRIANGLE)
            triangles.draw(shown, plane)
            self._fragments.append(Fragments(triangles, shown, plane))

    def of_pattern(self, pattern_planes, x, y, offset, gain):
        """What a pattern shows: planes Y, U, V. The others are of the vertices of head and ring in the pattern."""
        corners_x, corners_y = (_with_skirt(at)[_TRIANGLES] for at in (x, y))
        result = []
        for number, (texture, plane) in enumerate(zip(pattern_planes, self.planes)):
            fragments = self._fragments[min(number, 1)]
            samples = sample_texture(texture, fragments.texture_positions(corners_x),
                                     fragments.texture_positions(corners_y))
            if number == 0 and offset.any() | gain.any():
                o, g = (fragments.quantities(np.concatenate([light, np.zeros(_RING, np.int64)])[_TRIANGLES])
                        for light in (offset, gain))
                samples = take_back_light(samples, o, g)
            atlas = np.zeros((plane.height, plane.width), np.int64)
            atlas[fragments.rows, fragments.columns] = samples
            result.append(atlas)
        return result

    def blend(self, atlases, weights):
        """The texture of the head: planes Y, U, V of the patterns' atlases, by atlas_weights()."""
        corners = np.concatenate([weights, weights[:, VERTICES:]], axis=1)
        nodes = rounded_weights(np.array([self.nodes.at(w) for w in corners]), 4, NODE_ONE)
        return [blended(plane, [atlas[k] for atlas in atlases], nodes) for k, plane in enumerate(self.planes)]


def atlas_weights(weights):
    """Weights in the atlas, from those of the warped sources (rows) at the vertices of head and ring."""
    result = weights.copy()
    totals = weights[:, :VERTICES].sum(axis=1)
    for v in range(weights.shape[1]):
        x = weights[:, v]
        if x.sum() == 0:
            x = result[:, HEAD.outline[v - VERTICES]] if v >= VERTICES else totals
        if x.sum() == 0:
            x = np.eye(len(x), dtype=np.int64)[0]
        result[:, v] = complete((x * ONE + x.sum() // 2) // x.sum(), ONE)
    return result
