"""The command ``ballrace``."""

from __future__ import annotations

import argparse
import contextlib
import os
import signal
import sys
from collections.abc import Sequence

from .._base.libraries import MissingLibraryError
from .._base.text import printable
from ..errors import BallraceError, FileError, SceneError
from . import about, campaigns, diagnosing, exploring, fmu, running, signals, statics, studies

__all__ = ["command", "main"]


def command() -> int:
    """Run the command as a process of its own, and return its status, whenever Ctrl-C comes again."""
    status = 130
    try:
        status = main()
        _leave_in_peace()
    except KeyboardInterrupt:
        # While the first one was reported.
        _leave_in_peace()
    return status


def _leave_in_peace() -> None:
    """Have Ctrl-C no longer end the process, which ends now: its status would be lost."""
    with contextlib.suppress(ValueError):  # on another thread there is no Ctrl-C
        signal.signal(signal.SIGINT, signal.SIG_IGN)


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command and return its exit status.

    0 is success, 1 a run that failed, 2 bad input (nothing was written), 130 Ctrl-C.
    """
    options = _parser().parse_args(arguments)
    try:
        options.command(options)
        sys.stdout.flush()
    except KeyboardInterrupt as error:
        return _fail(str(error) or "interrupted", 130)
    except BrokenPipeError:
        # The reader of our output has gone: nothing more to say, also not while Python shuts down.
        with contextlib.suppress(OSError, ValueError):
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 1
    except (SceneError, FileError) as error:
        return _fail(str(error), 2)
    except (BallraceError, MissingLibraryError) as error:
        return _fail(str(error), 1)
    except OSError as error:
        place = f"{error.filename}: " if error.filename else ""
        return _fail(f"{place}{error.strerror or error}", 2)
    return 0


def _fail(message: str, status: int) -> int:
    print(f"ballrace: {' '.join(printable(message).split())}", file=sys.stderr)
    return status


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="ballrace", description="Ball bearings simulated in three dimensions."
    )
    parser.add_argument("--version", action="version", version=f"ballrace {about.version()}")
    commands = parser.add_subparsers(required=True, metavar="COMMAND")
    for module in (
        studies, exploring, running, statics, signals, diagnosing, fmu, about, campaigns,
    ):  # fmt: skip
        module.add_commands(commands)
    return parser
