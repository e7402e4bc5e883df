"""Several chains, by their names."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import fields, is_dataclass
from typing import Any

from .._base.libraries import pl
from ..errors import SceneError
from .chain import Chain

Chains = Chain | Mapping[str, Chain] | Sequence[Chain]
"""A chain, some by their names, or some that are numbered from 0."""

_ALLOWED = "at least one Chain of br.measuring, which without stages changes nothing; several by their names"


def named_chains(chains: Chains) -> dict[str, Chain]:
    """Return chains by their names.

    Raises
    ------
    SceneError
        There is none, or something else.
    """
    given = [chains] if isinstance(chains, Chain) else chains
    if not isinstance(given, Mapping | Sequence):
        raise SceneError("chains", repr(chains), _ALLOWED)
    pairs = given.items() if isinstance(given, Mapping) else enumerate(given)
    named = {str(name): chain for name, chain in pairs}
    if not named or not all(isinstance(chain, Chain) for chain in named.values()):
        raise SceneError("chains", repr(chains), _ALLOWED)
    return named


def table(chains: Chains) -> pl.DataFrame:
    """Return the numbers of measuring chains, a line each and a column for each field that has one somewhere.

    Examples
    --------
    >>> import ballrace as br
    >>> machines = {f"machine {k}": br.measuring.Chain(path=br.measuring.random_housing(k)) for k in range(3)}
    >>> found = br.measuring.table(machines)
    >>> found.height, found.columns[:3]
    (3, ['chain', 'path.modes[0].frequency', 'path.modes[0].damping'])
    """
    rows: list[dict[str, float | str]] = []
    for name, chain in named_chains(chains).items():
        rows.append({"chain": name, **dict(_entries(chain, ""))})
    return pl.DataFrame(rows, infer_schema_length=None)


def _entries(part: Any, path: str) -> Iterator[tuple[str, float | str]]:
    """Yield dotted paths and values of the fields that hold one number or word."""
    if is_dataclass(part):
        for entry in fields(part):
            yield from _entries(getattr(part, entry.name), f"{path}.{entry.name}".lstrip("."))
    elif isinstance(part, tuple):
        for i, value in enumerate(part):
            yield from _entries(value, f"{path}[{i}]")
    elif isinstance(part, int | float | str):
        yield path, part
