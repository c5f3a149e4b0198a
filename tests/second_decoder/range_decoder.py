"""Range decoder, contexts and integers (SPEC 2.2 to 2.4)."""

from .errors import invalid, truncated

MAX_VIRTUAL_BYTES = 16


class Context:
    """Probability that a flag is zero, learned from earlier values (SPEC 2.3)."""

    __slots__ = ("fast", "slow", "count")

    def __init__(self):
        self.fast = self.slow = 32768
        self.count = 0

    def zero(self):
        """Probability of a zero in 1/65536."""
        return min(max((self.fast + self.slow + 1) >> 1, 32), 65504)

    def update(self, value):
        step = 2 * self.count + 3
        if value:
            self.fast -= 2 * self.fast // min(step, 48)
            self.slow -= 2 * self.slow // min(step, 256)
        else:
            self.fast += 2 * (65535 - self.fast) // min(step, 48)
            self.slow += 2 * (65535 - self.slow) // min(step, 256)
        self.count = min(self.count + 1, 128)


def contexts(*shape):
    """Contexts in their initial state, as nested lists of the given sizes; one context without sizes."""
    if not shape:
        return Context()
    return [contexts(*shape[1:]) for _ in range(shape[0])]


class Exponential:
    """Contexts of exponential()."""

    def __init__(self):
        self.more = contexts(23)
        self.top_bit = contexts(4)


class Wide:
    """Contexts of wide()."""

    def __init__(self):
        self.not_zero = Context()
        self.negative = Context()
        self.magnitude = Exponential()


class RangeDecoder:
    """Reads one range code. Past the end of the bytes it reads a few virtual zeros."""

    def __init__(self, data):
        self._data = data
        self._position = 0
        self._range = 0xFFFFFFFF
        self._code = 0
        for _ in range(4):
            self._code = self._code << 8 | self._next_byte()
        if self._code == 0xFFFFFFFF:
            raise invalid("a range code begins with four bytes of ones")

    @property
    def virtual_bytes(self):
        return max(0, self._position - len(self._data))

    def _next_byte(self):
        self._position += 1
        if self._position <= len(self._data):
            return self._data[self._position - 1]
        if self.virtual_bytes > MAX_VIRTUAL_BYTES:
            raise truncated("a range code ends early")
        return 0

    def finish(self):
        """Checks that no bytes are left."""
        if self._position < len(self._data):
            raise invalid("excess bytes after a range code")

    def bit(self, zero):
        """A bit that is zero with a probability of zero / 65536."""
        bound = self._range * zero >> 16
        if self._code < bound:
            value = 0
            self._range = bound
        else:
            value = 1
            self._code -= bound
            self._range -= bound
        while self._range < 2**24:
            self._code = (self._code << 8 | self._next_byte()) & 0xFFFFFFFF
            self._range <<= 8
        return value

    def bypass(self, bits):
        value = 0
        for _ in range(bits):
            value = value << 1 | self.bit(32768)
        return value

    def flag(self, context):
        value = self.bit(context.zero())
        context.update(value)
        return value

    def mixed(self, mixer, *inputs):
        """A flag whose probability is mixed from those of the input contexts (SPEC 2.5)."""
        value = self.bit(mixer.mix(inputs))
        mixer.update(value)
        return value

    def exponential(self, e):
        """0..2^24 - 2."""
        exponent = 0
        while exponent < 23 and self.flag(e.more[exponent]):
            exponent += 1
        if exponent == 0:
            return 0
        top = self.flag(e.top_bit[min(exponent, 4) - 1])
        return (1 << exponent) - 1 + (top << (exponent - 1)) + self.bypass(exponent - 1)

    def wide(self, w):
        """A signed number."""
        if not self.flag(w.not_zero):
            return 0
        negative = self.flag(w.negative)
        size = self.exponential(w.magnitude) + 1
        return -size if negative else size
