"""Packets, their checks, and the search for the next usable one after damage (SPEC 3)."""

from dataclasses import dataclass

from .byte_reader import ByteReader
from .errors import StreamError, invalid, too_large, truncated
from .limits import MAX_PAYLOAD

SIGNATURE = b"\x89fbs"
SETUP, GEOMETRY, SURROUND, PATTERN, MOTION, END, BLEND, WIRE_FRAME = range(1, 9)
MAX_RESUME_PAYLOAD = 127  # bytes of a setup or end packet at which a reader goes on after damage


@dataclass
class Packet:
    type: int
    payload: bytes


@dataclass
class Damage:
    """In the place of a packet that cannot be read."""
    error: StreamError


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


def _read_packet(data, position, previous_check):
    """The packet at `position`, its check and where it ends."""
    reader = ByteReader(data, position)
    kind = reader.u8()
    length = reader.varint()
    if length > MAX_PAYLOAD:
        raise too_large("a packet is too long")
    payload = reader.bytes(length)
    initial = 0xFFFF if kind in (SETUP, END) else previous_check
    check = crc16(data[position:reader.position], initial)
    if reader.u16() != check:
        raise invalid("the check of a packet is wrong")
    return Packet(kind, payload), check, reader.position


def _next_start(data, position):
    """The first place from `position` on where a short setup or end packet with a right check begins."""
    for start in range(position, len(data)):
        if data[start] not in (SETUP, END):
            continue
        try:
            packet, _, _ = _read_packet(data, start, 0xFFFF)
        except StreamError:
            continue
        if len(packet.payload) <= MAX_RESUME_PAYLOAD:
            return start
    return len(data)


def packets(data):
    """Yields a Packet or a Damage for each part of a stream."""
    position = len(SIGNATURE)
    if not data.startswith(SIGNATURE):
        is_cut = data and SIGNATURE.startswith(data)
        yield Damage(truncated("the signature is cut") if is_cut else StreamError("kNotFbs", "there is no signature"))
        position = _next_start(data, 0)
    check = 0xFFFF
    while position < len(data):
        try:
            packet, check, end = _read_packet(data, position, check)
            yield packet
            position = end
        except StreamError as error:
            yield Damage(error)
            position = _next_start(data, position + 1)
