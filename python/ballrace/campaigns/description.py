"""Description of a campaign, by which a folder is that of one campaign: sealed, in two copies.

``campaign.json`` and ``campaign.copy.json`` hold the scenes, the arguments of the runs and the options of the
features, with a hash of these. A flipped digit would otherwise give every case another scene.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ..errors import CampaignError
from .disk import hash_of, put, reading, refuse_link

FORMAT = 1

NAMES = ("campaign.json", "campaign.copy.json")

_PARTS = {"format", "schema", "scenes", "run", "features", "digest"}


def described(identity: Mapping[str, Any]) -> dict[str, Any]:
    """Return what a description says, as it will be read."""
    found: dict[str, Any] = json.loads(json.dumps({"format": FORMAT, **identity}))
    return found


def digest(description: Mapping[str, Any]) -> str:
    """Return the hash of a description."""
    return hash_of(json.dumps(description).encode())


def write(root: Path, name: str, description: Mapping[str, Any], *, new: bool = False) -> None:
    """Write one of its copies; with ``new`` only where there is none."""
    sealed = {**description, "digest": digest(description)}
    put(root, name, json.dumps(sealed, indent=1).encode(), new=new)


def read(path: Path) -> dict[str, Any]:
    """Read one of its copies; one without a hash, as older versions wrote it, is taken as it is.

    Raises
    ------
    FileNotFoundError
        It is not there.
    ValueError
        It is damaged.
    CampaignError
        It cannot be read, is a link, or of another format.
    """
    refuse_link(path)
    with reading(path):
        data = path.read_bytes()
    try:
        found = json.loads(data)
        written = found.pop("digest", None)
        form = found["format"]
    except (ValueError, TypeError, KeyError, AttributeError, RecursionError):
        raise ValueError("not the description of a campaign") from None
    if written is not None and written != digest(found):
        raise ValueError("its content is not what was written")
    if form != FORMAT:
        raise CampaignError(
            f"{path}: format {form}, this version of ballrace reads {FORMAT}; "
            "give another folder, or use the version that made this one"
        )
    if not found.keys() <= _PARTS:
        raise ValueError("not the description of a campaign")
    return dict(found)


def sound(root: Path) -> tuple[dict[str, Any] | None, dict[str, str]]:
    """Return the description of a folder if one of its copies is sound, and what is wrong with each that is not.

    Raises
    ------
    CampaignError
        A copy cannot be read, is a link, or of another format.
    """
    found, wrong = None, {}
    for name in NAMES:
        try:
            read_now = read(root / name)
            found = read_now if found is None else found
        except FileNotFoundError:
            wrong[name] = "missing"
        except ValueError as error:
            wrong[name] = f"damaged, {error}"
    return found, wrong
