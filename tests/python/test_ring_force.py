"""Forces on rings by functions of one's own.

Truths: a spring by code is the same spring by a table; an exception reaches who ran it, unchanged.
"""

from __future__ import annotations

import gc
from typing import TYPE_CHECKING

import numpy as np
import pytest

import ballrace as br
from ballrace.scene import Spring, TableForce

if TYPE_CHECKING:
    from pathlib import Path

STIFFNESS, DAMPING = 3e7, 300.0


@pytest.fixture(scope="module")
def scene() -> br.Scene:
    """A 6205 that only a force holds along y."""
    return br.presets.deep_groove_6205(radial_load=800.0).replace(
        {"outer_ring.support.y": Spring(stiffness=1e3, damping=0.0)}
    )


def spring(_: float, ring: br.ring_force.RingMotion) -> tuple[float, float, float]:
    return 0.0, -STIFFNESS * ring.place[1] - DAMPING * ring.velocity[1], 0.0


FORCE = br.RingForce(
    ring="outer", wrench=spring, stiffness=STIFFNESS, damping=DAMPING, in_plane=True
)
TABLE = TableForce(
    ring="outer",
    direction=(0.0, 1.0, 0.0),
    places=(-1e-3, 1e-3),
    forces=(3e4, -3e4),
    damping=DAMPING,
)


def test_a_spring_by_code_is_that_by_a_table(scene: br.Scene) -> None:
    """Truth: the table. The start is the equilibrium with the force, and the runs agree to their tolerance."""
    tabled = scene.replace({"table_forces.spring": TABLE})
    by_code = br.simulate(scene, duration=2e-3, settle=0.0, forces={"spring": FORCE})
    by_table = br.simulate(tabled, duration=2e-3, settle=0.0)
    for name in ("outer.y", "outer.vy", "outer.ay", "inner.ay"):
        bound = 1e-3 * np.ptp(by_table[name])
        np.testing.assert_allclose(by_code[name], by_table[name], atol=bound, err_msg=name)
    assert by_table["outer.y"][0] == pytest.approx(-800.0 / STIFFNESS, rel=0.2)


def test_an_equilibrium_has_a_force_by_code(scene: br.Scene) -> None:
    """Truth: the table's equilibrium."""
    wanted = br.equilibrium(scene.replace({"table_forces.spring": TABLE}))
    found = br.equilibrium(scene, forces={"spring": FORCE})
    np.testing.assert_allclose(found.outer[1], wanted.outer[1], rtol=1e-9)
    np.testing.assert_allclose(found.inner_load, wanted.inner_load, rtol=1e-6)
    assert found.outer[1] == pytest.approx(-800.0 / STIFFNESS, rel=0.02)


def test_a_record_reports_what_its_scene_does_not_have(scene: br.Scene, tmp_path: Path) -> None:
    out = br.simulate(scene, duration=2e-4, settle=0.0, forces={"spring": FORCE})
    assert (
        out.warnings[-1]
        == "forces by functions, which the scene does not have, acted on rings: spring"
    )
    out.write_parquet(tmp_path / "run.parquet")
    read = br.Signals.read_parquet(tmp_path / "run.parquet")
    assert read.warnings == out.warnings
    assert read.scene == scene


def test_moments_and_times_are_passed(scene: br.Scene) -> None:
    """Truth: a torque turns a free ring as its inertia says."""
    free = scene.replace(
        {"outer_ring.support.theta": "free", "friction": "none", "outer_ring.inertia": 1e-3}
    )
    seen = []

    def torque(t: float, ring: br.ring_force.RingMotion) -> list[float]:
        seen.append((t, ring))
        return [*spring(t, ring), 0.0, 0.0, 2e-3]

    force = br.RingForce(ring="outer", wrench=torque, stiffness=STIFFNESS)
    simulation = br.Simulation(free, settle=0.0, forces={"torque": force})
    simulation.advance(1e-3)
    turned = simulation.state[simulation.names.index("outer.omega")]
    assert turned == pytest.approx(2e-3 / 1e-3 * 1e-3, rel=1e-3)
    assert max(t for t, _ in seen) >= 1e-3
    assert seen[-1][1].rates[2] == pytest.approx(turned, rel=0.1)


