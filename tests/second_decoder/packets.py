"""Packets, their checks, and the search for the next one after damage (SPEC 3)."""

from dataclasses import dataclass

from .byte_reader import ByteReader
from .errors import StreamError, invalid, too_large, truncated
from .limits import MAX_PAYLOAD

SIGNATURE = b"\x89fbs"
KNOWN_TYPES = range(1, 12)
SETUP, GEOMETRY, SURROUND, PATTERN, MOTION, END, BLEND, WIRE_FRAME, SOUND_SETUP, SOUND, UNIT = KNOWN_TYPES
SCENE_PACKETS = (GEOMETRY, SURROUND, PATTERN, MOTION, BLEND, WIRE_FRAME, UNIT)
MAX_SEARCHED_PAYLOAD = 2047  # bytes of a packet at which a reader goes on after damage


@dataclass
class Packet:
    type: int
    payload: bytes


@dataclass
class Damage:
    """In the place of a packet that cannot be read."""
    error: StreamError
    type = None  # not known


def _crc_table():
    table = []
    for byte in range(256):
        crc = byte << 8
        for _ in range(8):
            crc = (crc << 1 ^ 0x1021) & 0xFFFF if crc & 0x8000 else crc << 1
        table.append(crc)
    return table


_CRC = _crc_table()


def crc16(data, crc=0xFFFF):
    """CRC-16/CCITT-FALSE."""
    for byte in data:
        crc = (crc << 8 ^ _CRC[crc >> 8 ^ byte]) & 0xFFFF
    return crc


class Checks:
    """With what the checks of packets begin (SPEC 3.1)."""

    def __init__(self):
        self._check = 0xFFFF  # of the last packet of the head
        self._in_head = False

    def before(self, kind):
        return self._check if kind in SCENE_PACKETS else 0xFFFF

    def add(self, kind, check):
        """Goes on behind a packet."""
        if kind == SETUP or self._in_head and kind in SCENE_PACKETS:
            self._check = check
            self._in_head = kind != PATTERN


def _read_packet(data, position, checks, max_payload=MAX_PAYLOAD):
    """The packet at `position`, its check and where it ends."""
    reader = ByteReader(data, position)
    kind = reader.u8()
    length = reader.varint()
    if length > max_payload:
        raise too_large("a packet is too long")
    payload = reader.bytes(length)
    end = reader.position
    check = reader.u16()
    if check != crc16(data[position:end], checks.before(kind)):
        raise invalid("the check of a packet is wrong")
    return Packet(kind, payload), check, reader.position


def _next_start(data, position, checks):
    """Where, from `position` on, the packet of a known type begins that ends first (SPEC 3.2)."""
    best, best_end = len(data), len(data) + 1
    for start in range(position, len(data)):
        if start >= best_end:
            break
        if data[start] not in KNOWN_TYPES:
            continue
        try:
            _, _, end = _read_packet(data, start, checks, MAX_SEARCHED_PAYLOAD)
        except StreamError:
            continue
        if end < best_end:
            best, best_end = start, end
    return best


def packets(data):
    """Yields a Packet or a Damage for each part of a stream."""
    position = len(SIGNATURE)
    checks = Checks()
    if not data.startswith(SIGNATURE):
        is_cut = data and SIGNATURE.startswith(data)
        yield Damage(truncated("the signature is cut") if is_cut else StreamError("kNotFbs", "there is no signature"))
        position = _next_start(data, 0, checks)
    while position < len(data):
        try:
            packet, check, position = _read_packet(data, position, checks)
            checks.add(packet.type, check)
            yield packet
        except StreamError as error:
            yield Damage(error)
            position = _next_start(data, position + 1, checks)
