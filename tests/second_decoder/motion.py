"""Motion packet: the states of a group of pictures (SPEC 4.5, 5.2, 5.4 to 5.6)."""

from .errors import invalid
from .limits import MAX_DURATION
from .mixer import Mixer
from .range_decoder import Context, Exponential, RangeDecoder, Wide, contexts
from .state import NUMBERS, PARTS
from .trained import MOTION, train

KEY_ZERO = 61440  # probability of a zero of the flag `key`, in 1/65536


def _bucket(x, limits):
    """The number of limits that x is not below."""
    return sum(x >= limit for limit in limits)


def _sign_class(x):
    return 0 if x == 0 else 1 if x > 0 else 2


def _size_class(x):
    return min(abs(x), 2)


def _length_class(length):
    return _bucket(length, (2, 3, 5, 9))


def _place_class(k):
    return _bucket(k, (1, 2, 4, 8, 16))


class Contexts:
    """Everything that a key group resets (SPEC 5.4)."""

    def __init__(self, nominal_duration):
        parts = len(PARTS)
        self.other_count = Context()
        self.has_durations = Context()
        self.to_end = contexts(parts, 4)
        self.length = [Exponential() for _ in range(parts)]
        self.moves_by_history = contexts(parts, 4)
        self.moves_by_span = contexts(parts, 5)
        self.nonzero_by_number = contexts(NUMBERS, 3)
        self.nonzero_by_span = contexts(NUMBERS, 5)
        self.nonzero_by_past = contexts(parts, 6, 9)
        self.nonzero_by_others = contexts(parts, 36)
        self.negative_by_past = contexts(NUMBERS, 3)
        self.negative_by_history = contexts(parts, 9)
        self.larger_by_place = contexts(parts, 6, 6)
        self.larger_by_span = contexts(6, 15)
        self.larger_by_number = contexts(NUMBERS, 2)
        self.rest = [Exponential() for _ in range(parts)]
        train(MOTION, [self.other_count, self.has_durations, self.to_end, self.length, self.moves_by_history,
                       self.moves_by_span, self.nonzero_by_number, self.nonzero_by_span, self.nonzero_by_past,
                       self.nonzero_by_others, self.negative_by_past, self.negative_by_history, self.larger_by_place,
                       self.larger_by_span, self.larger_by_number, self.rest])
        self.duration_differs = Context()
        self.duration_differs_from_second = Context()
        self.duration_change = Wide()

        self.moves_mixer = Mixer(2)
        self.nonzero_mixer = [Mixer(4) for _ in range(parts)]
        self.negative_mixer = Mixer(2)
        self.larger_mixer = [Mixer(3) for _ in range(2)]

        self.change = [0] * NUMBERS  # R1: over the last span in which the part moved
        self.change_before = [0] * NUMBERS  # R2: over the span before that
        self.moved = [0] * parts  # V: bit 0 over the last span, bit 1 over the one before
        self.duration = self.duration_before = nominal_duration  # D1, D2
        self.pictures = None  # in the group before


