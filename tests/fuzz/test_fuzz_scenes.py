"""Any scene document ends in success, a warning that is right, or one typed error."""

from __future__ import annotations

import contextlib
import json
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any, get_args

import hypothesis.strategies as st
import numpy as np
import pytest

import ballrace as br
from ballrace.scene import Method, Scene
from budget import decided, fuzzed, of_a_scene
from strategies import BASES, EDGES, WRONG, damaged, scenes

CORPUS = Path(__file__).parent / "corpus" / "scenes"

MEMORY = 3 * 2**30
"""Address space that the process may take beyond what it has [bytes]: estimates that are too low abort here."""

UNDEFINED = (".angle", ".zone_centre", ".slip", ".film", ".lambda")
"""Ends of columns that are not a number where nothing is loaded, or nothing lubricated."""

RUNS = st.fixed_dictionaries(
    {"duration": st.sampled_from((1e-4, 3e-4, 1e-3)), "fs": st.sampled_from((2e4, 5e4, 2e5))},
    optional={
        "start": st.sampled_from(("rolling", "equilibrium")),
        "settle": st.sampled_from((0.0, 0.0, 1e-3, None)),
        "rtol": st.sampled_from((1e-3, 1e-5, 1e-9)),
        "method": st.sampled_from(get_args(Method)),
        "bandwidth": st.sampled_from(("auto", None)),
        "reduce": st.booleans(),
        "threads": st.integers(0, 2),
    },
)
SHORT: dict[str, Any] = {"max_steps": 2000, "time_limit": 10.0}


@pytest.fixture(scope="module", autouse=True)
def memory() -> Iterator[None]:
    """Leave the process little memory beyond what it has."""
    if sys.platform != "linux":
        yield
        return
    import resource

    used = int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()
    soft, hard = resource.getrlimit(resource.RLIMIT_AS)
    resource.setrlimit(resource.RLIMIT_AS, (used + MEMORY, hard))
    yield
    resource.setrlimit(resource.RLIMIT_AS, (soft, hard))


def read(document: object) -> Scene | br.BallraceError:
    """Read a document; what is read must say the same when it is written and read again."""
    scene = decided(lambda: Scene.from_json(json.dumps(document)))
    of_a_scene(scene)
    if isinstance(scene, Scene):
        assert Scene.from_toml(scene.to_toml()).to_json() == scene.to_json()
    return scene


def finite(out: br.Signals) -> None:
    """Check that signals are numbers, but where a column says when it is none."""
    assert np.isfinite(out.t).all()
    for name in out:
        if not name.endswith(UNDEFINED):
            assert np.isfinite(out[name]).all(), name


def run(document: object, asked: dict[str, Any]) -> str:
    """Read and run a document; return what became of it."""
    scene = read(document)
    if not isinstance(scene, Scene):
        return "refused"
    out = decided(lambda: br.simulate(scene, **asked, **SHORT))
    of_a_scene(out)
    if isinstance(out, br.Signals):
        finite(out)
        return "ok"
    return type(out).__name__


@fuzzed(document=scenes(), asked=RUNS)
def test_any_scene_runs_or_says_why_not(document: object, asked: dict[str, Any]) -> str:
    return run(document, asked)


def at_rest(document: object) -> str:
    """Solve a document at rest; return what became of it."""
    scene = read(document)
    if not isinstance(scene, Scene):
        return "refused"
    found = decided(lambda: br.equilibrium(scene))
    of_a_scene(found)
    if not isinstance(found, br.statics.Equilibrium):
        return type(found).__name__
    for name in ("outer", "inner", "radius", "z", "outer_load", "inner_load", "outer_pressure"):
        assert np.isfinite(getattr(found, name)).all(), name
    assert (found.outer_load >= 0.0).all()
    assert (found.inner_load >= 0.0).all()
    stiff = decided(lambda: br.stiffness(scene))
    if isinstance(stiff, br.statics.Stiffness):
        assert np.isfinite(stiff.rings_spatial).all()
        scale = np.abs(stiff.rings).max()
        np.testing.assert_allclose(stiff.rings, stiff.rings.T, rtol=0.0, atol=1e-6 * scale)
    loads = decided(lambda: br.load_distribution(scene, positions=2))
    if isinstance(loads, br.statics.LoadDistribution):
        assert np.isfinite(loads.inner_load).all()
        assert np.isfinite(loads.outer_equivalent).all()
    return "ok"


