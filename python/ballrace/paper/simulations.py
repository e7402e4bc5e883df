"""Simulations of a load case of the paper at rest, at an instant and over time."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

import numpy as np

from ..errors import SceneError
from ..run import simulate
from ..scene import FixedSlices, MotionProbe, SlicesProbe
from ..simulation import Simulation
from ..statics import equilibrium
from .case import Balls, Case, Dynamic, Snapshot, Static
from .measures import Array, clarity, envelope_line, impacts, orbit, passages, settling_time, zone

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from ..scene import Component, Scene
    from ..signals import Signals


INSTANT = 0.017992
"""Time of the paper's figures of forces [s]."""

SETTLED = 0.02
"""Time up to which the paper calls its signals a transient [s]."""

FS = 200_000.0
"""Sampling rate of the signals [Hz]."""

SIGNALS = "point samples, as the paper computed its own: no low-pass before them (bandwidth=None)"
"""How the signals of this package are taken."""

# Of the mean impact: less than this of the start cannot be seen in the figures.
VISIBLE = 0.05
_SLICES = 200


def static(scene: Scene) -> Static:
    """Return where the loaded ball of the healthy bearing rests; see :class:`Static`."""
    eq = equilibrium(healthy_at_bottom(scene))
    k = _middle(eq.row, eq.angle)
    return Static(
        ball_z=float(eq.z[k]),
        outer_z=float(eq.outer[2]),
        zone_middle=float(eq.outer_zone_centre[k]),
        load=float(eq.outer_load[k]),
    )


def healthy_at_bottom(scene: Scene) -> Scene:
    """Return the healthy bearing turned so that ball 0 of row 0 is at -90°."""
    # A nanoradian beside: exactly there the search for a loose bearing's equilibrium may fail.
    at = -np.pi / 2.0 + 1e-9
    return turned(scene, at - scene.rows[0].start_angle).replace({"defects": {}})


def turned(scene: Scene, by: float) -> Scene:
    """Return a scene whose balls begin further round by an angle [rad]."""
    return scene.replace(
        {f"rows[{r}].start_angle": row.start_angle + by for r, row in enumerate(scene.rows)}
    )


def dynamic(out: Signals) -> Dynamic:
    """Return the features of a run with the columns ``outer.ay``, ``ball.x`` and ``ball.y`` (of row 0).

    Raises
    ------
    SceneError
        No whole passage of a ball fits between :data:`SETTLED` and the end.
    """
    t, signal = out.t, out["outer.ay"]
    count = out.scene.rows[0].ball_count
    late = t >= SETTLED
    edges = np.empty(0, dtype=np.intp)
    if np.count_nonzero(late) > 1:
        rate, angle = orbit(t[late], out["ball.x"][late], out["ball.y"][late])
        edges = passages(t, rate, angle, count=count, place=-np.pi / 2.0, after=SETTLED)
    if edges.size < 2:
        wanted = f"at least two passages of balls after {SETTLED} s"
        raise SceneError("duration", f"{t.size / out.fs:g} s", wanted)
    found = impacts(signal, edges)
    part = signal[edges[0] : edges[-1]]
    bpfo = count * rate / (2.0 * np.pi)
    return Dynamic(
        impact=float(found.mean()),
        impact_spread=float(found.std()),
        impact_count=found.size,
        largest=float(found.max()),
        line=envelope_line(part, out.fs, bpfo),
        clarity=clarity(part, out.fs, bpfo),
        rms=float(part.std()),
        bpfo=bpfo,
    )


def snapshot(scene: Scene, threads: int = 0) -> Snapshot:
    """Run a scene from the paper's start and return what its balls and slices bear at :data:`INSTANT`."""
    run = Simulation(
        scene, start="rolling", threads=threads, bandwidth=None, settle=0.0, keep=False
    )
    run.advance_to(INSTANT)
    state, load = run.state, run.contacts["load"]
    now = dict(zip(run.names, state.tolist(), strict=True))
    places = [(r, b) for r, row in enumerate(scene.rows) for b in range(row.ball_count)]
    x, y, z = (np.array([now[f"row{r}.ball{b}.{axis}"] for r, b in places]) for axis in "xyz")
    balls = Balls(
        row=np.array([r for r, _ in places]),
        ball=np.array([b for _, b in places]),
        angle=np.arctan2(y, x),
        z=z,
        outer_load=load[:, 0],
        inner_load=load[:, 1],
    )
    k = _middle(balls.row, balls.angle)
    slices = slices_of(scene, state, int(balls.ball[k]))
    bearing = zone(slices["z"], slices["width"], slices["force"])
    return Snapshot(balls, k, now["outer.z"], bearing, slices)


def slices_of(scene: Scene, start: Array | Literal["equilibrium"], ball: int) -> dict[str, Array]:
    """Return the slices of equal width of a ball of row 0 on the outer race, in a state or at rest."""
    probe = SlicesProbe(row=0, balls=(ball,), races=("outer",), times=(0.0,))
    cut = scene.replace({"probes": {"slices": probe}, "contact.slices": FixedSlices(count=_SLICES)})
    out = simulate(cut, duration=1e-6, fs=1e6, start=start, threads=1, settle=0.0, bandwidth=None)
    table = out.slices
    assert table is not None
    names = ("zeta", "z", "width", "penetration", "force")
    return {name: table[name].to_numpy() for name in names}


def _middle(row: NDArray[np.int64], angle: Array) -> int:
    """Return the index of the ball of row 0 nearest to -90°."""
    away = np.abs(np.angle(np.exp(1j * (angle + np.pi / 2.0))))
    return int(np.argmin(np.where(row == 0, away, np.inf)))


def from_start(
    scene: Scene, duration: float, threads: int, progress: Callable[[float], object] | None = None
) -> Signals:
    """Run a scene from the paper's start and return what :func:`dynamic` needs."""
    place: tuple[Component, ...] = ("x", "y")
    probes = {
        "outer": MotionProbe(body="outer"),
        "ball": MotionProbe(body="row0.ball0", components=place),
    }
    return simulate(
        scene.replace({"probes": probes}),
        duration=duration,
        fs=FS,
        start="rolling",
        threads=threads,
        settle=0.0,
        progress=progress,
        bandwidth=None,
    )


def load_case(
    scene: Scene,
    duration: float,
    threads: int,
    show: Callable[[float], object],
    level: float | None,
) -> Case:
    """Run one load case; ``level`` is what a transient must fall below [m/s²], by default its own impact's."""
    out = from_start(scene, duration, threads, lambda share: show(0.6 * share))
    features = dynamic(out)
    level = VISIBLE * features.impact if level is None else level
    healthy = scene.replace({"probes": {"outer": MotionProbe(body="outer")}, "defects": {}})

    def unsettled(duration: float, start: Literal["rolling", "equilibrium"]) -> Signals:
        return simulate(
            healthy,
            duration=duration,
            fs=FS,
            start=start,
            threads=threads,
            settle=0.0,
            bandwidth=None,
        )

    rolling = unsettled(2.0 * SETTLED, "rolling")
    show(0.75)
    still = unsettled(1.0 / features.bpfo, "equilibrium")["outer.ay"]
    show(0.85)
    at_instant = snapshot(scene, threads=threads)
    show(1.0)
    return Case(
        signals=out,
        dynamic=features,
        snapshot=at_instant,
        static=static(scene),
        transient=settling_time(rolling.t, rolling["outer.ay"], level),
        start_at_rest=float(still.std() / rolling["outer.ay"][: still.size].std()),
    )
