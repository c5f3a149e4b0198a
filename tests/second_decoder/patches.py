"""Pictures made of patches: textures displaced and blended (SPEC 10.3, 11.6)."""

import numpy as np

from .integers import clamp, nearest
from .nodes import Samples, corners_of_patches

_OUTSIDE = 24 * 64
_EVEN = 16  # the largest difference of displacements that is none


def displacements(nodes, seen, now, width, height):
    """Displacement x and y of the nodes; `seen` and `now` are (x, y) of the points in states S and N."""
    result = []
    for s, n, at, size in zip(seen, now, (nodes.x, nodes.y), (width, height)):
        moved = clamp(nodes.at(s - n), -_OUTSIDE - at, 64 * size + _OUTSIDE - at)
        result.append(np.where(nodes.is_covered, moved, 0))
    return result


def warped(texture, plane, displacement):
    """The samples of a displaced texture; `displacement` is that of the nodes, or None in a still source."""
    if displacement is None:
        return texture.astype(np.int64)
    samples = Samples(plane)
    corners = [corners_of_patches(nodes) for nodes in displacement]
    is_still = (corners[0] == 0).all(axis=0) & (corners[1] == 0).all(axis=0)
    is_even = np.logical_and(*(np.ptp(c, axis=0) <= _EVEN for c in corners))
    in_even_block, is_still_block, mean_of_block = _even_blocks(displacement)
    halved = plane.bits - 6
    x, y = (nearest(samples.between(np.where(in_even_block, m, np.where(is_even, (c.sum(axis=0) + 2) >> 2, c))), 6) >> halved
            for c, m in zip(corners, mean_of_block))
    is_still &= ~in_even_block | is_still_block
    return np.where(samples.of_patches(is_still), texture, _sample(texture, 64 * samples.columns + x, 64 * samples.rows + y, 2 - halved))


def _even_blocks(displacement):
    """For each patch whether the nodes of its block hardly differ, or are still, and the mean x and y of the block's corners."""
    nine = [np.stack([d[j:j + d.shape[0] - 2:2, i:i + d.shape[1] - 2:2] for j in range(3) for i in range(3)]) for d in displacement]

    def of_patches(values):
        return values.repeat(2, axis=0).repeat(2, axis=1)

    is_even = np.logical_and(*(np.ptp(d, axis=0) <= _EVEN for d in nine))
    is_still = np.logical_and(*((d == 0).all(axis=0) for d in nine))
    return of_patches(is_even), of_patches(is_still), [of_patches((d[[0, 2, 6, 8]].sum(axis=0) + 2) >> 2) for d in nine]


def _sample(texture, u, v, inset):
    """Samples at positions in 1/64 sample; the outermost `inset` ones repeat what is inside."""
    height, width = texture.shape

    def t(row, column):
        return texture[clamp(row, inset, height - 1 - inset), clamp(column, inset, width - 1 - inset)].astype(np.int64)

    i, p, j, q = u >> 6, u % 64, v >> 6, v % 64
    top = t(j, i) * (64 - p) + t(j, i + 1) * p
    bottom = t(j + 1, i) * (64 - p) + t(j + 1, i + 1) * p
    return (top + nearest((bottom - top) * q, 6) + 32) >> 6


def blended(plane, textures, weights):
    """Samples of sources, blended by their weights at the nodes (rows of `weights`)."""
    samples = Samples(plane)
    total = np.zeros((plane.height, plane.width), np.int64)
    for texture, nodes in zip(textures, weights):
        total += samples.between(corners_of_patches(nodes)) * texture >> 8
    return (total + 32) >> 6
