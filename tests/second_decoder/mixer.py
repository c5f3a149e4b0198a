"""Mixing of the probabilities of several contexts (SPEC 2.5)."""

import math

from .integers import clamp, table

_LOG = table((65536 * math.log2(1 + i / 256) for i in range(257)), 0x9E4EB0155CCE533F)
_POWER = table((65536 * 2 ** (-i / 256) for i in range(257)), 0x1B058F3B529A8D5D)

_INITIAL = (4, 6, 9, 13, 18, 20)  # first weight of a level, over 16 * number of inputs
_MAX_ODDS = 12 * 65536  # 12 bits
_MAX_WEIGHT = 8 * 65536


def cost(p):
    """-log2(p / 65536) in 1/65536 bit, p in 1..65536."""
    n = p.bit_length() - 1
    f = (p << (16 - n)) - 65536
    j, r = f >> 8, f & 255
    return 2**20 - (n << 16) - _LOG[j] - ((_LOG[j + 1] - _LOG[j]) * r >> 8)


def stretch(p):
    """Log odds of a zero, in 1/65536 bit."""
    return cost(65536 - p) - cost(p)


def squash(x):
    """The inverse of stretch: a probability in 1/65536."""
    x = clamp(x, -_MAX_ODDS, _MAX_ODDS)
    a = abs(x)
    j, r = (a >> 8) & 255, a & 255
    odds = ((_POWER[j] - ((_POWER[j] - _POWER[j + 1]) * r >> 8)) << 8) >> (a >> 16)
    larger = 2**40 // (2**24 + odds)
    return clamp(65536 - larger if x < 0 else larger, 32, 65504)


def level(count):
    """Experience of a context with this count, 0..5."""
    if count < 3:
        return count
    return 3 if count < 6 else 4 if count < 16 else 5


class Mixer:
    """Weights in 1/65536 of each input at each level of experience."""

    def __init__(self, inputs):
        self._weights = [[65536 * s // (16 * inputs) for s in _INITIAL] for _ in range(inputs)]

    def mix(self, inputs):
        """The probability of a zero; update() follows, with the value that was coded."""
        self._inputs = inputs
        self._levels = [level(c.count) for c in inputs]
        self._odds = [stretch(c.zero()) for c in inputs]
        total = sum(odds * weights[at] for odds, weights, at in zip(self._odds, self._weights, self._levels))
        self._zero = squash(clamp(total, -12 * 2**32, 12 * 2**32) >> 16)
        return self._zero

    def update(self, value):
        error = (0 if value else 65536) - self._zero
        for context, odds, weights, at in zip(self._inputs, self._odds, self._weights, self._levels):
            weights[at] = clamp(weights[at] + (odds * error >> 22), -_MAX_WEIGHT, _MAX_WEIGHT)
            context.update(value)
