"""Compares the second decoder with tests/vectors/vectors.txt: python3 -m second_decoder.vectors_test [FILE.fbs ...]

Exit code: 0 if all agree, 1 if one does not, 77 if numpy or libdav1d is not there.
"""

import hashlib
import pathlib
import sys
import time

try:
    from .decoder import Decoder
except (ImportError, OSError) as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

VECTORS = pathlib.Path(__file__).parents[1] / "vectors"


def decode(data):
    """First error or "-", number of pictures, MD5 over the planes of all pictures."""
    decoder = Decoder()
    md5 = hashlib.md5()
    count = 0
    for picture, _ in decoder.pictures(data):
        count += 1
        for plane in picture:
            md5.update(plane.tobytes())
    error = decoder.errors[0].code if decoder.errors else "-"
    return error, str(count), md5.hexdigest()


def main():
    failures = 0
    for line in (VECTORS / "vectors.txt").read_text().splitlines():
        if line.startswith("#") or sys.argv[1:] and line.split()[0] not in sys.argv[1:]:
            continue
        name, *expected = line.split()
        began = time.monotonic()
        result = list(decode((VECTORS / name).read_bytes()))
        failures += result != expected
        print(f"{name}: {'same' if result == expected else 'DIFFERS'}, {time.monotonic() - began:.1f} s", flush=True)
        if result != expected:
            print(f"  expected {' '.join(expected)}\n  got      {' '.join(result)}")
    sys.exit(1 if failures else 0)


main()
