"""What the format asks of the OBUs of an AV1 frame (SPEC 4.4); dav1d decodes them (av1.py)."""

from .errors import invalid

SEQUENCE_HEADER, FRAME = 1, 6
KEY_FRAME = 0


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


def _is_key_frame(sequence_header, frame):
    reduced_still_picture_header = sequence_header[0] >> 3 & 1
    show_existing_frame_and_type = frame[0] >> 5
    return reduced_still_picture_header or show_existing_frame_and_type == KEY_FRAME


def check_frame(data, first):
    """Raises an error unless `data` is at most a sequence header, and then one frame OBU.

    first  the frame is the first of its scene, so it has a sequence header and is a key frame
    """
    obus = list(_obus(data))
    types = [kind for kind, _ in obus]
    if types not in ([FRAME], [SEQUENCE_HEADER, FRAME]):
        raise invalid("a pattern is not one frame OBU, after at most one sequence header")
    payloads = [payload for _, payload in obus]
    if not all(payloads):
        raise invalid("an OBU is empty")
    if first and (len(payloads) == 1 or not _is_key_frame(*payloads)):
        raise invalid("the first pattern is not a key frame with a sequence header")
