"""The head of a scene from its parts (SPEC 4.12, 6.5)."""

from .byte_reader import ByteReader
from .errors import invalid, too_large
from .limits import MAX_DURATION, MAX_HEAD, MAX_HEAD_PARTS, MAX_HEAD_SYMBOLS, MAX_PASSED_PICTURES


def _product(a, b):
    """Of two elements of GF(256), polynomials modulo x^8 + x^4 + x^3 + x^2 + 1."""
    product = 0
    while b:
        if b & 1:
            product ^= a
        a <<= 1
        if a > 255:
            a ^= 0x11D
        b >>= 1
    return product


_PRODUCTS = [[_product(a, b) for b in range(256)] for a in range(256)]


def _power(exponent):
    power = 1
    for _ in range(exponent % 255):
        power = _PRODUCTS[power][2]
    return power


def _inverse(a):
    return _PRODUCTS[a].index(1)


def _solve(rows):
    """Gauss-Jordan: rows of as many factors as there are rows, and a symbol each. Returns the pieces."""
    count = len(rows)
    for k in range(count):
        pivot = next(n for n in range(k, count) if rows[n][k])
        rows[k], rows[pivot] = rows[pivot], rows[k]
        divisor = _PRODUCTS[_inverse(rows[k][k])]
        rows[k] = [divisor[value] for value in rows[k]]
        for n in range(count):
            if n != k and rows[n][k]:
                multiple = _PRODUCTS[rows[n][k]]
                rows[n] = [a ^ multiple[b] for a, b in zip(rows[n], rows[k])]
    return [row[count:] for row in rows]


class HeadParts:
    """Collects the parts of one head."""

    def __init__(self):
        self._key = None  # what is the same in all parts of a head
        self._symbols = {}  # by index

    def take(self, payload, scene):
        """The head and the (pictures, time) that have passed, once it is whole; None before, and for a `scene` that
        is known."""
        reader = ByteReader(payload)
        name = reader.u16()
        passed = reader.varint(), reader.varint()
        size, count, index = reader.varint(), reader.u8(), reader.u8()
        if not size or not count or index >= MAX_HEAD_PARTS or not passed[0] <= passed[1] <= passed[0] * MAX_DURATION:
            raise invalid("a part of a head is out of range")
        if size > MAX_HEAD or count > MAX_HEAD_SYMBOLS or passed[0] > MAX_PASSED_PICTURES:
            raise too_large("a head is too large, or its scene too long")
        symbol = reader.bytes((size + count - 1) // count)
        if reader.position < len(payload):
            raise invalid("a part of a head is too long")
        if name == scene:
            return None
        key = name, size, count
        if key != self._key:
            self._key, self._symbols = key, {}
        self._symbols.setdefault(index, symbol)
        if len(self._symbols) < count:
            return None
        rows = [[_power(i * k) for k in range(count)] + list(s) for i, s in self._symbols.items()]
        self._symbols = {}
        return bytes(b for piece in _solve(rows) for b in piece)[:size], passed