@fuzzed(document=scenes())
def test_any_scene_rests_or_says_why_not(document: object) -> str:
    return at_rest(document)


def explained(document: object) -> str:
    """Explain a document and ask its model; return what became of it."""
    scene = read(document)
    if not isinstance(scene, Scene):
        return "refused"
    explanation = decided(lambda: br.explain(scene))
    of_a_scene(explanation)
    model = decided(lambda: br.Model(scene))
    if isinstance(model, br.Model):
        start = decided(lambda: model.start("rolling"))
        if isinstance(start, np.ndarray):
            assert np.isfinite(start).all()
            assert np.isfinite(model.rhs(0.0, start)).all()
            with np.errstate(all="ignore"):
                forces = model.forces(0.0, start)
            assert all(np.isfinite(force).all() for force in forces.values())
    return type(explanation).__name__


@fuzzed(document=scenes(most=2))
def test_any_scene_is_explained_or_says_why_not(document: object) -> str:
    return explained(document)


TOML = tuple(Scene.from_json(json.dumps(d)).to_toml() for d in BASES.values())
JSON = tuple(json.dumps(document) for document in BASES.values())


def text_is_decided(text: str) -> str:
    """Read a text as both kinds of document; what is read must be a scene that can be written."""
    found = []
    for reader in (Scene.from_toml, Scene.from_json):
        scene = decided(lambda reader=reader: reader(text))  # type: ignore[misc]
        if isinstance(scene, Scene):
            assert Scene.from_toml(scene.to_toml()).to_json() == scene.to_json()
        found.append(type(scene).__name__)
    return " and ".join(sorted(found))


@fuzzed(text=damaged(TOML + JSON))
def test_damaged_text_is_refused_with_its_place(text: str) -> str:
    return text_is_decided(text)


PARTS = st.sampled_from(
    ("rows", "rows[0]", "rows[1]", "rows[-1]", "rows[", "]",
      "[0]", "[99999999999999999999]", "loads", "loads.radial",
     "radial", "force", "defects.new", "new", "drive", "speed", "ball_count", "clearance", "contact", "slices",
     "fitted", "", " ", ".", "..", "gravity[0]", "é", "\0", "solver.rtol", "probes.outer.motion.body", "name")
)  # fmt: skip
PATHS = st.one_of(st.lists(PARTS, max_size=4).map(".".join), st.text(max_size=12))
VALUES = st.one_of(
    st.sampled_from(WRONG),
    st.sampled_from(EDGES),
    st.sampled_from((float("nan"), float("inf"), b"x", object(), np.float32(1.0), np.arange(3), {1: 2}, {1, 2})),
    st.recursive(st.none() | st.floats() | st.text(max_size=3), st.lists, max_leaves=4),
)  # fmt: skip


@fuzzed(
    base=st.sampled_from(sorted(BASES)),
    changes=st.dictionaries(PATHS, VALUES, max_size=3),
)
def test_any_path_is_replaced_or_refused(base: str, changes: dict[str, object]) -> str:
    scene = Scene.from_json(json.dumps(BASES[base]))
    found = decided(lambda: scene.replace(changes))
    return type(found).__name__


@pytest.mark.parametrize("path", sorted(CORPUS.glob("*")), ids=lambda path: path.name)
def test_the_corpus(path: Path) -> None:
    """What once went wrong, read and run in every way."""
    text = path.read_text(encoding="utf-8")
    text_is_decided(text)
    with contextlib.suppress(json.JSONDecodeError):
        document = json.loads(text)
        run(document, {"duration": 1e-4, "fs": 2e4})
        at_rest(document)
        explained(document)


def test_a_list_is_no_part() -> None:
    """A document says every field by its name: by their order numbers would be misread without a word."""
    document = {**BASES["deep groove"], "cage": [1e6, 20.0, 1e-4]}
    with pytest.raises(br.SceneError, match="cage"):
        Scene.from_json(json.dumps(document))
