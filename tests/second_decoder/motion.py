"""Motion packet: the states of a group of pictures (SPEC 4.5, 5.2, 5.4 to 5.6, 6.2)."""

from dataclasses import dataclass

from .errors import invalid, too_large
from .group import GroupReader
from .limits import MAX_BRIDGED, MAX_DURATION
from .mixer import Mixer
from .range_decoder import Context, Exponential, Wide, contexts
from .state import NUMBERS, PARTS
from .trained import MOTION, train

_TIME_BITS = 22


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


class TrackContexts:
    """Contexts and mixers of tracks (SPEC 5.4)."""

    def __init__(self):
        parts = len(PARTS)
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
        self.trained = [self.to_end, self.length, self.moves_by_history, self.moves_by_span, self.nonzero_by_number,
                        self.nonzero_by_span, self.nonzero_by_past, self.nonzero_by_others, self.negative_by_past,
                        self.negative_by_history, self.larger_by_place, self.larger_by_span, self.larger_by_number,
                        self.rest]

        self.moves_mixer = Mixer(2)
        self.nonzero_mixer = [Mixer(4) for _ in range(parts)]
        self.negative_mixer = Mixer(2)
        self.larger_mixer = [Mixer(3) for _ in range(2)]


class History:
    """Of the spans before (SPEC 5.4)."""

    def __init__(self):
        self.change = [0] * NUMBERS  # R1: over the last span in which the part moved
        self.change_before = [0] * NUMBERS  # R2: over the span before that
        self.moved = [0] * len(PARTS)  # V: bit 0 over the last span, bit 1 over the one before


