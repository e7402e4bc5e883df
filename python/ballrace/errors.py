"""What ballrace refuses or fails at."""

from __future__ import annotations

__all__ = [
    "BallraceError",
    "CampaignError",
    "CampaignWarning",
    "EquilibriumError",
    "IntegrationError",
    "SceneError",
]


class BallraceError(Exception):
    """Base of every error of this package."""


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
        return f"{self.path} = {self.value}: {self.allowed}"


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
    """

    def __init__(self, message: str, time: float, step: float, body: str) -> None:
        super().__init__(message, time, step, body)
        self.message = message
        self.time = time
        self.step = step
        self.body = body

    def __str__(self) -> str:
        return self.message


class CampaignError(BallraceError, RuntimeError):
    """A campaign could not go on; the message says why, what is safe and what to do."""


class CampaignWarning(UserWarning):
    """Something about a campaign that one should know, and that did not stop it."""
