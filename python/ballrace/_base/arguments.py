"""Arguments of any function: keywords that it does not have, and text that no file can hold, are refused."""

from __future__ import annotations

import difflib
import functools
import inspect
from collections.abc import Callable, Mapping
from typing import ParamSpec, TypeVar

from ..errors import SceneError

P = ParamSpec("P")
T = TypeVar("T")


def whole_text(name: str, text: str) -> str:
    """Return text that is whole.

    Raises
    ------
    SceneError
        It has half of a character, a lone surrogate, which neither files nor the crate can hold.
    """
    try:
        text.encode()
    except UnicodeEncodeError:
        value = ascii(text) if len(text) < 80 else f"{len(text)} characters"
        raise SceneError(name, value, "text of whole characters, no lone surrogate") from None
    return text


def knows(meant: Mapping[str, str]) -> Callable[[Callable[P, T]], Callable[P, T]]:
    """Let a function refuse an unknown keyword by an error of this package, with what was meant by it.

    Parameters
    ----------
    meant : mapping of str to str
        What to write instead of an argument that users may expect; for others similar ones are suggested.
    """

    def decorated(function: Callable[P, T]) -> Callable[P, T]:
        known = list(inspect.signature(function).parameters)

        @functools.wraps(function)
        def called(*args: P.args, **kwargs: P.kwargs) -> T:
            for name, value in kwargs.items():
                if name not in known:
                    near = difflib.get_close_matches(name, known, n=3) or known
                    instead = meant.get(name, f"no argument; write {', '.join(near)}")
                    raise SceneError(name, repr(value), instead)
            return function(*args, **kwargs)

        return called

    return decorated
