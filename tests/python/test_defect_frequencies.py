"""Defects excite vibration at the rates that the geometry gives them.

Truth: kinematics of pure rolling at the *operating* contact angle (measured in the run from the contact
forces), and the orbit and the spin of the balls themselves. Signals are judged as one judges a measured
one: squared envelope of the outer ring's acceleration from 1.5 to 5.5 kHz, lines fitted between the bins.

Two things besides the contact angle move the rates of bodies that roll without sliding as a whole:

- A groove bends around the ball, so the places that touch lie on different radii, and a ball rolls where the
  friction over all of them balances (Heathcote's slip): on 0.3 % less than its diameter here. Its spin is
  0.4 % faster than of the full diameter, and this accounts for two thirds of that.
- Play in the cage lets the balls close up or draw apart in the load zone, which changes the rate of passing
  balls by up to play/2 over the distance of the balls: 0.4 % for the play of the preset 6205. Here it has
  none.
"""

from __future__ import annotations

import functools
import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import ballrace as br
from ballrace import frequencies, spectra
from ballrace.scene import ContactsProbe, ForcesProbe, MotionProbe, Patch, RingName, Surface
from truth import meets

if TYPE_CHECKING:
    from collections.abc import Iterable

    from numpy.typing import NDArray

FS = 25_000.0
BAND = (1500.0, 5500.0)
SHAFT = 30.0
SETTLED = 0.05
"""Start of what is judged [s]."""

# Spalls across the whole contact, and ball defects on one track or across both.
OUTER = Patch(
    on="outer_race",
    angle=-math.pi / 2,
    axial_offset=0.0,
    length=4e-3,
    width=1e-3,
    edge_radius=0.3e-3,
)
# At the start no ball is over it.
INNER = replace(OUTER, on="inner_race", angle=-math.pi / 2 - 0.35)
BOTH_TRACKS = replace(OUTER, on="ball", ball=0)
TRACK = 0.8e-3
"""Place of one track of the 6205's ball [m]."""
ONE_TRACK = replace(BOTH_TRACKS, axial_offset=TRACK, length=1.2e-3)


def deep_groove(**defects: Patch) -> br.Scene:
    scene = br.presets.deep_groove_6205(500.0, 200.0).replace({"cage.play": 0.0})
    return replace(scene, defects=defects)


def wheel(**defects: Patch) -> br.Scene:
    """Return the wheel bearing under +3 kN with Hertz contacts; the spalls grow with its balls."""
    scene = br.presets.wheel_bearing(3000.0).replace({"contact.law": "hertz"})
    wide = {
        name: replace(
            defect,
            length=2.0 * defect.length,
            axial_offset=2.5 * TRACK if defect.axial_offset else 0.0,
            width=1.0e-3 if defect.on == "ball" else 1.5e-3,
        )
        for name, defect in defects.items()
    }
    return replace(scene, defects=wide)


@dataclass(frozen=True)
class Run:
    """What a run says; frequencies in hertz."""

    out: br.Signals
    orders: frequencies.Orders
    """Kinematic, of the operating contact angle."""
    angle: float
    orbit: float
    spin: float
    """Of ball 0 against the cage."""
    rolling_diameter: float
    envelope: NDArray[np.float64]

    @property
    def title(self) -> str:
        """What it is, in a few words."""
        scene = self.out.scene
        return f"{scene.name}, {', '.join(sorted(scene.defects)) or 'healthy'}"

    @property
    def row(self) -> br.scene.Row:
        return self.out.scene.rows[0]

    def line(self, near: float) -> tuple[float, float]:
        """Find a line within 1.5 % of a frequency; it stands over its surroundings [dB] by the second number."""
        f, value = spectra.line(self.envelope, FS, near, min(0.015 * near, 3.0))
        around = spectra.floor(*spectra.spectrum(self.envelope, FS), near, 25.0)[1]
        return f, 20.0 * math.log10(value / around)