def test_forces_are_as_at_the_start_while_it_settles(scene: br.Scene) -> None:
    """Truth: the times that a function is given; loads and drive wait, too."""
    times = []

    def timed(t: float, ring: br.ring_force.RingMotion) -> tuple[float, float, float]:
        times.append(t)
        return spring(t, ring)

    force = br.RingForce(ring="outer", wrench=timed, stiffness=STIFFNESS, in_plane=True)
    br.simulate(scene, duration=1e-3, settle=3e-3, forces={"timed": force})
    assert sum(t == 0.0 for t in times) > 1000
    assert 1e-3 < max(times) < 1.2e-3


class TooFarError(RuntimeError):
    """Raised by a force."""


def test_an_exception_reaches_who_ran_it(scene: br.Scene, tmp_path: Path) -> None:
    """Truth: it is the same object, at every later call too, and nothing is written."""
    error = TooFarError("the seal burst")

    def bursting(t: float, ring: br.ring_force.RingMotion) -> tuple[float, float, float]:
        if t > 5e-4:
            raise error
        return spring(t, ring)

    forces = {"seal": br.RingForce(ring="outer", wrench=bursting, stiffness=STIFFNESS)}
    path = tmp_path / "run.parquet"
    with pytest.raises(TooFarError) as raised:
        br.simulate(scene, duration=1.0, forces=forces, out=path)
    assert raised.value is error
    assert not list(tmp_path.iterdir())
    simulation = br.Simulation(scene, forces=forces)
    for _ in range(2):
        with pytest.raises(TooFarError, match="burst"):
            simulation.advance(2e-3)


def test_an_exception_in_the_equilibrium_does_too(scene: br.Scene) -> None:
    def failing(t: float, ring: br.ring_force.RingMotion) -> tuple[float, float, float]:
        raise TooFarError("at once")

    with pytest.raises(TooFarError, match="at once"):
        br.simulate(scene, duration=1.0, forces={"f": br.RingForce(ring="outer", wrench=failing)})


def test_what_is_no_force_is_refused_by_name(scene: br.Scene) -> None:
    def returns(found: object) -> dict[str, br.RingForce]:
        return {"f": br.RingForce(ring="outer", wrench=lambda t, ring: found)}  # type: ignore[arg-type, return-value]

    for forces, message in (
        ([FORCE], "forces = a list: a mapping of RingForce"),
        ({"f": spring}, "forces.f = a function: a RingForce"),
        ({"f": br.RingForce(ring="cage", wrench=spring)}, "forces.f.ring = 'cage'"),  # type: ignore[arg-type]
        ({"f": br.RingForce(ring="outer", wrench=1.0)}, "forces.f.wrench = a float"),  # type: ignore[arg-type]
        ({"f": br.RingForce(ring="outer", wrench=spring, damping=-1.0)}, "forces.f.damping = -1.0"),
        ({"f": br.RingForce(ring="outer", wrench=spring, peak=(1.0,))}, "forces.f.peak"),  # type: ignore[arg-type]
        (returns((1.0, 2.0)), "forces.f = .* at 0 s: three or six finite numbers"),
        (returns((1.0, 2.0, float("nan"))), "forces.f = .*three or six"),
        (returns(None), "forces.f = .*three or six"),
        (returns("text"), "forces.f = text at 0 s: three or six"),
        (returns(("1.0", "2.0", "3.0")), "forces.f = .*three or six"),
    ):
        with pytest.raises(br.SceneError, match=message):
            br.simulate(scene, duration=1e-3, forces=forces)  # type: ignore[arg-type]
    simulation = br.Simulation(scene, settle=0.0, forces={"spring": FORCE})
    with pytest.raises(br.SceneError, match="forces = spring: absent for a snapshot"):
        simulation.snapshot()


def test_forces_are_let_go_with_their_run(scene: br.Scene) -> None:
    """Truth: nothing holds a function after its run."""
    import weakref

    class Held:
        def __call__(self, t: float, ring: br.ring_force.RingMotion) -> tuple[float, float, float]:
            return spring(t, ring)

    held = Held()
    seen = weakref.ref(held)
    br.simulate(
        scene, duration=1e-4, settle=0.0,
        forces={"f": br.RingForce(ring="outer", wrench=held, stiffness=STIFFNESS)},
    )  # fmt: skip
    del held
    gc.collect()
    assert seen() is None
