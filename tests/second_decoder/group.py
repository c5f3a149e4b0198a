"""What motion and blend packets begin with, and which of them can be read (SPEC 4.5, 4.6)."""

from .errors import invalid
from .range_decoder import RangeDecoder

KEY_ZERO = 61440  # probability of a zero of the flag `key`, in 1/65536
_NUMBER_BITS = 10
_LATE = 256  # a number may be so much below the one that is next


def read_number(d, following):
    """The number of a group's first picture, near the one that follows the group before."""
    lowest = following - _LATE
    return lowest + (d.bypass(_NUMBER_BITS) - lowest) % 2**_NUMBER_BITS


class GroupReader:
    """Reads the beginnings of the groups of a scene, of one kind."""

    def __init__(self, first=0):
        self.next = first  # number of the picture behind the last group that has been used
        self._needs_key = True

    def begin(self, payload):
        """The range decoder of a group, its `key` and how many pictures are missing before it; None: it is skipped."""
        needs_key, self._needs_key = self._needs_key, True  # as long as the group may be invalid
        d = RangeDecoder(payload)
        key = d.bit(KEY_ZERO)
        first = read_number(d, self.next)
        if first == 0 and not key:
            raise invalid("the first group of a scene is not a key group")
        if first < self.next:
            self._needs_key = needs_key
            return None
        missing = first - self.next
        return (d, key, missing) if key or not (needs_key or missing) else None

    @property
    def needs_key(self):
        """Whether something is missing that all but a key group need."""
        return self._needs_key

    def begin_at(self, key, first):
        """The same where the beginning is known: how many pictures are missing; None: it is skipped."""
        if first < self.next:
            return None
        missing = first - self.next
        readable = key or not (self._needs_key or missing)
        self._needs_key = True
        return missing if readable else None

    def end(self, pictures):
        """A group has been read, which goes on for so many pictures with those that are missing before it."""
        self.next += pictures
        self._needs_key = False
