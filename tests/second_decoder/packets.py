"""Packets, their checks, and the search for the next one after damage (SPEC 3)."""

from dataclasses import dataclass

from .byte_reader import ByteReader
from .errors import StreamError, invalid, too_large, truncated
from .limits import MAX_PAYLOAD

SIGNATURE = b"\x89fbs"
KNOWN_TYPES = range(1, 14)
(SETUP, GEOMETRY, SURROUND, PATTERN, MOTION, END, BLEND, WIRE_FRAME, SOUND_SETUP, SOUND, UNIT,
 HEAD_PART, RETURN) = KNOWN_TYPES
SCENE_PACKETS = (GEOMETRY, SURROUND, PATTERN, MOTION, BLEND, WIRE_FRAME, UNIT)
MAX_SEARCHED_PAYLOAD = 2047  # bytes of a packet at which a reader goes on after damage
MAX_REPAIRED_PAYLOAD = 65535  # bytes of a packet in which a wrong bit is set right


@dataclass
class Packet:
    type: int
    payload: bytes
    check: int
    in_parts: bool = False  # it has come in the parts of a head


@dataclass
class Damage:
    """In the place of a packet that cannot be read."""
    error: StreamError
    type = None  # not known
    in_parts = False


class Crc:
    """A check of `bits` bits."""

    def __init__(self, bits, polynomial):
        self.bits, self._mask, self._polynomial = bits, (1 << bits) - 1, polynomial
        self._table = []
        for value in range(256):
            value <<= bits - 8
            for _ in range(8):
                value = self._shift(value)
            self._table.append(value)

    def _shift(self, value):
        value <<= 1
        return (value ^ self._polynomial) & self._mask if value >> self.bits else value

    def of(self, data, value):
        for byte in data:
            value = value << 8 & self._mask ^ self._table[value >> self.bits - 8 ^ byte]
        return value

    def wrong_bit(self, difference, count):
        """Of the last `count` bits of a packet, which to invert: counted from its end, or None."""
        value = 1
        for bit in range(count):
            if value == difference:
                return bit
            value = self._shift(value)
        return None


_SHORT, _LONG = Crc(16, 0x1021), Crc(24, 0x864CFB)


def crc_of(length):
    """What checks a packet with this many bytes of payload."""
    return _SHORT if length < 256 else _LONG


def _scene_of_return(payload):
    try:
        return ByteReader(payload).varint()
    except StreamError:
        return 0


class Checks:
    """With what the checks of packets begin (SPEC 3.1)."""

    def __init__(self):
        self._check = 0xFFFF  # of the last packet of the head, or what a return packet names
        self._in_head = False

    def of(self, data, crc):
        """The check of the next packet, without its own."""
        before = self._check if data[0] in SCENE_PACKETS else 0xFFFF
        return crc.of(data, before if crc.bits == 16 else before << 8 | 0xFF)

    def add(self, kind, payload, check):
        """Goes on behind a packet."""
        if kind == RETURN:
            self._check = _scene_of_return(payload) & 0xFFFF
            self._in_head = False
        elif kind == SETUP or self._in_head and kind in SCENE_PACKETS:
            self._check = check & 0xFFFF
            self._in_head = kind != PATTERN


def _read_packet(data, position, checks, max_payload=MAX_PAYLOAD):
    """The packet at `position`, its check, that xor what it has to be, and where it ends."""
    reader = ByteReader(data, position)
    kind = reader.u8()
    length = reader.varint()
    if length > max_payload:
        raise too_large("a packet is too long")
    payload = reader.bytes(length)
    crc = crc_of(length)
    computed = checks.of(data[position:reader.position], crc)
    check = int.from_bytes(reader.bytes(crc.bits // 8), "big")
    return Packet(kind, payload, check), check, check ^ computed, reader.position


def _repaired(data, length, difference, end):
    """`data` with one bit inverted of the packet that ends at `end`, so that its check is right (SPEC 3.2)."""
    if length > MAX_REPAIRED_PAYLOAD:
        return None
    crc = crc_of(length)
    bit = crc.wrong_bit(difference, 8 * length + crc.bits)
    if bit is None:
        return None
    out = bytearray(data)
    out[end - 1 - bit // 8] ^= 1 << bit % 8
    return bytes(out)


def _next_start(data, position, checks):
    """Where, from `position` on, the packet of a known type begins that ends first (SPEC 3.2)."""
    best, best_end = len(data), len(data) + 1
    for start in range(position, len(data)):
        if start >= best_end:
            break
        if data[start] not in KNOWN_TYPES:
            continue
        try:
            _, _, difference, end = _read_packet(data, start, checks, MAX_SEARCHED_PAYLOAD)
        except StreamError:
            continue
        if difference == 0 and end < best_end:
            best, best_end = start, end
    return best


def packets(data, checks=None):
    """Yields a Packet or a Damage for each part of a stream. Packets of a head that is sent to it are read next."""
    position = len(SIGNATURE)
    checks = checks or Checks()
    if not data.startswith(SIGNATURE):
        is_cut = data and SIGNATURE.startswith(data)
        yield Damage(truncated("the signature is cut") if is_cut else StreamError("kNotFbs", "there is no signature"))
        position = _next_start(data, 0, checks)
    while position < len(data):
        try:
            packet, check, difference, end = _read_packet(data, position, checks)
            if difference:
                repaired = _repaired(data, len(packet.payload), difference, end)
                if repaired is None:
                    raise invalid("the check of a packet is wrong")
                data = repaired
                continue
            position = end
            checks.add(packet.type, packet.payload, packet.check)
            head = yield packet
            if head:
                yield  # what send() returns
                for packet in packets(SIGNATURE + head, checks):
                    packet.in_parts = True
                    yield packet
        except StreamError as error:
            yield Damage(error)
            position = _next_start(data, position + 1, checks)
