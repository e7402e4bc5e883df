"""Errors and warnings of ballrace."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

from ._base.text import printable

__all__ = [
    "AccuracyWarning",
    "BallraceError",
    "BudgetError",
    "CampaignError",
    "CampaignWarning",
    "EquilibriumError",
    "FileError",
    "FileWarning",
    "IntegrationError",
    "InternalError",
    "MemoryLimitError",
    "SceneError",
    "SceneWarning",
]


class BallraceError(Exception):
    """Base of every error of this package.

    Messages show control characters in names from scenes and files as escapes, so that they do not affect a
    terminal.
    """

    def __str__(self) -> str:
        return printable(super().__str__())


class SceneError(BallraceError, ValueError):
    """A field of a scene, or an argument of a run, is not usable; nothing was computed or written.

    Attributes
    ----------
    path : str
        Dotted path of the field, such as ``rows[0].ball_diameter``, or the name of the argument.
    value : str
        The offending value as it was given.
    allowed : str
        What is allowed there.
    """

    def __init__(self, path: str, value: str, allowed: str) -> None:
        # All arguments go to the base class, so that the error survives pickling.
        super().__init__(path, value, allowed)
        self.path = path
        self.value = value
        self.allowed = allowed

    def __str__(self) -> str:
        return printable(f"{self.path} = {self.value}: {self.allowed}")


class FileError(BallraceError, ValueError):
    """A file is not what it should be: damaged, or written by something else.

    Attributes
    ----------
    path : str
        The file.
    reason : str
        What is wrong with it, and what to do if anything helps.
    """

    def __init__(self, path: str, reason: str) -> None:
        super().__init__(path, reason)
        self.path = path
        self.reason = reason

    def __str__(self) -> str:
        return printable(f"{self.path}: {self.reason}")


class InternalError(BallraceError, RuntimeError):
    """A fault of this package itself, not of what it was given; please report it with its traceback.

    Attributes
    ----------
    message : str
        What was being done.
    trace : str
        The traceback, also of another process.
    """

    def __init__(self, message: str, trace: str) -> None:
        super().__init__(message, trace)
        self.message = message
        self.trace = trace

    def __str__(self) -> str:
        return printable(f"{self.message}\n{self.trace}")


class EquilibriumError(BallraceError, RuntimeError):
    """The static solve found no stable equilibrium; the message says why and what to try."""


class IntegrationError(BallraceError, RuntimeError):
    """The integration could not go on.

    Attributes
    ----------
    time : float
        Time reached [s].
    step : float
        Step size of the last attempt [s].
    body : str
        The body with the largest error, as in the names of the states.
    contacts : tuple of str
        Elements that limit the step, the fastest first: contacts as ``row0.ball3.outer`` (ball and race), a cage
        as ``row0.cage``, a support as ``outer.support``. Empty if nothing acts there.
    """

    def __init__(
        self, message: str, time: float, step: float, body: str, contacts: Sequence[str] = ()
    ) -> None:
        super().__init__(message, time, step, body, tuple(contacts))
        self.message = message
        self.time = time
        self.step = step
        self.body = body
        self.contacts = tuple(contacts)

    def __str__(self) -> str:
        return printable(self.message)


class BudgetError(IntegrationError):
    """A run has cost more than its ``time_limit`` or ``max_steps`` allows, and was ended.

    Attributes
    ----------
    time : float
        Simulated time reached [s].
    budget : str
        The limit that was reached: ``time_limit`` or ``max_steps``.
    limit : float
        Its value, in seconds or steps.
    """

    def __init__(self, message: str, time: float, budget: str, limit: float) -> None:
        super().__init__(message, time, math.nan, "")
        self.args = (message, time, budget, limit)
        self.budget = budget
        self.limit = limit


class MemoryLimitError(BallraceError, MemoryError):
    """A run would need more memory than is available; nothing was computed.

    Available is the least of the machine's free memory and of what the limits of the process (``ulimit -v``)
    and of its control groups (containers, batch systems) leave.

    Attributes
    ----------
    needed, available : float
        Memory that would be needed, and that is available [bytes].
    """

    def __init__(self, message: str, needed: float, available: float) -> None:
        super().__init__(message)
        self.args = (message, needed, available)
        self.needed = needed
        self.available = available

    def __str__(self) -> str:
        return printable(str(self.args[0]))


class AccuracyWarning(UserWarning):
    """A run was completed, but its signals need a check; the message has the numbers and what to do.

    Given where the recorded accelerations of a ring differ by more than 5 % from the derivative of its
    velocities (``out.stats.acceleration_residual``), so that the steps do not resolve the contacts,
    where contacts rode over a shoulder or past the pole of ball and groove
    (``out.stats.truncated_contacts``), and where a run was asked for an ``accuracy`` that its pilot runs did
    not reach. ``out.warnings`` keeps the texts.
    Also given by a measuring chain whose logger clips more than 0.1 % of the samples, and where pulses of a
    tachometer were missing or double.
    ``warnings.simplefilter("error", ballrace.AccuracyWarning)`` makes it an error.
    """


class SceneWarning(UserWarning):
    """A scene ran, but it may not be what was meant; the message names the field and what is unusual about it.

    Given where a number is one that no bearing is likely to have, as in another unit, where a contact's largest
    Hertz pressure exceeds that of the static load rating, and where a probe records what cannot move.
    ``out.warnings`` keeps the texts; ``warnings.simplefilter("error", ballrace.SceneWarning)`` makes it an error.
    """


class FileWarning(UserWarning):
    """A file was read, but something it says was not followed; the message names it and what was taken instead.

    Given where the times of a record are too coarse, or too uneven, for the sampling rate that was given.
    ``warnings.simplefilter("error", ballrace.FileWarning)`` makes it an error.
    """


class CampaignError(BallraceError, RuntimeError):
    """A campaign could not go on; the message says why, what is safe and what to do."""


class CampaignWarning(UserWarning):
    """A campaign goes on, but something about it needs attention; the message says what."""


def record_of(error: BallraceError) -> dict[str, Any]:
    """Return an exception as the core records one; :func:`from_record` makes it again."""
    return {"class": type(error).__name__, "message": str(error), "arguments": list(error.args)}


def from_record(record: Mapping[str, Any]) -> BallraceError:
    """Return the exception that a record of the core describes: its ``class`` here, and its ``arguments``."""
    made = globals()[record["class"]](*record["arguments"])
    assert isinstance(made, BallraceError)
    return made
