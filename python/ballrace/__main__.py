"""``python -m ballrace`` is the command ``ballrace``."""

import sys

from .cli import main

if __name__ == "__main__":
    sys.exit(main())