class MotionDecoder:
    """Decodes the motion packets of a scene."""

    def __init__(self, setup, layout, rest_numbers):
        self._layout = layout
        self._rest_numbers = rest_numbers
        self._nominal_duration = setup.nominal_duration()
        self._last_numbers = None  # of the last picture of the group before
        self._c = None
        self._d = None

    def decode(self, payload):
        """The (state, duration in 1/90000 s) pairs of the group."""
        d = self._d = RangeDecoder(payload)
        anchor = self._read_anchor()
        c = self._c
        if d.flag(c.other_count):
            c.pictures = d.bypass(8) + 1
        elif c.pictures is None:
            raise invalid("a group has the size of one that there is not")
        timed = d.flag(c.has_durations)
        values = [[0] * NUMBERS for _ in range(c.pictures)]
        numbers = list(anchor)
        for p in self._layout.sent_parts:
            self._read_track(p, numbers, values)
        durations = [self._read_duration() if timed else self._nominal_duration for _ in range(c.pictures)]
        d.finish()
        self._last_numbers = numbers
        return list(zip(values, durations))

    def _read_anchor(self):
        """Reads `key`; the numbers at picture -1."""
        if self._d.bit(KEY_ZERO):
            self._c = Contexts(self._nominal_duration)
            return self._rest_numbers
        if self._last_numbers is None:
            raise invalid("the first group of a scene is not a key group")
        return self._last_numbers

    def _read_track(self, p, numbers, values):
        """Moves `numbers` of part p from the anchor to the last picture, and fills `values` of all pictures."""
        last = -1
        end = len(values) - 1
        while last < end:
            before = [numbers[i] for i in PARTS[p]]
            length = self._read_span(p, end - last, last == -1)
            self._read_knot(p, length, numbers)
            for i, number in zip(PARTS[p], before):
                step = self._layout.steps[i]
                a, b = number * step, numbers[i] * step
                for t in range(1, length + 1):
                    values[last + t][i] = a + (2 * (b - a) * t + length) // (2 * length)
            last += length

    def _read_span(self, p, left, first):
        """Pictures to the next knot."""
        if left == 1:
            return 1
        if self._d.flag(self._c.to_end[p][2 * first + (self._c.moved[p] & 1)]):
            return left
        length = 1 + self._d.exponential(self._c.length[p])
        if length > left:
            raise invalid("a span ends after its group")
        return length

    def _read_knot(self, p, length, numbers):
        c = self._c
        span = _length_class(length)
        moves = self._d.mixed(c.moves_mixer, c.moves_by_history[p][c.moved[p]], c.moves_by_span[p][span])
        c.moved[p] = (2 * c.moved[p] + moves) & 3
        if not moves:
            return
        changes = []  # of the numbers before, in this knot
        for i in PARTS[p]:
            change = self._read_change(p, i, span, changes)
            changes.append(change)
            numbers[i] += change
            self._layout.check(i, numbers[i])
            c.change_before[i] = c.change[i]
            c.change[i] = change

    def _read_change(self, p, i, span, changes):
        c, d = self._c, self._d
        past, past_before = c.change[i], c.change_before[i]
        place = _place_class(len(changes))
        nonzero_so_far = len(changes) - changes.count(0)
        if nonzero_so_far > 0 or i != PARTS[p][-1]:
            nonzero = d.mixed(c.nonzero_mixer[p],
                              c.nonzero_by_number[i][_size_class(past)],
                              c.nonzero_by_span[i][span],
                              c.nonzero_by_past[p][place][3 * _size_class(past) + _size_class(past_before)],
                              c.nonzero_by_others[p][self._others_class(changes, nonzero_so_far)])
            if not nonzero:
                return 0
        negative = d.mixed(c.negative_mixer,
                           c.negative_by_past[i][_sign_class(past)],
                           c.negative_by_history[p][3 * _sign_class(past) + _sign_class(past_before)])
        size = self._read_size(p, i, 3 * span + _size_class(past), place)
        return -size if negative else size

    @staticmethod
    def _others_class(changes, nonzero_so_far):
        *_, before_that, before = [0, 0] + changes
        return 9 * min(nonzero_so_far, 3) + 3 * _size_class(before) + _size_class(before_that)

    def _read_size(self, p, i, span_and_past, place):
        """The size of a change that is not zero."""
        c = self._c
        for j in range(6):
            f = min(j, 1)
            if not self._d.mixed(c.larger_mixer[f], c.larger_by_place[p][place][j],
                                 c.larger_by_span[j][span_and_past], c.larger_by_number[i][f]):
                return 1 + j
        return 7 + self._d.exponential(c.rest[p])

    def _read_duration(self):
        c, d = self._c, self._d
        duration = c.duration
        if d.flag(c.duration_differs):
            if d.flag(c.duration_differs_from_second):
                duration += d.wide(c.duration_change)
                if not 1 <= duration <= MAX_DURATION:
                    raise invalid("a duration is out of its range")
            else:
                duration = c.duration_before
        c.duration_before = c.duration
        c.duration = duration
        return duration
