"""Decodes a stream: python3 -m second_decoder FILE.fbs OUT.y4m

Writes each picture once, and each error of the stream to standard error.
"""

import sys

from .decoder import Decoder


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    with open(sys.argv[1], "rb") as file:
        data = file.read()
    decoder = Decoder()
    with open(sys.argv[2], "wb") as out:
        for i, (picture, _) in enumerate(decoder.pictures(data)):
            if i == 0:
                height, width = picture[0].shape
                out.write(b"YUV4MPEG2 W%d H%d F30:1 Ip C420jpeg\n" % (width, height))
            out.write(b"FRAME\n" + b"".join(plane.tobytes() for plane in picture))
    for error in decoder.errors:
        print(error, file=sys.stderr)
    sys.exit(2 if decoder.errors else 0)


main()
