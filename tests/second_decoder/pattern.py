"""Pattern packet: which slots and pictures its AV1 frames are for, and the chain of packets (SPEC 4.4)."""

from bisect import bisect_right
from dataclasses import dataclass

from .errors import invalid, too_large
from .limits import KEPT_PICTURES, MAX_PATTERNS, MAX_WAITING_PICTURES
from .range_decoder import Context, Exponential, RangeDecoder, Wide, contexts
from .state import read_whole_state

FLAG_ZERO = 61440  # probability of a zero of the flags `first` and `alone`, in 1/65536
ALONE_BITS = 13  # of the number of a pattern that is alone
ALONE_AHEAD = 2048  # the most that it is behind the pictures that have a state
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
    alone: bool = False


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
    """Everything that the first pattern of a scene resets, and that a pattern alone has for itself."""

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
        self._before = None  # the pattern before in the chain
        self._numbers = []  # by slot, of the patterns of the chain; 0 where there is none yet
        self._packets = 0  # of the chain, modulo 16
        self._is_broken = False  # the chain

    @property
    def is_broken(self):
        """Whether something is missing that the chain needs."""
        return self._is_broken

    def break_chain(self):
        """A pattern of the chain cannot be used."""
        self._is_broken = True

    def decode(self, payload, pictures):
        """The patterns of a packet, none if they are unusable.

        pictures  pictures of the scene that have a state
        """
        was_broken, self._is_broken = self._is_broken, True  # as long as the packet may be invalid
        d = RangeDecoder(payload)
        first = d.bit(FLAG_ZERO)
        if first != (self._before is None):
            raise invalid("the first pattern of a scene is missing, or comes twice")
        if not first and d.bit(FLAG_ZERO):
            self._is_broken = was_broken
            return [self._read_alone(d, pictures)]
        if not first and (not self._has_all_before(d, pictures) or was_broken):
            return []
        patterns = [self._read_first(d)] if first else self._read_later(d, pictures)
        d.finish()
        self._packets = (self._packets + 1) % 16
        self._is_broken = False
        return patterns

    def _has_all_before(self, d, pictures):
        """Whether nothing is missing that a packet of the chain needs."""
        packets, states = d.bypass(4), d.bypass(6)
        return packets == self._packets and states == pictures % 61

    def _read_first(self, d):
        self._c = Contexts()
        numbers = read_whole_state(d, self._layout)
        frame, _ = self._read_frame(d, self._c)
        self._add(CodedPattern(0, 0, frame, numbers))
        return self._before

    def _add(self, pattern):
        """Goes on behind a pattern of the chain."""
        self._before = pattern
        self._numbers += [0] * (pattern.slot + 1 - len(self._numbers))
        self._numbers[pattern.slot] = pattern.number

    def _read_alone(self, d, pictures):
        slot = d.bypass(6)
        highest = pictures + ALONE_AHEAD
        number = highest - (highest - d.bypass(ALONE_BITS)) % 2**ALONE_BITS
        self._check_slot(slot)
        if number < 1:
            raise invalid("a pattern of a picture before the first")
        c = Contexts()
        frame, has_length = self._read_frame(d, c)
        if has_length:
            d.flag(c.has_next)  # it is the last
        d.finish()
        return CodedPattern(slot, number, frame, alone=True)

    def _check_slot(self, slot):
        if slot >= self._slots:
            raise too_large("a pattern for a slot after the last")

    def _read_later(self, d, pictures):
        patterns = []
        last = False
        while not last:
            if len(patterns) == MAX_PATTERNS:
                raise too_large("too many patterns in a packet")
            slot = d.bypass(6) if d.flag(self._c.other_slot) else self._before.slot + 1
            number = self._read_number(d, pictures)
            self._check_slot(slot)
            frame, has_length = self._read_frame(d, self._c)
            last = not has_length or not d.flag(self._c.has_next)
            self._add(CodedPattern(slot, number, frame))
            patterns.append(self._before)
        return patterns

    def _read_number(self, d, pictures):
        """The number of the picture of a pattern, by its place among those of the chain."""
        oldest = max(0, pictures - MAX_WAITING_PICTURES - KEPT_PICTURES)
        bounds = [oldest] + [max(number, oldest) for number in sorted(self._numbers)]
        m = len(self._numbers)
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

    def _read_frame(self, d, c):
        """The bytes of a frame, and whether its length was coded."""
        has_length = d.flag(c.has_length)
        length = 1 + d.exponential(c.frame_length) if has_length else None
        header = HeaderBits(c.header)
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
