"""``python -m ballrace`` is the command ``ballrace``."""

import sys

from .cli import command

if __name__ == "__main__":
    sys.exit(command())
