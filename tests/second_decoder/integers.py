"""Integer arithmetic (SPEC 1) and the tables of sine and power of two (SPEC 9.1).

nearest, quotient and clamp take Python integers or numpy arrays of 64-bit integers.
"""

import math

import numpy as np

from .limits import MAX_LOG_SCALE


def nearest(a, n):
    """a / 2^n, rounded to the nearest integer, halves up."""
    return (a + (1 << (n - 1))) >> n


def quotient(a, b):
    """a / b rounded toward zero; b is positive."""
    return (a + (a < 0) * (b - 1)) // b


def clamp(x, low, high):
    if isinstance(x, np.ndarray):
        return np.minimum(np.maximum(x, low), high)
    return min(max(x, low), high)


def complete(parts, whole):
    """Parts (first axis), of which the first of the largest gets what the others leave of the whole."""
    result = parts.copy()
    largest = parts.argmax(axis=0)[None]
    left = whole - parts.sum(axis=0)[None]
    np.put_along_axis(result, largest, np.take_along_axis(parts, largest, axis=0) + left, axis=0)
    return result


def rounded(x):
    """The nearest integer of a real number, halves up: round() in the definition of a table."""
    return math.floor(x + 0.5)


def checksum(integers):
    """FNV-1a of 64 bits over integers of four bytes (SPEC 9)."""
    value = 0xCBF29CE484222325
    for integer in integers:
        for byte in (integer & 0xFFFFFFFF).to_bytes(4, "little"):
            value = (value ^ byte) * 0x100000001B3 % 2**64
    return value


def table(values, expected_checksum):
    """The values rounded to integers; their checksum proves that the floating point was good enough."""
    result = [rounded(x) for x in values]
    assert checksum(result) == expected_checksum
    return result


_SINE = table((2**14 * math.sin(math.pi / 2 * i / 256) for i in range(257)), 0xB4992E20F7BA9D23)
_POWER = table((2**16 * 2 ** (i / 256) for i in range(257)), 0x9A789BF327D79077)


def _at(values, x, n):
    """Table entry x / 2^n, interpolated linearly."""
    i, f = x >> n, x % (1 << n)
    return values[i] if f == 0 else values[i] + nearest((values[i + 1] - values[i]) * f, n)


def sin(angle):
    """Sine in 2^-14 of an angle in 2^-16 of a full rotation."""
    angle %= 2**16
    w = angle % 2**14
    if angle < 2**14:
        return _at(_SINE, w, 6)
    if angle < 2**15:
        return _at(_SINE, 2**14 - w, 6)
    if angle < 3 * 2**14:
        return -_at(_SINE, w, 6)
    return -_at(_SINE, 2**14 - w, 6)


def cos(angle):
    return sin(angle + 2**14)


def exp2(e):
    """2^(e / 4096) in 2^-16; e is clamped to 0..13 octaves."""
    e = clamp(e, 0, MAX_LOG_SCALE)
    return _at(_POWER, e % 2**12, 4) << (e >> 12)


def log2(x):
    """log2(x) in 2^-12, rounded down; x > 0."""
    n = x.bit_length() - 1
    m = x >> (n - 31) if n > 31 else x << (31 - n)
    for _ in range(12):
        m = m * m >> 31
        n *= 2
        if m >= 2**32:
            n += 1
            m >>= 1
    return n
