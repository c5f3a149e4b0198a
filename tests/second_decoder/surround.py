"""Surround packet: how grid points move with head, body and ground (SPEC 4.3)."""

from dataclasses import dataclass

from .byte_reader import ByteReader
from .errors import invalid, too_large
from .limits import MAX_SURROUND_CELLS
from .range_decoder import Context, RangeDecoder, contexts

FULL = 4  # a value of a layer that leaves nothing to the motions below


@dataclass
class Surround:
    columns: int
    rows: int
    head: list  # rows + 1 rows of columns + 1 values 0..4
    body: list

    @staticmethod
    def without_packet():
        return Surround(1, 1, [[0, 0], [0, 0]], [[0, 0], [0, 0]])


def read_surround(payload):
    reader = ByteReader(payload)
    columns, rows = _read_size(reader), _read_size(reader)
    decoder = RangeDecoder(reader.rest())
    coded = [[True] * (columns + 1) for _ in range(rows + 1)]
    head = _read_layer(decoder, coded)
    body = [[0] * (columns + 1) for _ in range(rows + 1)]
    if decoder.flag(Context()):
        body = _read_layer(decoder, [[value < FULL for value in row] for row in head])
    decoder.finish()
    return Surround(columns, rows, head, body)


def _read_size(reader):
    cells = reader.varint()
    if cells == 0:
        raise invalid("a surround without cells")
    if cells > MAX_SURROUND_CELLS:
        raise too_large("too many cells in the surround")
    return cells


def _read_layer(decoder, coded):
    """A layer whose values are 0 where they are not coded."""
    differs = contexts(8)
    nexts = contexts(5, 3)
    layer = []
    for coded_row in coded:
        row = []
        above = layer[-1] if layer else None
        for c, is_coded in enumerate(coded_row):
            value = _read_value(decoder, differs, nexts, _neighbours(row, above, c)) if is_coded else 0
            row.append(value)
        layer.append(row)
    return layer


def _neighbours(row, above, c):
    """The values to the left, above, above left and above right of column c."""
    if above is None:
        return (row[-1] if row else 0,) * 4
    up = above[c]
    up_right = above[c + 1] if c + 1 < len(above) else up
    if c == 0:
        return up, up, up, up_right
    return row[-1], up, above[c - 1], up_right


def _read_value(decoder, differs, nexts, neighbours):
    left, up, up_left, up_right = neighbours
    equal = (left == up) + 2 * (up == up_left) + 4 * (up == up_right)
    predicted = min(max(left + up - up_left, min(left, up)), max(left, up))
    if not decoder.flag(differs[equal]):
        return predicted
    others = [value for value in range(5) if value != predicted]
    for k in range(3):
        if not decoder.flag(nexts[predicted][k]):
            return others[k]
    return others[3]
