"""Blend packet: the modes of the regions of pictures (SPEC 4.6, 5.6)."""

from .errors import invalid, too_large
from .group import GroupReader
from .range_decoder import Context, RangeDecoder, contexts
from .trained import BLENDS, train

REGIONS = 7
BODY = 5  # the first region whose modes have the second tree
LAST_MODE = 12


class Contexts:
    """Everything that a key blend packet resets."""

    def __init__(self):
        self.other_count = Context()
        self.changed = contexts(2, REGIONS, 3)  # for the first picture of a later key group those behind
        self.tree = contexts(2, 16)
        train(BLENDS, [self.other_count, self.changed, self.tree])
        self.last = [0] * REGIONS
        self.pictures = None  # in the packet before


class BlendDecoder:
    """Decodes the blend packets of a scene."""

    def __init__(self, first):
        self._groups = GroupReader(first)
        self._c = None

    def decode(self, payload, end):
        """How many pictures are missing before those of the packet, and their modes; None if it is skipped.

        end  number of the picture before which it has to end
        """
        group = self._groups.begin(payload)
        if not group:
            return None
        d, key, missing = group
        return self._read(d, key, missing, None, end)

    def decode_in_unit(self, code, beginning, end):
        """The same for a unit, with the key flag, the number of the first picture and of pictures of its motion."""
        key, first, pictures = beginning
        missing = self._groups.begin_at(key, first)
        if missing is None:
            return None
        return self._read(RangeDecoder(code), key, missing, pictures, end)

    @property
    def needs_key(self):
        return self._groups.needs_key

    def _read(self, d, key, missing, pictures, end):
        if key:
            self._c = Contexts()
        c = self._c
        first = self._groups.next + missing
        if pictures is None:
            pictures = self._read_count(d)
        if first + pictures > end:
            raise too_large("a blend packet is too far ahead of the motion")
        modes = [self._read_modes(d, key and first > 0 and k == 0) for k in range(pictures)]
        d.finish()
        self._groups.end(missing + pictures)
        return missing, modes

    def _read_count(self, d):
        c = self._c
        if d.flag(c.other_count):
            c.pictures = d.bypass(8) + 1
        elif c.pictures is None:
            raise invalid("a blend packet has the size of one that there is not")
        return c.pictures

    def _read_modes(self, d, is_first):
        """The modes of one picture; is_first: of a key group that does not begin the scene."""
        c = self._c
        changes = 0
        for r in range(REGIONS):
            if d.flag(c.changed[is_first][r][min(changes, 2)]):
                mode = self._read_mode(d, c.tree[r >= BODY])
                changes += mode != c.last[r]
                c.last[r] = mode
        return tuple(c.last)

    @staticmethod
    def _read_mode(d, tree):
        node = 1
        for _ in range(4):
            node = 2 * node + d.flag(tree[node])
        if node - 16 > LAST_MODE:
            raise invalid("an unknown blend mode")
        return node - 16