@functools.cache
def run(name: str, duration: float) -> Run:
    bearing, *what = name.split()
    known = {
        "outer": OUTER, "inner": INNER, "both_tracks": BOTH_TRACKS, "one_track": ONE_TRACK
    }  # fmt: skip
    build = {"6205": deep_groove, "wheel": wheel}[bearing]
    probes: dict[str, Any] = {
        "outer": MotionProbe(body="outer", components=("ay",)),
        "ball": MotionProbe(body="row0.ball0", components=("x", "y", "theta")),
        "row": ContactsProbe(quantities=("load", "angle", "zone_width")),
    }
    if bearing == "wheel":
        probes["other"] = ContactsProbe(row=1, races=("outer",), quantities=("load",))
    scene = replace(build(**{key: known[key] for key in what}), probes=probes)
    out = br.simulate(scene, duration=duration, fs=FS, threads=1, bandwidth=None)

    settled = out.t >= SETTLED
    phase = np.unwrap(np.arctan2(out["ball.y"], out["ball.x"]))
    orbit = rate(phase[settled])
    row = scene.rows[0]
    angle = np.mean([mean(out, race, "angle") for race in ("outer", "inner")])
    spin = rate(out["ball.theta"][settled])
    lost = 0.0
    for race, conformity, turns in (
        ("outer", row.outer_conformity, spin),
        ("inner", row.inner_conformity, spin - SHAFT),
    ):
        half_length = 0.5 * mean(out, race, "zone_width") / math.cos(angle)
        lost += rolling_loss(
            half_length, conformity * row.ball_diameter, float(angle), math.tau * abs(turns)
        )
    return Run(
        out=out,
        orders=frequencies.orders(
            row.ball_count, row.ball_diameter, row.pitch_diameter, float(angle)
        ),
        angle=float(angle),
        orbit=orbit,
        spin=abs(spin - orbit),
        rolling_diameter=row.ball_diameter - lost,
        envelope=spectra.squared_envelope(out["outer.ay"][settled], FS, BAND),
    )


def rolling_loss(half_length: float, groove: float, angle: float, speed: float) -> float:
    """Return by how much less than its radius a ball rolls on a race [m].

    The friction of Hertz's pressure balances over the length of the contact: at a distance τ from its middle
    the slip is the rolling speed times the difference of radii, τ²/(2 r) of the groove and τ sin α of a ball
    that cannot tilt.
    """
    x = np.linspace(-1.0, 1.0, 401)
    tau = x * half_length
    slip_speed = 0.1  # of both presets

    def friction(loss: float) -> float:
        slip = speed * (loss - tau * math.sin(angle) - tau**2 / (2.0 * groove))
        return float(np.sum((1.0 - x**2) * slip / np.sqrt(slip**2 + slip_speed**2)))

    low, high = 0.0, half_length**2 / (2.0 * groove)
    for _ in range(50):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if friction(middle) < 0.0 else (low, middle)
    return low


def rate(phase: NDArray[np.float64]) -> float:
    """Return the mean turns a second."""
    return float((phase[-1] - phase[0]) / (phase.size - 1) * FS / math.tau)


def mean(out: br.Signals, race: str, quantity: str) -> float:
    """Return the mean of a quantity over all balls of the row, weighted with the load."""
    settled = out.t >= SETTLED
    total = weight = 0.0
    for ball in range(out.scene.rows[0].ball_count):
        load = out[f"row.ball{ball}.{race}.load"][settled]
        value = out[f"row.ball{ball}.{race}.{quantity}"][settled]
        loaded = load > 0.0
        total += float(np.sum(load[loaded] * value[loaded]))
        weight += float(np.sum(load[loaded]))
    return total / weight


def check_operating_angle(found: Run) -> None:
    assert abs(found.angle) > math.radians(5.0)  # otherwise this proves little
    case = f"{found.out.scene.name}: orbit at {math.degrees(found.angle):.1f}°, orders"
    meets(case, found.orders.ftf, found.orbit / SHAFT, 3e-3)


def check_lines(found: Run, lines: Iterable[tuple[float, float]], over: float = 12.0) -> None:
    """Check lines, each given by its kinematic order and by the balls' measured rates [Hz]."""
    for order, measured in lines:
        f, level = found.line(measured)
        meets(f"{found.title}: line at order {order:.3f}, Hz", order * SHAFT, f, 3e-3)
        assert f == pytest.approx(measured, rel=3e-3)
        assert level > over


def outer_lines(found: Run, orders: Iterable[int]) -> list[tuple[float, float]]:
    z = found.row.ball_count
    return [(k * found.orders.bpfo, k * z * found.orbit) for k in orders]


def inner_lines(found: Run, orders: Iterable[int]) -> list[tuple[float, float]]:
    z = found.row.ball_count
    return [
        (k * found.orders.bpfi + side, k * z * (SHAFT - found.orbit) + side * SHAFT)
        for k in orders
        for side in (-1, 0, 1)
    ]


def ball_lines(found: Run, orders: Iterable[int]) -> list[tuple[float, float]]:
    """BSF/cos α, of the diameter on which the balls roll."""
    row = found.row
    spin = frequencies.bsf(
        row.ball_count, found.rolling_diameter, row.pitch_diameter, found.angle
    ) / math.cos(found.angle)
    return [(k * spin, k * found.spin) for k in orders]


