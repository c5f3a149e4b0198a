"""Arithmetic of samples: textures, light, blending and contrast.

The formulas of SPEC 4.4 (double), 10.8, 10.11, 11.6 and 11.7, and nothing of them is elsewhere. All arrays are
of 64-bit integers with one element for each sample to be drawn, unless stated otherwise.
"""

import numpy as np

from .integers import clamp
from .limits import MAX_LIGHT

WEIGHT_ONE = 4096
_DOUBLE_EVEN = ((-3, 1), (-2, -9), (-1, 35), (0, 114), (1, -17), (2, 4))  # offset, factor
_DOUBLE_ODD = ((-2, 4), (-1, -17), (0, 114), (1, 35), (2, -9), (3, 1))


def sample_texture(texture, u, v):
    """Samples of a plane at the texture positions u, v in 2^-16 sample (SPEC 10.8)."""
    height, width = texture.shape
    u = clamp(u - 2**15, 0, (width - 1) << 16)
    v = clamp(v - 2**15, 0, (height - 1) << 16)
    i, j = u >> 16, v >> 16
    i_next, j_next = np.minimum(i + 1, width - 1), np.minimum(j + 1, height - 1)
    p, q = (u >> 8) % 256, (v >> 8) % 256
    top = texture[j, i] * (256 - p) + texture[j, i_next] * p
    bottom = texture[j_next, i] * (256 - p) + texture[j_next, i_next] * p
    return (top * (256 - q) + bottom * q + 2**15) >> 16


def light(samples, offset, gain):
    """Luma samples in another light; offset and gain in 2^-20 grey level (SPEC 10.11)."""
    o = clamp(offset, -MAX_LIGHT * 2**16, MAX_LIGHT * 2**16) >> 8
    g = clamp(gain, -MAX_LIGHT * 2**16, MAX_LIGHT * 2**16) >> 8
    return clamp(((samples << 12) + o + ((samples - 128) * g >> 6) + 2**11) >> 12, 0, 255)


def take_back_light(samples, offset, gain):
    """Luma samples before this light fell on them (SPEC 10.11)."""
    o = clamp(offset, -MAX_LIGHT * 2**16, MAX_LIGHT * 2**16) >> 8
    d = np.maximum(2**18 + (clamp(gain, -MAX_LIGHT * 2**16, MAX_LIGHT * 2**16) >> 8), 2**16)
    return clamp(128 + (((samples - 128) << 18) - (o << 6) + d // 2 + 2**11 * d) // d - 2**11, 0, 255)


class Blend:
    """Adds the sources at each sample, in their order, by weights whose sum is one (SPEC 11.6)."""

    def __init__(self, count):
        self._sum = np.zeros(count, np.int64)
        self._left = np.full(count, WEIGHT_ONE)

    def add(self, at, samples, weight, is_last):
        """Adds a source.

        at       the samples that have the source, indices
        weight   2^-16 of the weights of the mesh
        is_last  the source is the last one of the sample, and has the weight that the others leave
        """
        left = self._left[at]
        weight = np.where(is_last, left, clamp(weight >> 16, 0, left))
        self._left[at] = left - weight
        self._sum[at] += weight * samples

    def result(self):
        return (self._sum + 2**11) >> 12


def blur(cells, radius, axis):
    """Means over 2 * radius + 1 cells along an axis; beyond the ends the last one is repeated (SPEC 11.7)."""
    places, count = np.arange(cells.shape[axis]), cells.shape[axis]
    total = sum(cells.take(clamp(places + offset, 0, count - 1), axis) for offset in range(-radius, radius + 1))
    return (total + radius) // (2 * radius + 1)


def cell_shares(cells, shape):
    """The share of the face at the samples of plane Y, of which each way four sixteenths of a cell are apart."""
    def between(values, size, axis):
        place = 4 * np.arange(size) - 6
        low, high = (values.take(clamp((place >> 4) + k, 0, values.shape[axis] - 1), axis) for k in (0, 1))
        part = (place % 16).reshape((-1, 1) if axis == 0 else (1, -1))
        return low * (16 - part) + high * part
    return (between(between(cells, shape[0], 0), shape[1], 1) + 128) >> 8


def restore_contrast(plane, k):
    """A plane with its full contrast (SPEC 11.7); k is what it was coded with, 1/256, of each sample or of all."""
    return clamp(128 + (((plane - 128) * ((2**24 + k // 2) // k) + 2**15) >> 16), 0, 255)


def enlarge(plane, width, height):
    """A reduced plane with twice as many samples, less the last column or row (SPEC 4.4)."""
    doubled = _double(_double(plane, 1)[:, :width], 0)[:height]
    return clamp((doubled + 2**13) >> 14, 0, 255)


def _double(plane, axis):
    """Twice as many samples along an axis, times 128."""
    places = np.arange(plane.shape[axis])
    even, odd = (sum(factor * plane.take(np.clip(places + offset, 0, len(places) - 1), axis)
                     for offset, factor in kernel) for kernel in (_DOUBLE_EVEN, _DOUBLE_ODD))
    shape = list(plane.shape)
    shape[axis] *= 2
    return np.stack([even, odd], axis + 1).reshape(shape)
