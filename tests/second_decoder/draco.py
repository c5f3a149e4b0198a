"""Points of a Draco stream: a sequential point cloud with one attribute of three 32-bit integers (SPEC 4.2).

Of Draco's bitstream version 2.3 this is what can follow the 22 bytes that the format leaves out: values as they are,
or integers with or without prediction by the point before, with any of the codings of symbols.
"""

from .errors import invalid

COMPONENTS = 3
RAW_VALUES, INTEGERS = 0, 1  # decoders of an attribute; the others are for floating point
NO_PREDICTION, WRAP_TRANSFORM = 0xFE, 1
LAST_PREDICTION, LAST_TRANSFORM = 6, 3
TAGGED, DIRECT = 0, 1  # codings of symbols
TAG_BITS, MAX_SYMBOL_BITS = 5, 18


def read_points(data, count):
    """The first `count` points of the stream, lists of three signed integers."""
    reader = _Reader(data)
    kind = reader.number(1)
    if kind == RAW_VALUES:
        values = [_signed_32(reader.number(4)) for _ in range(COMPONENTS * count)]
    elif kind == INTEGERS:
        values = _read_integers(reader, COMPONENTS * count)
    else:
        raise invalid("a Draco attribute is not of integers")
    return [values[i:i + COMPONENTS] for i in range(0, len(values), COMPONENTS)]


class _Reader:
    """Little-endian numbers; whatever is missing makes the Draco data invalid."""

    def __init__(self, data):
        self._data = data

    def bytes(self, count):
        if count > len(self._data):
            raise invalid("Draco data ends early")
        taken, self._data = self._data[:count], self._data[count:]
        return taken

    def number(self, count):
        return int.from_bytes(self.bytes(count), "little")

    def varint(self):
        value = shift = 0
        while True:
            byte = self.number(1)
            value |= (byte & 127) << shift
            if byte < 128:
                return value
            shift += 7

    def bits(self, sizes):
        """Numbers of so many bits each, the low bits first; those that are missing at the end are zero."""
        count = min((sum(sizes) + 7) // 8, len(self._data))
        bits = self.number(count)
        values = []
        for size in sizes:
            values.append(bits % 2**size)
            bits >>= size
        return values


def _signed_32(x):
    return (x + 2**31) % 2**32 - 2**31


def _unfold(symbol):
    """A signed number from an unsigned symbol: 0, -1, 1, -2, ..."""
    return -(symbol >> 1) - 1 if symbol & 1 else symbol >> 1


def _read_integers(reader, count):
    method = reader.number(1)
    predicted = False
    if method != NO_PREDICTION:
        transform = reader.number(1)
        if method > LAST_PREDICTION or transform != 0xFF and transform > LAST_TRANSFORM:
            raise invalid("an unknown Draco prediction")
        predicted = transform == WRAP_TRANSFORM  # Draco ignores a prediction with any other transform
    if reader.number(1):
        symbols = _read_symbols(reader, count)
    else:
        size = reader.number(1)
        symbols = [reader.number(size) % 2**32 for _ in range(count)]
    corrections = [_unfold(symbol) for symbol in symbols]
    return _add_previous_point(reader, corrections) if predicted else corrections


def _add_previous_point(reader, corrections):
    """Adds to each number that of the point before; the sum is wrapped into the range of the numbers."""
    low, high = _signed_32(reader.number(4)), _signed_32(reader.number(4))
    if not 0 <= high - low < 2**31 - 1:
        raise invalid("the range of Draco values is empty")
    values = []
    for i, correction in enumerate(corrections):
        before = values[i - COMPONENTS] if i >= COMPONENTS else 0
        value = _signed_32(min(max(before, low), high) + correction)
        if value > high:
            value -= high - low + 1
        elif value < low:
            value += high - low + 1
        values.append(value)
    return values


def _read_symbols(reader, count):
    coding = reader.number(1)
    if coding == TAGGED:
        return _read_tagged(reader, count)
    if coding == DIRECT:
        bits = reader.number(1)
        if not 1 <= bits <= MAX_SYMBOL_BITS:
            raise invalid("Draco symbols of an unknown size")
        return _RansDecoder(reader, bits).symbols(count)
    raise invalid("an unknown coding of Draco symbols")


def _read_tagged(reader, count):
    """The number of bits of each point by rANS, then the bits of all, the low ones first."""
    sizes = _RansDecoder(reader, TAG_BITS).symbols(count // COMPONENTS)
    if max(sizes) > 32:
        raise invalid("a Draco value has too many bits")
    return reader.bits([size for size in sizes for _ in range(COMPONENTS)])


class _RansDecoder:
    """Asymmetric numeral system with a table of probabilities."""

    def __init__(self, reader, symbol_bits):
        self._one = 1 << min(max(3 * symbol_bits // 2, 12), 20)
        self._base = 4 * self._one
        self._symbol_at = []  # of each place in 0.._one - 1
        self._first = []  # place of each symbol
        self._probability = self._read_table(reader)
        for symbol, probability in enumerate(self._probability):
            self._first.append(len(self._symbol_at))
            self._symbol_at += [symbol] * probability
        self._data = bytearray(reader.bytes(reader.varint()))
        self._state = self._read_state()

    def _read_table(self, reader):
        """Probabilities of the symbols, which sum up to _one."""
        count = reader.varint()
        probabilities = []
        while len(probabilities) < count:
            byte = reader.number(1)
            if byte & 3 == 3:
                probabilities += [0] * ((byte >> 2) + 1)
            else:
                probabilities.append(byte >> 2 | reader.number(byte & 3) << 6)
        if len(probabilities) != count or sum(probabilities) != self._one:
            raise invalid("a Draco table of probabilities is wrong")
        return probabilities

    def _read_state(self):
        """The first state, from the last one to four bytes; their number is in the two highest bits."""
        size = (self._data[-1] >> 6) + 1 if self._data else 1
        if size > len(self._data):
            raise invalid("Draco data ends early")
        state = int.from_bytes(self._data[-size:], "little") % (1 << (8 * size - 2)) + self._base
        del self._data[-size:]
        if state >= self._base * 256:
            raise invalid("a Draco state is too large")
        return state

    def symbols(self, count):
        return [self._symbol() for _ in range(count)]

    def _symbol(self):
        while self._state < self._base and self._data:
            self._state = self._state << 8 | self._data.pop()
        whole, place = divmod(self._state, self._one)
        symbol = self._symbol_at[place]
        self._state = whole * self._probability[symbol] + place - self._first[symbol]
        return symbol
