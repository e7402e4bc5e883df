"""What others write and read: names with arguments and members, options of commands, columns with units.

python tests/python/interface.py > tests/documents/interface.json
"""

from __future__ import annotations

import argparse
import dataclasses
import inspect
import json
import warnings

import ballrace as br
from ballrace.cli import _parser


def interface() -> dict[str, list[str]]:
    """Return by each name what stands behind it."""
    return dict(sorted({**names(), **commands(), **columns()}.items()))


def names() -> dict[str, list[str]]:
    """Public names of Python: arguments of functions, members of classes; those that warn too."""
    modules = [br, *filter(inspect.ismodule, (getattr(br, name) for name in br.__all__))]
    found = {
        f"{module.__name__}.{name}": _behind(getattr(module, name))
        for module in modules
        for name in module.__all__
    }
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)
        return found | {f"ballrace.{name}": _behind(getattr(br, name)) for name in br._MOVED}


def _behind(value: object) -> list[str]:
    if isinstance(value, type):
        others = [base for base in value.__mro__ if base.__module__.startswith("sklearn.")]
        inherited = {name for base in (*Exception.__mro__, dict, *others) for name in vars(base)}
        fields = dataclasses.fields(value) if dataclasses.is_dataclass(value) else ()
        members = {*dir(value), *(field.name for field in fields)}
        if issubclass(value, Exception) and inspect.isfunction(value.__init__):
            # Attributes of errors have the names of what they are made of.
            members |= set(inspect.signature(value.__init__).parameters) - {"self"}
        return sorted(name for name in members - inherited if not name.startswith("_"))
    return list(inspect.signature(value).parameters) if inspect.isfunction(value) else []


def commands() -> dict[str, list[str]]:
    """Commands with their options."""
    (each,) = (a for a in _parser()._actions if isinstance(a, argparse._SubParsersAction))
    return {
        f"command {name}": [option for a in parser._actions for option in a.option_strings]
        for name, parser in each.choices.items()
    }


def columns() -> dict[str, list[str]]:
    """Columns of signals with their units, and features of one."""
    probes = {
        "ring": br.scene.MotionProbe(body="outer"),
        "contacts": br.scene.ContactsProbe(balls=(0,)),
        "cage": br.scene.CageProbe(),
        "energy": br.scene.EnergyProbe(),
        "torque": br.scene.TorqueProbe(),
        "forces": br.scene.ForcesProbe(body="row0.ball3"),
        "oil": br.scene.LubricationProbe(),
    }
    scene = br.presets.wheel_bearing(3000.0, lubricant="vg68", temperature_c=40.0)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", br.SceneWarning)  # no ball comes to the spall
        out = br.simulate(scene.replace({"probes": probes}), duration=1e-3, start="rolling")
    found = {f"column {name}": [unit] for name, unit in out.units.items()}
    return found | {
        f"feature {name}": [] for name in br.features(out["ring.ay"], out.fs, scene=scene)
    }


if __name__ == "__main__":
    lines = (f"{json.dumps(name)}: {json.dumps(behind)}" for name, behind in interface().items())
    print("{", ",\n".join(lines), "}", sep="\n")
