"""``python -m fbs.corpus``."""

import sys

from fbs.corpus.command import main

if __name__ == "__main__":
    sys.exit(main())
