"""Blend packet: the modes of the regions of pictures (SPEC 4.6, 5.6)."""

from .errors import invalid
from .range_decoder import Context, RangeDecoder, contexts
from .trained import BLENDS, train

KEY_ZERO = 61440  # probability of a zero of the flag `key`, in 1/65536
REGIONS = 7
BODY = 5  # the first region whose modes have the second tree
LAST_MODE = 12


class Contexts:
    """Everything that a key blend packet resets."""

    def __init__(self):
        self.other_count = Context()
        self.changed = contexts(REGIONS, 3)
        self.tree = contexts(2, 16)
        train(BLENDS, [self.other_count, self.changed, self.tree])
        self.last = [0] * REGIONS
        self.pictures = None  # in the packet before


class BlendDecoder:
    """Decodes the blend packets of a scene."""

    def __init__(self):
        self._c = None

    def decode(self, payload):
        """The modes of the seven regions of each picture of the packet."""
        d = RangeDecoder(payload)
        if d.bit(KEY_ZERO):
            self._c = Contexts()
        elif self._c is None:
            raise invalid("the first blend packet of a scene is not a key packet")
        c = self._c
        if d.flag(c.other_count):
            c.pictures = d.bypass(8) + 1
        elif c.pictures is None:
            raise invalid("a blend packet has the size of one that there is not")
        modes = [self._read_modes(d) for _ in range(c.pictures)]
        d.finish()
        return modes

    def _read_modes(self, d):
        """The modes of one picture."""
        c = self._c
        changes = 0
        for r in range(REGIONS):
            if d.flag(c.changed[r][min(changes, 2)]):
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
