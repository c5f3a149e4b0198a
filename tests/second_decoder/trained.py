"""The trained state of contexts (SPEC 5.6), read from bitstream/entropy/trained_contexts.cpp."""

import pathlib
import re

from .integers import checksum
from .range_decoder import Context, Exponential

_TEXT = (pathlib.Path(__file__).parents[2] / "bitstream/entropy/trained_contexts.cpp").read_text()


def _table(name, expected_checksum):
    body = re.search(name + r"\[\] = \{(.*?)\};", _TEXT, re.DOTALL).group(1)
    pairs = [(int(zero), int(bits)) for zero, bits in re.findall(r"\{(\d+), (\d+)\}", body)]
    assert checksum(n for pair in pairs for n in pair) == expected_checksum
    return pairs


MOTION = _table("kMotion", 0xAC3D72B2F8018E27)
BLENDS = _table("kBlends", 0xAF41CDF08A40AA87)


def _in_order(contexts):
    if isinstance(contexts, Context):
        yield contexts
    elif isinstance(contexts, Exponential):
        yield from contexts.more
        yield from contexts.top_bit
    else:
        for inner in contexts:
            yield from _in_order(inner)


def train(table, contexts):
    """Sets contexts, nested in lists, from a table."""
    contexts = list(_in_order(contexts))
    assert len(contexts) == len(table)
    for context, (zero, bits) in zip(contexts, table):
        context.fast = context.slow = zero << 8
        context.count = bits
