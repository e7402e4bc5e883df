"""The licences of the crates that are compiled into the extension, as text.

python tests/python/notices.py > THIRD-PARTY-NOTICES.txt
"""

from __future__ import annotations

import json
import subprocess
import sys
from collections import defaultdict
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[2]
HEAD = """\
The extension module ballrace._core contains the Rust standard library (MIT OR Apache-2.0, the Rust project
developers, https://github.com/rust-lang/rust) and these crates, each under the licence that stands below it; of
several, the MIT licence is the one that is used. Made by `python tests/python/notices.py`.
"""
RULE = "-" * 100


def notices() -> str:
    """Every licence once, below the crates that it holds for."""
    by_text = defaultdict(list)
    for crate in compiled_in():
        by_text[licence(crate)].append(f"{crate['name']} {crate['version']} ({crate['license']})")
    parts = [f"{RULE}\n" + "\n".join(names) + f"\n\n{text}" for text, names in by_text.items()]
    return "\n".join([HEAD, *parts])


def compiled_in() -> list[dict[str, Any]]:
    """What cargo lists of the crates of other people that end up in the extension, on any platform."""
    tree = ("tree", "--package=ballrace-python", "--edges=normal,no-proc-macro", "--target=all")
    lines = cargo(*tree, "--prefix=none", "--no-dedupe", "--format={p}").splitlines()
    wanted = {tuple(line.split()[:2]) for line in lines if line}
    packages = json.loads(cargo("metadata", "--format-version=1"))["packages"]
    found = [crate for crate in packages if (crate["name"], f"v{crate['version']}") in wanted]
    return sorted((crate for crate in found if crate["source"]), key=lambda crate: crate["name"])


def cargo(*command: str) -> str:
    """What cargo prints, of the versions of Cargo.lock."""
    return subprocess.run(
        ["cargo", *command, "--locked", "--offline"],
        check=True, cwd=ROOT, capture_output=True, text=True,
    ).stdout  # fmt: skip


def licence(crate: dict[str, Any]) -> str:
    """The text that a crate brings along: the MIT licence where there is a choice."""
    folder = Path(crate["manifest_path"]).parent
    files = sorted(file for file in folder.glob("LICENSE*") if file.is_file())
    chosen = [file for file in files if "MIT" in file.name] or files
    texts = [file.read_text(encoding="utf-8").strip() + "\n" for file in chosen]
    return "\n".join(texts) or f"No text of its own; by {', '.join(crate['authors'])}.\n"


if __name__ == "__main__":
    sys.stdout.write(notices())