def check_family(
    found: Run, order: float, measured: float, multiples: tuple[int, ...], offset: float = 0.0
) -> None:
    """Check lines fitted together, which short runs need."""
    f, value = spectra.comb(
        found.envelope, FS, measured, 0.015 * measured, orders=multiples, offset=offset
    )
    meets(f"{found.title}: family of order {order:.3f}, Hz", order * SHAFT, f, 3e-3)
    assert f == pytest.approx(measured, rel=3e-3)
    table = spectra.spectrum(found.envelope, FS)
    for k, height in zip(multiples, value, strict=True):
        assert height > 2.0 * spectra.floor(*table, k * f + offset, 25.0)[1]


def test_two_defects_give_both_families() -> None:
    found = run("6205 outer inner", 0.6)
    check_operating_angle(found)
    z = found.row.ball_count
    check_family(found, found.orders.bpfo, z * found.orbit, (1, 2, 3, 4))
    # 2 BPFI stands next to 3 BPFO.
    bpfi, measured = found.orders.bpfi, z * (SHAFT - found.orbit)
    check_family(found, bpfi, measured, (1, 3, 5))
    check_family(found, bpfi, measured, (1, 2, 3), offset=-SHAFT)
    check_family(found, bpfi, measured, (1, 2, 3), offset=SHAFT)


def test_a_ball_defect_across_both_tracks_strikes_twice_a_turn() -> None:
    found = run("6205 both_tracks", 0.6)
    check_operating_angle(found)
    ((order, measured),) = ball_lines(found, (1,))
    check_family(found, order, measured, (2, 4, 6))
    heights = [spectra.line(found.envelope, FS, k * measured, 1.0)[1] for k in (1, 2)]
    assert heights[1] > 1.5 * heights[0]


