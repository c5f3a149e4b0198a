"""A second decoder of the fbs format, written from bitstream/SPEC.md alone; see README.md."""
