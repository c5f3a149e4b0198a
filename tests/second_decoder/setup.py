"""Setup packet, and the return packet, which has a position, too (SPEC 4.1, 4.13)."""

from dataclasses import dataclass
from fractions import Fraction

from .byte_reader import ByteReader
from .errors import invalid, too_large, unsupported
from .integers import clamp
from .limits import (MAX_CHECK, MAX_DURATION, MAX_PATTERNS, MAX_PICTURE_NUMBER, MAX_PICTURE_SIZE,
                     MAX_PICTURES_PER_SECOND, MAX_STEP, MAX_STREAM_PICTURES, MAX_STREAM_TIME, MIN_PICTURE_SIZE)

VERSIONS = (8, 9)
GENERIC_HEAD = 3
PARTS_AFTER_POSE = 9
MAX_CONTRAST = 128
KEEP_NONE, KEEP_ASIDE, KEEP_AND_PRESENT = range(3)  # scenes before this one


@dataclass
class Setup:
    pictures_before: int
    time_before: int  # 1/90000 s
    width: int  # luma samples
    height: int
    frame_rate: Fraction  # pictures per second
    pixel_aspect: tuple  # numerator, denominator
    full_range: bool
    matrix: int
    steps: dict  # of the state's numbers, by kind
    parts: int  # bit i: part i + 1 is sent
    upper_lip: bytes  # mouth colours Y, U, V
    lower_lip: bytes
    patterns: int  # slots of the store
    contrast: int
    chroma_contrast: int
    keeps: int

    def nominal_duration(self):
        """Duration of a picture in 1/90000 s unless the stream says another (SPEC 5.5)."""
        num, den = self.frame_rate.numerator, self.frame_rate.denominator
        return clamp((90000 * den + num // 2) // num, 1, MAX_DURATION)


def _varint_in(reader, low, high, error=invalid):
    """A varint in low..high; `error` if it is larger."""
    value = reader.varint()
    if value < low:
        raise invalid("a field is too small")
    if value > high:
        raise error("a field is too large")
    return value


def _read_position(reader):
    pictures = _varint_in(reader, 0, MAX_STREAM_PICTURES, too_large)
    time = _varint_in(reader, 0, MAX_STREAM_TIME, too_large)
    if not pictures <= time <= pictures * MAX_DURATION:
        raise invalid("the time before the scene contradicts the number of pictures")
    return pictures, time


def _read_frame_rate(reader):
    rate = Fraction(_varint_in(reader, 1, 2**32 - 1), _varint_in(reader, 1, 2**32 - 1))
    if rate > MAX_PICTURES_PER_SECOND:
        raise invalid("too many pictures per second")
    return rate


def _read_colour(reader):
    colour = reader.u8()
    if colour >> 1 > 2:
        raise invalid("unknown colour matrix")
    return bool(colour & 1), colour >> 1


def _read_u8_up_to(reader, high):
    """A byte in 0..high; 0 if the payload ends here."""
    value = 0 if reader.at_end() else reader.u8()
    if value > high:
        raise invalid("a field is too large")
    return value


def read_setup(payload):
    reader = ByteReader(payload)
    version = reader.varint()
    if version not in VERSIONS:
        raise invalid("version 0") if version == 0 else unsupported("another version of the format")
    if reader.u8() != GENERIC_HEAD:
        raise unsupported("another generic head")
    pictures_before, time_before = _read_position(reader)
    width, height = (_varint_in(reader, MIN_PICTURE_SIZE, MAX_PICTURE_SIZE, too_large) for _ in range(2))
    frame_rate = _read_frame_rate(reader)
    pixel_aspect = (_varint_in(reader, 0, 2**32 - 1), _varint_in(reader, 1, 2**32 - 1))
    full_range, matrix = _read_colour(reader)
    steps = {name: _varint_in(reader, 1, MAX_STEP)
             for name in ("rotation", "translation", "log scale", "light", "control")}
    parts = _varint_in(reader, 0, 2**PARTS_AFTER_POSE - 1)
    upper_lip, lower_lip = reader.bytes(3), reader.bytes(3)
    patterns = 1 if reader.at_end() else _varint_in(reader, 1, MAX_PATTERNS, too_large)
    contrast = _read_u8_up_to(reader, MAX_CONTRAST)
    chroma_contrast = _read_u8_up_to(reader, MAX_CONTRAST)
    keeps = KEEP_NONE if version == 8 else _read_u8_up_to(reader, KEEP_AND_PRESENT)
    return Setup(pictures_before, time_before, width, height, frame_rate, pixel_aspect, full_range, matrix, steps,
                 parts, upper_lip, lower_lip, patterns, contrast, chroma_contrast, keeps)


def read_return(payload):
    """The check of the scene to return to, pictures and time before, pictures of the scene before, and whether the
    present scene is set aside."""
    reader = ByteReader(payload)
    scene = _varint_in(reader, 0, MAX_CHECK)
    position = _read_position(reader)
    passed = _varint_in(reader, 0, MAX_PICTURE_NUMBER, too_large)
    aside = reader.u8()
    if aside > 1:
        raise invalid("a field is too large")
    return scene, position, passed, aside == 1
