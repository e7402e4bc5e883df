"""How long a target is fuzzed, and what becomes of an example: success, a warning, or one typed error.

``BALLRACE_FUZZ_SECONDS`` says for how long each target runs, by default 2 s; ``BALLRACE_FUZZ_SEED`` where its
seeds begin, by default 0. The same seed gives the same examples, of which a faster machine looks at more.
"""

from __future__ import annotations

import collections
import contextlib
import dataclasses
import faulthandler
import itertools
import os
import tempfile
import time
import warnings
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any, TypeVar

import hypothesis
from hypothesis import HealthCheck, Phase, given
from hypothesis.strategies import SearchStrategy

import ballrace as br
from ballrace.options import ARGUMENTS
from ballrace.scene import Scene

SECONDS = float(os.environ.get("BALLRACE_FUZZ_SECONDS", "2"))
SEED = int(os.environ.get("BALLRACE_FUZZ_SEED", "0"))

HANG = 120.0
"""An example that takes longer than this hangs [s]: the process ends, and :func:`last` has the example."""

A_ROUND = 40
"""Examples of one seed."""

_QUIET = (br.AccuracyWarning, br.SceneWarning, br.CampaignWarning, br.FileWarning)

T = TypeVar("T")


def fuzzed(
    **strategies: SearchStrategy[Any],
) -> Callable[[Callable[..., object]], Callable[[], None]]:
    """Make a test of a check: it looks at examples until the time is up, and shrinks the first that fails.

    What a check returns is counted, and printed where pytest shows what tests print (``-rP``).
    """

    def decorate(check: Callable[..., object]) -> Callable[[], None]:
        def test() -> None:
            until = time.monotonic() + SECONDS
            outcomes: collections.Counter[str] = collections.Counter()
            failed = False

            def looked_at(**example: Any) -> None:
                nonlocal failed
                # Once one has failed, all count: an example that fails only in time would be called flaky.
                if not failed and time.monotonic() >= until:
                    return
                try:
                    with watched(check.__name__, example):
                        outcomes[str(check(**example))] += 1
                except BaseException:
                    failed = True
                    raise

            for number in itertools.count(SEED):
                _round(looked_at, strategies, number)()
                if time.monotonic() >= until:
                    break
            print(f"{check.__name__}: {outcomes.total()} examples: {dict(outcomes.most_common())}")

        test.__name__ = check.__name__
        test.__doc__ = check.__doc__
        test.__module__ = check.__module__
        return test

    return decorate


def _round(
    check: Callable[..., None], strategies: Mapping[str, SearchStrategy[Any]], number: int
) -> Callable[[], None]:
    settings = hypothesis.settings(
        max_examples=A_ROUND,
        deadline=None,
        database=None,
        suppress_health_check=list(HealthCheck),
        phases=(Phase.generate, Phase.target, Phase.shrink),
    )
    return hypothesis.seed(number)(settings(given(**strategies)(check)))


def last(name: str) -> Path:
    """Return the file with the example that a target looks at now, and with the stack of one that hangs."""
    folder = Path(tempfile.gettempdir()) / "ballrace-fuzz"
    folder.mkdir(exist_ok=True)
    return folder / f"{name}.{os.getpid()}.txt"


@contextlib.contextmanager
def watched(name: str, example: Mapping[str, Any]) -> Iterator[None]:
    """Keep an example in a file while it is looked at, and end the process if it hangs."""
    with last(name).open("w", encoding="utf-8") as file:
        print(example, file=file, flush=True)
        faulthandler.dump_traceback_later(HANG, exit=True, file=file)
        try:
            yield
        finally:
            faulthandler.cancel_dump_traceback_later()
    last(name).unlink()


def decided(call: Callable[[], T]) -> T | br.BallraceError:
    """Return what a call returns, or the one typed error that it ends in; anything else fails the test."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for category in _QUIET:
            warnings.simplefilter("ignore", category)
        try:
            return call()
        except br.BallraceError as error:
            _check_message(error)
            return error
        except BaseException as error:
            # Panics of the core are no Exception, and the shrinker does not know them.
            if type(error).__name__ == "PanicException":
                raise AssertionError(f"a panic crossed the border: {error}") from None
            raise


def _check_message(error: br.BallraceError) -> None:
    """Check that an error says something, and where."""
    assert str(error).strip(), type(error)
    if isinstance(error, br.SceneError):
        assert error.path, f"no field: {error!r}"
        assert error.allowed, f"nothing is allowed: {error!r}"


_NAMED = {*(field.name for field in dataclasses.fields(Scene)), *ARGUMENTS, "scene"}


def of_a_scene(outcome: object) -> None:
    """Check that what is refused of a scene is a field of it, or an argument of its run."""
    if isinstance(outcome, br.SceneError):
        assert outcome.path.split(".")[0].split("[")[0] in _NAMED, f"no field: {outcome!r}"