class Memory:
    """Everything that a key group resets."""

    def __init__(self, nominal_duration):
        self.other_count = Context()
        self.has_durations = Context()
        self.tracks = TrackContexts()
        self.held = contexts(len(PARTS))
        self.first_knots = TrackContexts()  # of key groups
        train(MOTION, [self.other_count, self.has_durations, self.tracks.trained, self.held,
                       self.first_knots.trained])
        self.duration_differs = Context()
        self.duration_differs_from_second = Context()
        self.duration_change = Wide()

        self.history = History()
        self.duration = self.duration_before = nominal_duration  # D1, D2
        # In the group before; a live stream's groups last 0.2 s as a rule.
        self.pictures = min(max((36000 + nominal_duration) // (2 * nominal_duration), 1), 256)


class KnotReader:
    """Reads knots of tracks with one set of contexts, which it changes like the history (SPEC 5.4)."""

    def __init__(self, decoder, layout, track_contexts, history):
        self._d = decoder
        self._layout = layout
        self._c = track_contexts
        self._h = history

    def read(self, p, span, before):
        """The numbers of part p at the end of a span of this class; `before` are those of the knot before."""
        c, h = self._c, self._h
        moves = self._d.mixed(c.moves_mixer, c.moves_by_history[p][h.moved[p]], c.moves_by_span[p][span])
        h.moved[p] = (2 * h.moved[p] + moves) & 3
        if not moves:
            return before
        changes = []  # of the numbers before, in this knot
        for i, number in zip(PARTS[p], before):
            changes.append(self._read_change(p, i, span, changes))
            self._layout.check(i, number + changes[-1])
            h.change_before[i] = h.change[i]
            h.change[i] = changes[-1]
        return [number + change for number, change in zip(before, changes)]

    def _read_change(self, p, i, span, changes):
        c, d = self._c, self._d
        past, past_before = self._h.change[i], self._h.change_before[i]
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


@dataclass
class Group:
    pictures: list  # (state, duration in 1/90000 s) of each, those that are missing before the group first
    missing: int
    uncertain: int  # pictures before a knot of each part, those that are missing included
    beginning: tuple  # key, number of the first picture behind the missing ones, number of pictures behind them


class MotionDecoder:
    """Decodes the motion packets of a scene."""

    def __init__(self, setup, layout, rest_numbers, first, time):
        self._layout = layout
        self._rest_numbers = rest_numbers
        self._nominal_duration = setup.nominal_duration()
        self._groups = GroupReader(first)
        self._last_numbers = rest_numbers  # of the last picture of the group before
        self._time = time  # of the picture after it, from the start of the scene, as far as it is known
        self._unknown = set(layout.sent_parts) if first else set()  # after joining
        self._m = None
        self._d = None

    @property
    def needs_key(self):
        return self._groups.needs_key

    def decode(self, payload, most):
        """The group, with those missing before it at most `most` pictures; None if it is skipped."""
        beginning = self._groups.begin(payload)
        if not beginning:
            return None
        self._d, key, missing = beginning
        if key:
            self._m = Memory(self._nominal_duration)
        return self._read_group(key, missing, most)

    def _read_group(self, key, missing, most):
        """All behind `first`."""
        first = self._groups.next + missing
        is_later_key = key and first > 0
        pictures = self._read_count()
        if missing + pictures > most:
            raise too_large("too many pictures wait, or are in a scene")
        timed = self._d.flag(self._m.has_durations)
        missing_time = self._read_missing_time(missing) if timed and is_later_key else missing * self._nominal_duration
        is_unsure = bool(self._unknown)
        numbers = list(self._last_numbers)
        anchor = [number * step for number, step in zip(numbers, self._layout.steps)]
        values = [list(anchor) for _ in range(missing + pictures)]
        first_knots = [self._read_track(p, is_later_key, missing, numbers, values) for p in self._layout.sent_parts]
        durations = [self._read_duration() if timed else self._nominal_duration for _ in range(pictures)]
        self._d.finish()
        self._groups.end(missing + pictures)
        self._last_numbers = numbers
        self._time += missing_time + sum(durations)
        uncertain = missing + (pictures if is_unsure else max(first_knots) if missing else 0)
        return Group(list(zip(values, _shared(missing_time, missing) + durations)), missing, uncertain,
                     (key, first, pictures))

    def _read_count(self):
        if self._d.flag(self._m.other_count):
            self._m.pictures = self._d.bypass(8) + 1
        return self._m.pictures

    def _read_missing_time(self, missing):
        """How long the missing pictures before a key group last."""
        time = (self._d.bypass(_TIME_BITS) - self._time) % 2**_TIME_BITS
        if time < missing:
            raise invalid("missing pictures have no time")
        return time

    def _read_track(self, p, is_later_key, missing, numbers, values):
        """Moves `numbers` of part p from the anchor to the last picture, and fills `values` from where it moves on.

        Returns the picture of its first knot.
        """
        first_knot = None
        reader = KnotReader(self._d, self._layout, self._m.tracks, self._m.history)
        last, end = -1, len(values) - missing - 1
        while last < end:
            before = [numbers[i] for i in PARTS[p]]
            length = self._read_span(p, end - last, last == -1)
            after = (self._read_first_knot(p, before) if is_later_key and last == -1 else
                     reader.read(p, _length_class(length), before))
            begin = missing + last if last >= 0 else missing - 1 - min(missing, MAX_BRIDGED)
            self._fill(p, values, begin, before, missing + last + length, after)
            numbers[PARTS[p].start:PARTS[p].stop] = after
            last += length
            first_knot = last if first_knot is None else first_knot
        return first_knot

    def _read_first_knot(self, p, anchor):
        """The first knot of a key group after the first: the anchor, or from the rest state, without history."""
        if self._d.flag(self._m.held[p]):
            return anchor
        self._unknown.discard(p)
        reader = KnotReader(self._d, self._layout, self._m.first_knots, History())
        return reader.read(p, _length_class(1), [self._rest_numbers[i] for i in PARTS[p]])

    def _fill(self, p, values, begin, before, end, after):
        """Values of part p from one knot to the next, which are in the places `begin` and `end` of `values`."""
        length = end - begin
        for i, from_number, to_number in zip(PARTS[p], before, after):
            a, b = from_number * self._layout.steps[i], to_number * self._layout.steps[i]
            for t in range(1, length + 1):
                values[begin + t][i] = a + (2 * (b - a) * t + length) // (2 * length)

    def _read_span(self, p, left, first):
        """Pictures to the next knot."""
        c = self._m.tracks
        if left == 1:
            return 1
        if self._d.flag(c.to_end[p][2 * first + (self._m.history.moved[p] & 1)]):
            return left
        length = 1 + self._d.exponential(c.length[p])
        if length > left:
            raise invalid("a span ends after its group")
        return length

    def _read_duration(self):
        m, d = self._m, self._d
        duration = m.duration
        if d.flag(m.duration_differs):
            if d.flag(m.duration_differs_from_second):
                duration += d.wide(m.duration_change)
                if not 1 <= duration <= MAX_DURATION:
                    raise invalid("a duration is out of its range")
            else:
                duration = m.duration_before
        m.duration_before = m.duration
        m.duration = duration
        return duration


def _shared(time, pictures):
    """The durations of pictures that share a time."""
    return [time * (k + 1) // pictures - time * k // pictures for k in range(pictures)]
