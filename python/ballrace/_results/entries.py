"""Results of a run besides its signals: statistics and provenance by name, and how contacts met its defects."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any, Literal

from ..scene import Surface


class Record(Mapping[str, Any]):
    """A read-only mapping whose entries are attributes too: ``stats.nfev`` is ``stats["nfev"]``."""

    def __init__(self, entries: Mapping[str, Any]) -> None:
        self.__dict__["_entries"] = {
            name: Record(value) if isinstance(value, Mapping) else value
            for name, value in entries.items()
        }

    def __getitem__(self, name: str) -> Any:
        return self._entries[name]

    def __getattr__(self, name: str) -> Any:
        try:
            return self.__dict__["_entries"][name]
        except KeyError:
            known = ", ".join(self.__dict__.get("_entries", ()))
            raise AttributeError(f"no entry {name!r}; there are: {known}") from None

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError("a record cannot be changed")

    def __iter__(self) -> Iterator[str]:
        return iter(self._entries)

    def __len__(self) -> int:
        return len(self._entries)

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._entries]

    def __repr__(self) -> str:
        return f"Record({', '.join(f'{name}={value!r}' for name, value in self.items())})"

    def to_dict(self) -> dict[str, Any]:
        """Return the entries as plain dicts."""
        return {k: v.to_dict() if isinstance(v, Record) else v for k, v in self.items()}


@dataclass(frozen=True, kw_only=True)
class Touched:
    """How contacts met a defect in a run.

    Attributes
    ----------
    name : str
        Name of the defect.
    on : {"outer_race", "inner_race", "ball"}
        Which surface.
    axial_offset : float
        Axial place of its middle, from the row's plane (races) or the ball's centre [m].
    placed : {"given", "contact", "nominal"}
        Where that number comes from: the scene, the contacts at equilibrium, or the nominal contact angle since
        there is no equilibrium or no load.
    passes : int
        How often a contact of the race, or one of the two contacts of the ball that carries the defect, passed
        over its arc.
    touched : int
        Number of these passes in which a contact was loaded within its length.
    largest_load : float
        Largest normal force of a contact within its length, to about a percent [N].
    contact_offset : float or None
        Axial place of the most loaded contact that passed, measured as `axial_offset` [m]; None without load.
    contact_width : float or None
        Width of that contact along rolling, 2b of Hertz's ellipse [m]; None without load, and in files of
        version 0.2.
    """

    name: str
    on: Surface
    axial_offset: float
    placed: Literal["given", "contact", "nominal"]
    passes: int
    touched: int
    largest_load: float
    contact_offset: float | None
    contact_width: float | None = None

    @property
    def share(self) -> float | None:
        """Share of the passes that touched it, 0 to 1; None without a pass."""
        return self.touched / self.passes if self.passes else None
