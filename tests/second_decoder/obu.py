"""What the format asks of the OBUs of an AV1 frame (SPEC 4.4); dav1d decodes them (av1.py)."""

from .errors import invalid

SEQUENCE_HEADER, FRAME = 1, 6
KEY_FRAME = 0


class _Bits:
    """Bits of an OBU, the high ones first."""

    def __init__(self, data):
        self._data = data
        self._position = 0

    def read(self, count):
        value = 0
        for _ in range(count):
            if self._position >= 8 * len(self._data):
                raise invalid("an OBU ends early")
            value = value << 1 | self._data[self._position >> 3] >> (7 - self._position % 8) & 1
            self._position += 1
        return value

    def uvlc(self):
        zeros = 0
        while not self.read(1):
            zeros += 1
        return (1 << zeros) - 1 + self.read(zeros) if zeros < 32 else 2**32 - 1


def _leb128(data, position):
    """A number of at most eight bytes, and the position after it."""
    value = 0
    for i in range(8):
        if position + i >= len(data):
            raise invalid("an OBU ends early")
        byte = data[position + i]
        value |= (byte & 127) << (7 * i)
        if byte < 128:
            return value, position + i + 1
    raise invalid("the size of an OBU is too long")


def _obus(data):
    """Yields type and payload of each OBU."""
    position = 0
    while position < len(data):
        header = data[position]
        if header & 0x80:
            raise invalid("the forbidden bit of an OBU is set")
        if header & 4:
            raise invalid("an OBU has an extension")
        position += 1
        size = len(data) - position
        if header & 2:
            size, position = _leb128(data, position)
        if size > len(data) - position:
            raise invalid("an OBU ends early")
        yield header >> 3 & 15, data[position:position + size]
        position += size


def _check_sequence_header(payload):
    """Main profile and no layers; dav1d tells the rest."""
    bits = _Bits(payload)
    if bits.read(3) != 0:
        raise invalid("AV1 of another profile than Main")
    bits.read(1)  # still_picture
    if bits.read(1):  # reduced_still_picture_header: it has one operating point without layers
        return
    if bits.read(1):  # timing_info_present_flag
        bits.read(64)
        if bits.read(1):  # equal_picture_interval
            bits.uvlc()
        if bits.read(1):  # decoder_model_info_present_flag
            bits.read(47)
    bits.read(1)  # initial_display_delay_present_flag
    operating_points, layers = bits.read(5) + 1, bits.read(12)
    if operating_points > 1 or layers:
        raise invalid("AV1 with layers")


def check_frame(data, first):
    """Raises an error unless `data` is at most a sequence header, and then one frame OBU.

    first  the frame is the first of its scene, so it has a sequence header and is a key frame
    """
    obus = list(_obus(data))
    types = [kind for kind, _ in obus]
    if types not in ([FRAME], [SEQUENCE_HEADER, FRAME]):
        raise invalid("a pattern is not one frame OBU, after at most one sequence header")
    has_sequence_header = len(obus) == 2
    if has_sequence_header:
        _check_sequence_header(obus[0][1])
    if first:
        if not has_sequence_header:
            raise invalid("the first pattern has no sequence header")
        reduced_still_picture_header = _Bits(obus[0][1]).read(5) & 1
        show_existing_and_type = _Bits(obus[1][1]).read(3)
        if not reduced_still_picture_header and show_existing_and_type != KEY_FRAME:
            raise invalid("the first pattern is not a key frame")
