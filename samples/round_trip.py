"""round_trip.py WIDTH HEIGHT RATE: round_trip.cpp in Python, with the package fbs:

    ffmpeg -i talk.mkv -f rawvideo -pix_fmt yuv420p - | python round_trip.py 352 288 25 >out.yuv
"""

import sys

import fbs
import numpy as np


def pictures(file, width, height):
    """Planes Y, U, V of each picture of a file."""
    half = (height + 1) // 2, (width + 1) // 2
    luma, chroma = width * height, half[0] * half[1]
    while len(samples := file.read(luma + 2 * chroma)) == luma + 2 * chroma:
        y, u, v = np.split(np.frombuffer(samples, np.uint8), [luma, luma + chroma])
        yield y.reshape(height, width), u.reshape(half), v.reshape(half)


def main(width, height, rate):
    stream = bytearray()
    with fbs.Encoder(width, height, fps=rate) as encoder:
        for planes in pictures(sys.stdin.buffer, width, height):
            stream += b"".join(encoder.push(planes))
        stream += b"".join(encoder.finish())
    print(len(stream), "bytes", file=sys.stderr)
    for picture in fbs.Decoder(bytes(stream)):
        sys.stdout.buffer.write(picture.tobytes())


if __name__ == "__main__":
    main(*map(int, sys.argv[1:4]))