@pytest.mark.long
@pytest.mark.parametrize("bearing", ["6205", "wheel"])
@pytest.mark.parametrize("race", ["outer", "inner"])
def test_ring_defects(bearing: str, race: str) -> None:
    found = run(f"{bearing} {race}", 1.0 if bearing == "6205" else 0.5)
    check_operating_angle(found)
    families = {"outer": outer_lines, "inner": inner_lines}
    check_lines(found, families[race](found, (1, 2, 3)))
    # The other family is not there.
    other = {
        "outer": found.row.ball_count * (SHAFT - found.orbit),
        "inner": found.row.ball_count * found.orbit,
    }
    ours = families[race](found, (1,))[len(families[race](found, (1,))) // 2][1]
    assert found.line(other[race])[1] < found.line(ours)[1] - 12.0


@pytest.mark.long
@pytest.mark.filterwarnings("ignore:defects.*on = ball")
@pytest.mark.parametrize("bearing", ["6205", "wheel"])
def test_ball_defects(bearing: str) -> None:
    duration = 1.0 if bearing == "6205" else 0.5
    # On one track once a turn: the line at the spin is the highest, and the following ones fall.
    one = run(f"{bearing} one_track", duration)
    check_operating_angle(one)
    check_lines(one, ball_lines(one, (1, 2, 3)), over=6.0)
    both = run(f"{bearing} both_tracks", duration)
    check_operating_angle(both)
    check_lines(both, ball_lines(both, (2, 4)), over=6.0)

    def height(found: Run, order: int) -> float:
        return spectra.line(found.envelope, FS, order * found.spin, 1.0)[1]

    assert height(one, 1) > height(one, 2)
    assert height(both, 2) > 1.5 * height(both, 1)


@pytest.mark.long
@pytest.mark.parametrize("bearing", ["6205", "wheel"])
def test_two_defects_for_longer(bearing: str) -> None:
    found = run(f"{bearing} outer inner", 1.0 if bearing == "6205" else 0.5)
    check_operating_angle(found)
    check_lines(found, outer_lines(found, (1, 2, 3)), over=9.0)
    check_lines(found, inner_lines(found, (1, 3)), over=6.0)


@pytest.mark.long
def test_the_healthy_row_carries_the_lines_of_the_other() -> None:
    """Cross-talk: the loads of the row without a defect carry the lines of the row with one."""

    def line_of(found: Run, f: float) -> tuple[float, NDArray[np.float64]]:
        out = found.out
        load = sum(out[f"other.ball{b}.outer.load"] for b in range(13))
        assert not isinstance(load, int)
        squared = spectra.squared_envelope(load[out.t >= SETTLED], FS, (500.0, 8000.0))
        return spectra.comb(squared, FS, f, 0.005 * f, orders=(1, 2, 3))

    hurt, healthy = run("wheel outer", 0.5), run("wheel", 0.5)
    bpfo = 13.0 * hurt.orbit
    f, value = line_of(hurt, bpfo)
    meets("wheel bearing: BPFO in the loads of the healthy row, Hz", bpfo, f, 1e-3)
    assert (value > 100.0 * line_of(healthy, bpfo)[1]).all()


# Passages, sample by sample


def passages(on: Surface, width: float, probes: dict[str, Any]) -> br.Signals:
    """Run long enough for four passages over an outer spall, sample by sample."""
    scene = deep_groove(spall=replace(INNER if on == "inner_race" else OUTER, width=width))
    scene = replace(scene, probes=probes)
    return br.simulate(scene, duration=0.04, fs=200_000.0, threads=1, bandwidth=None)


def entry_to_exit(out: br.Signals, width: float) -> list[float]:
    """Return the times from entry to exit of all loaded passages [s].

    On a race the contact forces of a ball are radial. From entry to exit they incline to an edge, most in
    the middle: the ball is first pushed forward, then held back.
    """
    defect = out.scene.defects["spall"]
    row = out.scene.rows[0]
    most = 0.5 * width / (0.5 * row.ball_diameter + defect.edge_radius)
    race = "inner" if defect.on == "inner_race" else "outer"
    found = []
    for b in range(row.ball_count):
        phi = np.arctan2(out[f"ball{b}.y"], out[f"ball{b}.x"])
        ring = out["inner.theta"] if race == "inner" else 0.0
        place = np.angle(np.exp(1j * (phi - ring - defect.angle))) * 0.5 * row.pitch_diameter
        tangential = (
            np.cos(phi) * out[f"force{b}.contact.y"] - np.sin(phi) * out[f"force{b}.contact.x"]
        )
        near = np.flatnonzero(np.abs(place) < 1.3 * width)
        for part in np.split(near, np.flatnonzero(np.diff(near) > 1) + 1):
            if part.size < 20 or part[0] == 0 or part[-1] == out.t.size - 1:
                continue
            load = float(np.median(out[f"row.ball{b}.{race}.load"][part[: part.size // 8]]))
            if load < 150.0:
                continue
            inside = np.flatnonzero(np.abs(tangential[part]) > 0.05 * load * most)
            found.append(float(out.t[part[inside[-1]]] - out.t[part[inside[0]]]))
    return found


@pytest.mark.parametrize("race", ["outer", "inner"])
@pytest.mark.parametrize("width", [0.5e-3, 1e-3, 2e-3])
def test_entry_and_exit_are_apart_by_the_time_of_the_geometry(race: RingName, width: float) -> None:
    # Sawalhi and Randall: v = π f_r (d_m/2) (1 − (D/d_m)²), the same for both races; here with cos α.
    probes: dict[str, Any] = {
        "inner": MotionProbe(body="inner", components=("theta",)),
        "row": ContactsProbe(races=(race,), quantities=("load",)),
    }
    for b in range(9):
        probes[f"ball{b}"] = MotionProbe(body=f"row0.ball{b}", components=("x", "y"))
        probes[f"force{b}"] = ForcesProbe(body=f"row0.ball{b}")
    on: Surface = "outer_race" if race == "outer" else "inner_race"
    found = entry_to_exit(passages(on, width, probes), width)
    row = deep_groove().rows[0]
    gamma = row.ball_diameter * math.cos(math.radians(13.5)) / row.pitch_diameter
    speed = math.pi * SHAFT * row.pitch_diameter / 2.0 * (1.0 - gamma**2)
    assert len(found) >= 2
    assert np.array(found) == pytest.approx(width / speed, rel=0.15)


# The narrowest are narrower than their contacts.
@pytest.mark.filterwarnings("ignore:.*1.3 times the width of the contacts")
def test_impacts_grow_with_width() -> None:
    """Up to the width at which the ball loses its load; wider, it flies, and the impacts grow no more."""
    healthy = br.equilibrium(deep_groove())
    loaded = int(np.argmax(healthy.outer_load))
    approach = healthy.outer_deflection[loaded] + healthy.inner_deflection[loaded]
    # A ball of diameter D sinks w²/(4 D) between sharp edges.
    widest = 2.0 * math.sqrt(deep_groove().rows[0].ball_diameter * approach)
    assert 0.3e-3 < widest < 0.7e-3

    def strength(width: float) -> float:
        probes = {"outer": MotionProbe(body="outer", components=("ay",))}
        out = passages("outer_race", width, probes)
        squared = spectra.squared_envelope(out["outer.ay"], out.fs, BAND)
        return math.sqrt(float(np.mean(squared[out.t > 4e-3])) / 2.0)

    found = [strength(share * widest) for share in (0.2, 0.4, 0.6, 0.8, 1.0)]
    assert (np.diff(found) > 0.3 * np.array(found[:-1])).all()
