"""Bytes, 16-bit numbers and varints (SPEC 2.1)."""

from .errors import invalid, truncated


class ByteReader:
    """Reads from `data`; `position` is the number of bytes that have been read."""

    def __init__(self, data, position=0):
        self.data = data
        self.position = position

    def at_end(self):
        return self.position == len(self.data)

    def bytes(self, count):
        if count > len(self.data) - self.position:
            raise truncated("the bytes end inside a field")
        self.position += count
        return self.data[self.position - count:self.position]

    def rest(self):
        return self.bytes(len(self.data) - self.position)

    def u8(self):
        return self.bytes(1)[0]

    def u16(self):
        return int.from_bytes(self.bytes(2), "big")

    def varint(self):
        """A number of at most 64 bits, in its shortest form."""
        value = shift = 0
        while True:
            byte = self.u8()
            value |= (byte & 127) << shift
            if value >= 2**64:
                raise invalid("a varint of more than 64 bits")
            if byte < 128:
                if byte == 0 and shift > 0:
                    raise invalid("a varint that is longer than necessary")
                return value
            shift += 7
            if shift > 63:
                raise invalid("a varint of more than ten bytes")
