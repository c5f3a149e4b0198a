"""Decodes a stream: python3 -m second_decoder FILE.fbs OUT.y4m

Writes each picture once, and the errors of the stream to standard error.
"""

import sys

from .decoder import Decoder


def y4m_header(setup):
    rate = setup.frame_rate
    return f"YUV4MPEG2 W{setup.width} H{setup.height} F{rate.numerator}:{rate.denominator} Ip C420jpeg\n".encode()


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    with open(sys.argv[1], "rb") as file:
        data = file.read()
    decoder = Decoder()
    with open(sys.argv[2], "wb") as out:
        for i, (picture, _) in enumerate(decoder.pictures(data)):
            if i == 0:
                out.write(y4m_header(decoder.setup))
            out.write(b"FRAME\n" + b"".join(plane.tobytes() for plane in picture))
    for error in decoder.errors:
        print(error, file=sys.stderr)
    sys.exit(1 if decoder.errors else 0)


main()
