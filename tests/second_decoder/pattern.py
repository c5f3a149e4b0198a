"""Pattern packet: which slots and pictures its AV1 frames are for (SPEC 4.4)."""

from bisect import bisect_right
from dataclasses import dataclass

from .errors import invalid, too_large
from .limits import KEPT_PICTURES, MAX_PATTERNS, MAX_WAITING_PICTURES
from .range_decoder import Context, Exponential, RangeDecoder, Wide, contexts
from .state import read_whole_state

FIRST_ZERO = 61440  # probability of a zero of the flag `first`, in 1/65536
HEADER_BYTES = 19
END_VIRTUAL_BYTES = 3  # a frame up to the end of the code ends when so many have been read
_EXAMPLE_FRAMES = (
    "30 28 02 40 01 00 00 83 4C 50 19 48 A2 45 98 90 07 80 00",
    "30 30 02 40 0F 00 81 06 99 C0 06 80 40 8B 18 00 07 00 C0",
    "0A 0B 00 00 00 04 CD 7E 7F FD 7F C0 20 30 10 00 97 E0 1A")


@dataclass
class CodedPattern:
    slot: int
    number: int  # of its picture
    frame: bytes
    numbers: list = None  # the seen state, of the first pattern of a scene only


class HeaderBits:
    """Contexts of the first bits of a frame, and where in the frame the next bit is."""

    def __init__(self, header):
        self._header = header
        self._bits = []

    def context(self):
        b = len(self._bits)
        return self._header[self._kind(b)][b][self._bits[-1] if b else 0]

    def append(self, bit):
        self._bits.append(bit)

    def _kind(self, b):
        if b >= 5 and self._bits[4]:
            return 2
        return 1 if b >= 12 and self._bits[11] else 0


def _initial_header():
    """Header contexts that have seen the example frames."""
    header = contexts(3, 8 * HEADER_BYTES, 2)
    for frame in _EXAMPLE_FRAMES:
        bits = HeaderBits(header)
        for byte in bytes.fromhex(frame):
            for shift in range(7, -1, -1):
                bit = byte >> shift & 1
                bits.context().update(bit)
                bits.append(bit)
    return header


class Contexts:
    """Everything that the first pattern of a scene resets."""

    def __init__(self):
        self.has_length = Context()
        self.has_next = Context()
        self.other_slot = Context()
        self.header = _initial_header()
        self.frame_length = Exponential()
        self.from_end = Exponential()
        self.gap = Wide()
        self.from_middle = Wide()


class PatternDecoder:
    """Decodes the pattern packets of a scene."""

    def __init__(self, setup, layout):
        self._slots = setup.patterns
        self._layout = layout
        self._c = None
        self._before = None  # the pattern before

    def decode(self, payload, numbers_in_store, pictures):
        """The patterns of a packet.

        numbers_in_store  number of the pattern of each slot, a dictionary
        pictures          pictures of the scene whose states have been decoded
        """
        d = RangeDecoder(payload)
        if d.bit(FIRST_ZERO):
            patterns = [self._read_first(d)]
        else:
            patterns = self._read_later(d, dict(numbers_in_store), pictures)
        d.finish()
        return patterns

    def _read_first(self, d):
        if self._before:
            raise invalid("a first pattern after another")
        self._c = Contexts()
        numbers = read_whole_state(d, self._layout)
        frame, _ = self._read_frame(d)
        self._before = CodedPattern(0, 0, frame, numbers)
        return self._before

    def _read_later(self, d, numbers_in_store, pictures):
        if not self._before:
            raise invalid("the first pattern of a scene is missing")
        patterns = []
        last = False
        while not last:
            if len(patterns) == MAX_PATTERNS:
                raise too_large("too many patterns in a packet")
            slot = d.bypass(6) if d.flag(self._c.other_slot) else self._before.slot + 1
            number = self._read_number(d, sorted(numbers_in_store.values()), pictures)
            if slot >= self._slots:
                raise too_large("a pattern for a slot after the last")
            frame, has_length = self._read_frame(d)
            last = not has_length or not d.flag(self._c.has_next)
            self._before = CodedPattern(slot, number, frame)
            numbers_in_store[slot] = number
            patterns.append(self._before)
        return patterns

    def _read_number(self, d, numbers, pictures):
        """The number of the picture of a pattern, by its place among `numbers` of the store."""
        oldest = max(0, pictures - MAX_WAITING_PICTURES - KEPT_PICTURES)
        bounds = [oldest] + [max(number, oldest) for number in numbers]
        m = len(numbers)
        i = bisect_right(bounds, max(self._before.number, oldest)) - 1 + d.wide(self._c.gap)
        if not 0 <= i <= m:
            raise invalid("a pattern is not between those of the store")
        if i == m:
            low, high = bounds[m], pictures - 1
            number = high - d.exponential(self._c.from_end)
        else:
            low, high = bounds[i], bounds[i + 1] - 1
            number = low + (bounds[i + 1] - low) // 2 + d.wide(self._c.from_middle)
        if not low <= number <= high or number == 0:
            raise invalid("a pattern of a picture that is out of the range")
        return number

    def _read_frame(self, d):
        """The bytes of a frame, and whether its length was coded."""
        has_length = d.flag(self._c.has_length)
        length = 1 + d.exponential(self._c.frame_length) if has_length else None
        header = HeaderBits(self._c.header)
        frame = bytearray()
        while not frame or (len(frame) < length if has_length else d.virtual_bytes < END_VIRTUAL_BYTES):
            frame.append(self._read_header_byte(d, header) if len(frame) < HEADER_BYTES else d.bypass(8))
        return bytes(frame), has_length

    @staticmethod
    def _read_header_byte(d, header):
        byte = 0
        for _ in range(8):
            bit = d.flag(header.context())
            header.append(bit)
            byte = byte << 1 | bit
        return byte
