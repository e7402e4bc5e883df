"""Balls that follow their balance of forces against balls with inertia: error in a band, and what it saves.

``python benches/quasi_static.py -o FOLDER`` (extra ``bench``) writes a table and a picture, in four minutes;
``--quick`` in one and a half.

Modes of a ball between its races lie near 30 kHz and set the step. Below them a ball's radial and axial
place may follow, at every instant, from the balance of the forces on it; rings, the balls' orbit and spin
keep their inertia. :class:`QuasiStatic` is that model on top of ``Model.rhs``; nothing of it is in the crate.
"""

from __future__ import annotations

import argparse
import warnings
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import polars as pl
from matplotlib import pyplot as plt

import ballrace as br
from ballrace.scene import Defect, FittedSlices
from precision.draw import BLUE, GREEN, ORANGE, RED

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

SHAFT = 30.0  # of both presets [Hz]
BANDS = (2e3, 5e3, 10e3)  # Hz
FS = 200e3  # of the full model's signals [Hz]
COMMON = 50e3  # rate at which two signals are compared [Hz]
DURATION = 16e-3  # two blows, in the wheel bearing three [s]
CHECKED = 4e-3  # of it, one blow: how long other steps run [s]
STEP = 5e-6  # of the quasi-static model where its error is judged [s]
STEPS = (
    2.5e-6,
    5e-6,
    10e-6,
    20e-6,
)  # tried for its own error, against the first, and its speed [s]
OWN = 0.05  # own error below 10 kHz that a step may have: as much as the bound asked of the model
ALIKE = 0.02  # two runs of the full model from starts 1e-12 m apart are predictable until they are this far apart
BALANCED = 1e-2  # acceleration left to a ball by the forces on it: 2e-5 N for the 6205 [m/s²]
NEAR = 5e-6  # furthest step of a Newton iteration [m]
SOFT = 1e7  # least stiffness over mass of a ball's radial place: what touches nothing is pushed to its race [1/s²]
ITERATIONS = 30
SHOWN = ("6205, spall 1.5 mm", "wheel bearing, spall")  # their blows are drawn


def scenes() -> dict[str, br.Scene]:
    """Return the bearings, by name; a ball is in the middle of the spall after 1.3 and 1.6 ms."""
    plain = br.presets.deep_groove_6205(radial_load=500.0)
    row = replace(plain.rows[0], start_angle=-0.5 * np.pi - 0.1)
    plain = replace(plain, rows=(row,)).replace({"contact.slices": FittedSlices(12)})
    thrust = plain.replace({"loads.axial.force": 1000.0})
    wheel = br.presets.wheel_bearing(axial_load=3000.0)
    turned = tuple(replace(row, start_angle=row.start_angle + 0.3) for row in wheel.rows)
    wheel = replace(wheel, rows=turned).replace({"contact.slices": FittedSlices(12)})

    def spalled(scene: br.Scene, width: float) -> br.Scene:
        spall = Defect(
            on="outer_race",
            angle=-0.5 * np.pi,
            axial_offset=0.0,
            length=4e-3,
            width=width,
            edge_radius=0.3e-3,
        )
        return replace(scene, defects={"spall": spall})

    smooth = plain.replace({"friction": "none"})
    return {
        "6205, no friction, no cage": smooth.replace({"cage.stiffness": 0.0, "cage.damping": 0.0}),
        "6205, no friction": smooth,
        "6205": plain,
        "6205, spall 0.5 mm": spalled(plain, 0.5e-3),
        "6205, spall 1.5 mm": spalled(plain, 1.5e-3),
        "6205, 1 kN thrust": thrust,
        "6205, 1 kN thrust, spall 0.5 mm": spalled(thrust, 0.5e-3),
        "wheel bearing, healthy": replace(wheel, defects={}),
        "wheel bearing, spall": wheel,
    }


@dataclass
class Count:
    """Evaluations of the model, and what they needed of ``Model.rhs``."""

    evaluations: int = 0
    balances: int = 0  # residuals of the balance; the last one gives the rates as well
    directions: int = 0  # derivatives along the motion, one call each
    tangents: int = 0  # Jacobians, by differences
    tangent_calls: int = 0
    unbalanced: int = 0  # balls that found no balance


@dataclass
class QuasiStatic:
    """Rings, orbits and spins as states; the balls' places r and z in balance with the forces on them.

    The state is the rings' 16, then angle, rate of the angle and spin of all balls. At an evaluation the places
    are first carried on by their last speeds; new speeds follow there from the balance's derivative along the
    motion and are held while Newton's iterations balance the places, so that damping and friction see them.
    Balls feel each other through the cage, so differences perturb at once only balls that are no neighbours.
    """

    scene: br.Scene
    keep: bool = False  # the Jacobian, until it no longer serves
    count: Count = field(default_factory=Count)

    def __post_init__(self) -> None:
        self.model = br.Model(self.scene)
        self.balls = n = len(self.model.bodies) - 2
        self.colour = np.zeros(n, dtype=int)
        self.beside = np.zeros((3, n), dtype=int)  # the ball before, itself, the ball after
        first = 0
        for z in (row.ball_count for row in self.scene.rows):
            j = np.arange(z)
            self.colour[first + j] = np.where(j < z - z % 3, j % 3, 3 + j - (z - z % 3))
            self.beside[:, first + j] = first + np.stack([(j - 1) % z, j, (j + 1) % z])
            first += z
        self.tangent = np.empty((0, 0))

    def start(self, y: Array) -> Array:
        """Return the state of this model at a state of the full one, and remember the balls' places."""
        place, speed = y.reshape(2, -1, 4)
        turn = place[2:, 0] + 1j * place[2:, 1]
        r, along = abs(turn), (speed[2:, 0] + 1j * speed[2:, 1]) * turn.conj()
        self.time, self.q = 0.0, np.stack([r, place[2:, 2]])
        self.rate_q = np.stack([along.real / r, speed[2:, 2]])
        rings = y.reshape(2, -1, 4)[:, :2].ravel()
        return np.concatenate([rings, np.angle(turn), along.imag / r**2, speed[2:, 3]])

    def balance(self, t: float, s: Array, q: Array, v: Array) -> tuple[Array, Array, Array]:
        """Return what is left of the balance, shape (2, n), acceleration along the orbit [m/s²], and the rhs."""
        angle, rate, spin = s[16:].reshape(3, -1)
        turn = np.exp(1j * angle)
        y = np.zeros((2, self.balls + 2, 4))
        y[:, :2] = s[:16].reshape(2, 2, 4)
        for of, planar, axial in (
            (y[0], q[0] * turn, q[1]),
            (y[1], (v[0] + 1j * q[0] * rate) * turn, v[1]),
        ):
            of[2:, 0], of[2:, 1], of[2:, 2] = planar.real, planar.imag, axial
        y[1, 2:, 3] = spin
        a = self.model.rhs(t, y.ravel()).reshape(2, -1, 4)
        along = (a[1, 2:, 0] + 1j * a[1, 2:, 1]) * turn.conj()
        left = np.empty_like(q)
        left[0], left[1] = along.real + q[0] * rate**2, a[1, 2:, 2]
        return left, along.imag, a

    def jacobian(self, t: float, s: Array, q: Array, v: Array, g: Array) -> Array:
        """Return the inverse of the balance's derivative by the places, shape (2n, 2n)."""
        n, eps = self.balls, 1e-9
        tangent = np.zeros((2, n, 2, n))
        everyone = np.ones(n, dtype=bool)
        # Along z balls do not feel each other.
        passes = [(0, self.colour == c) for c in range(self.colour.max() + 1)] + [(1, everyone)]
        for axis, moved in passes:
            p = q.copy()
            p[axis, moved] += eps
            change = (self.balance(t, s, p, v)[0] - g) / eps
            ball = np.flatnonzero(moved)
            for felt in self.beside[:, ball] if axis == 0 else [ball]:
                tangent[:, felt, axis, ball] = change[:, felt]
        self.count.tangents += 1
        self.count.tangent_calls += len(passes)
        i = np.arange(n)
        tangent[0, i, 0, i] = np.minimum(tangent[0, i, 0, i], -SOFT)
        tangent[1, i, 1, i] -= 1.0  # a ball afloat stays where it is along z
        return np.asarray(np.linalg.inv(tangent.reshape(2 * n, 2 * n)))

    def rate(self, t: float, s: Array) -> Array:
        """Return the time derivative of the state."""
        count, angle_rate = self.count, s[16 + self.balls : 16 + 2 * self.balls]
        count.evaluations += 1
        q, v = self.q + self.rate_q * (t - self.time), self.rate_q
        g, across, a = self.balance(t, s, q, v)
        if not self.keep or not self.tangent.size:
            self.tangent = self.jacobian(t, s, q, v, g)
        # Where the motion would take the balance in 10 ns, with places and speeds of the balls held.
        ahead, soon = s.copy(), 1e-8
        ahead[:8] += soon * s[8:16]
        ahead[16 : 16 + self.balls] += soon * angle_rate
        drift = (self.balance(t + soon, ahead, q, v)[0] - g) / soon
        v = np.clip(-(self.tangent @ drift.ravel()).reshape(2, -1), -1.0, 1.0)
        g, across, a = self.balance(t, s, q, v)
        count.directions += 1
        count.balances += 2
        left, step = np.full(self.balls, np.inf), np.zeros_like(q)
        best, least = q.copy(), left.copy()
        for _ in range(ITERATIONS):
            now = abs(g).max(axis=0)
            if now.max() < BALANCED:
                break
            if now.max() > 0.3 * left.max() or (not self.keep and left.max() < np.inf):
                self.tangent = self.jacobian(t, s, q, v, g)
            newton = np.clip(-(self.tangent @ g.ravel()).reshape(2, -1), -NEAR, NEAR)
            # Damped: a ball that is further off than before goes half of its way back.
            step = np.where(now > 2.0 * left, -0.5 * step, newton)
            best, least = np.where(now < least, q, best), np.minimum(now, least)
            left = now
            q = q + step
            g, across, a = self.balance(t, s, q, v)
            count.balances += 1
        else:
            q = np.where(abs(g).max(axis=0) < least, q, best)
            g, across, a = self.balance(t, s, q, v)
            count.balances += 1
        count.unbalanced += int((abs(g).max(axis=0) > BALANCED).sum())
        self.time, self.q, self.rate_q = t, q, v
        orbit = (across - 2.0 * v[0] * angle_rate) / q[0]
        return np.concatenate([a[:, :2].ravel(), angle_rate, orbit, a[1, 2:, 3]])

    def modes(self) -> Array:
        """Return the radial and axial modes of the balls, all else held, shape (2, n) [Hz]."""
        stiffness_over_mass = abs(np.diag(np.linalg.inv(self.tangent))).reshape(2, -1)
        return np.asarray(np.sqrt(stiffness_over_mass) / (2.0 * np.pi))

    def run(self, start: Array, duration: float, step: float) -> Array:
        """Return the outer ring's vertical acceleration at every step (classical Runge-Kutta) [m/s²]."""
        s, h = self.start(start), step
        signal = np.empty(round(duration / h))
        for i in range(signal.size):
            t = i * h
            k1 = self.rate(t, s)
            signal[i] = k1[9]
            k2 = self.rate(t + h / 2, s + h / 2 * k1)
            k3 = self.rate(t + h / 2, s + h / 2 * k2)
            k4 = self.rate(t + h, s + h * k3)
            s = s + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
            if not abs(s).max() < 1e6:
                signal[i:] = np.nan
                break
        return signal


def band(x: Array, fs: float, top: float) -> Array:
    """Return a signal below a frequency at the common rate: Butterworth's gain, no phase, faded at the ends."""
    fade = round(0.5e-3 * fs)
    weight = np.ones(x.size)
    weight[:fade] = 0.5 - 0.5 * np.cos(np.pi * np.arange(fade) / fade)
    weight[-fade:] = weight[:fade][::-1]
    lines = np.fft.rfft(weight * x)
    lines /= 1.0 + (np.fft.rfftfreq(x.size, 1.0 / fs) / top) ** 16
    n = round(x.size * COMMON / fs)
    return np.fft.irfft(lines[: n // 2 + 1], n) * n / x.size


def error(found: Array, true: Array) -> float:
    """Return the relative L2 error."""
    return float(np.linalg.norm(found - true) / np.linalg.norm(true))


def predictable(one: Array, other: Array) -> float:
    """Return the time [s] up to which two signals at the common rate are alike."""
    apart = np.sqrt(np.cumsum((one - other) ** 2) / np.cumsum(one**2 + 1e-300))
    return float(np.flatnonzero(np.append(0.0, apart) <= ALIKE)[-1] / COMMON)


def features(x: Array, top: float, bpfo: float) -> dict[str, float]:
    """Return the features of a signal at the common rate."""
    envelope = br.spectra.squared_envelope(x, COMMON, (500.0, top))
    return {
        "rms": float(np.sqrt(np.mean(x**2))),
        "peak": float(abs(x).max()),
        "kurtosis": float(np.mean((x - x.mean()) ** 4) / np.var(x) ** 2),
        "bpfo_line": br.spectra.line(envelope, COMMON, bpfo, 0.1 * bpfo)[1],
    }


def effort(scene: br.Scene, start: Array) -> tuple[float, float]:
    """Return the full model's evaluations a second: default, and twice the largest step at rtol 1e-3."""
    out = br.simulate(scene, duration=CHECKED, start=start, threads=1, bandwidth=None)
    step = 2.0 * float(out.provenance.max_step)
    loose = scene.replace(
        {"solver.rtol": 1e-3, "solver.frequency_cap": False, "solver.max_step": step}
    )
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", br.AccuracyWarning)
        cheap = br.simulate(loose, duration=CHECKED, start=start, threads=1, bandwidth=None)
    return out.stats.nfev / CHECKED, cheap.stats.nfev / CHECKED


def measure(
    name: str, scene: br.Scene, duration: float
) -> tuple[list[dict[str, object]], tuple[Array, Array]]:
    """Return the rows of a scene, one a band, and the accelerations below 10 kHz: full and quasi-static."""
    start = br.Model(scene).start()
    nudge = np.zeros_like(start)
    nudge[: start.size // 2] = 1e-12 * np.random.default_rng(1).standard_normal(start.size // 2)
    full, other = (
        br.simulate(scene, duration=duration, fs=FS, rtol=1e-7, start=y, threads=1, bandwidth=None)[
            "outer.ay"
        ]
        for y in (start, start + nudge)
    )
    default, loose = effort(scene, start)

    model = QuasiStatic(scene, keep=True)
    signal = model.run(start, duration, STEP)
    unbalanced = model.count.unbalanced / (model.count.evaluations * model.balls)
    afresh = QuasiStatic(scene)
    afresh.run(start, CHECKED / 8, STEP)
    modes = afresh.modes()
    in_band = (modes < BANDS[-1]).sum(axis=1)
    tries = [QuasiStatic(scene, keep=True) for _ in STEPS]
    trials = [one.run(start, CHECKED, step) for one, step in zip(tries, STEPS, strict=True)]
    own = {
        top: [
            error(band(x, 1 / h, top), band(trials[0], 1 / STEPS[0], top))
            for x, h in zip(trials, STEPS, strict=True)
        ]
        for top in BANDS
    }
    # The largest step that is still right, or the first one.
    best = max(i for i, e in enumerate(own[BANDS[-1]]) if e <= OWN)
    kept, new, each = tries[best].count, afresh.count, 4.0 / STEPS[best]
    work = {
        "balls": model.balls,
        "radial_in_band": int(in_band[0]),
        "axial_in_band": int(in_band[1]),
        "highest_khz": modes.max() / 1e3,
        "unbalanced_share": unbalanced,
        "step_us": 1e6 * STEPS[best],
        "balances_kept": kept.balances / kept.evaluations,
        "balances_newton": new.balances / new.evaluations,
        "evaluations_per_s": each,
        "full_per_s": default,
        "full_loose_per_s": loose,
        "kept_per_s": each
        * (kept.balances + kept.directions + kept.tangent_calls)
        / kept.evaluations,
        "newton_per_s": each * new.balances / new.evaluations,
    }
    bpfo = br.frequencies.of_row(scene.rows[0]).at(SHAFT).bpfo
    rows: list[dict[str, object]] = []
    until = predictable(band(full, FS, BANDS[-1]), band(other, FS, BANDS[-1]))
    for top in BANDS:
        true, second, found = band(full, FS, top), band(other, FS, top), band(signal, 1 / STEP, top)
        n = round(until * COMMON)
        of_true, of_found, of_second = (features(x, top, bpfo) for x in (true, found, second))
        rows.append(
            {
                "scene": name,
                "band_hz": top,
                "predictable_ms": 1e3 * until,
                "error": error(found[:n], true[:n]) if n else np.nan,
                "own_error": own[top][STEPS.index(STEP)],
                "own_error_10us": own[top][2],
                "rms_m_s2": of_true["rms"],
                **{f"{k}_error": of_found[k] / of_true[k] - 1.0 for k in of_true},
                **{f"{k}_between_two_full": of_second[k] / of_true[k] - 1.0 for k in of_true},
                **work,
            }
        )
    return rows, (full, signal)


def draw(table: pl.DataFrame, close: dict[str, tuple[Array, Array]], path: Path) -> None:
    """Draw the errors of all scenes, and one blow in both models."""
    figure, axes = plt.subplot_mosaic(
        [["errors", blow] for blow in close],
        figsize=(10.5, 5.0),
        layout="constrained",
        width_ratios=(1.15, 1),
    )
    names = table["scene"].unique(maintain_order=True).to_list()
    left = axes["errors"]
    for top, colour, mark in zip(BANDS, (GREEN, ORANGE, RED), "osD", strict=True):
        rows = table.filter(pl.col("band_hz") == top)
        left.plot(
            rows["error"] * 100.0,
            range(len(names)),
            mark,
            color=colour,
            ms=5,
            label=f"below {top / 1e3:g} kHz",
        )
    left.axvline(5.0, color="#222222", lw=0.8, ls="--")
    left.set_xscale("log")
    left.set_xticks([3, 5, 10, 20, 50, 100], ["3", "5", "10", "20", "50", "100"])
    left.minorticks_off()
    left.set_yticks(range(len(names)), names)
    left.invert_yaxis()
    left.set_xlabel("error of the outer ring's acceleration, % (dashed: 5 %)")
    left.legend(frameon=False, loc="upper center", bbox_to_anchor=(0.5, -0.1), ncols=3)
    for name, (full, found) in close.items():
        ax = axes[name]
        t = np.arange(round(CHECKED * COMMON)) / COMMON * 1e3
        for x, fs, label, colour in (
            (full, FS, "full", BLUE),
            (found, 1 / STEP, "quasi-static", ORANGE),
        ):
            ax.plot(t, band(x, fs, BANDS[-1])[: t.size], color=colour, lw=0.9, label=label)
        middle = t[np.argmax(abs(band(full, FS, BANDS[-1])[: t.size]))]
        ax.set(xlim=(middle - 0.8, middle + 1.2), ylabel="m/s²", title=f"{name}, below 10 kHz")
    ax.set_xlabel("time, ms")
    ax.legend(frameon=False, loc="lower right")
    figure.savefig(path)
    plt.close(figure)


def main() -> None:
    """Measure, write and draw."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="FOLDER")
    parser.add_argument("--quick", action="store_true", help="8 ms of three scenes")
    options = parser.parse_args()
    options.output.mkdir(parents=True, exist_ok=True)
    chosen = scenes()
    if options.quick:
        chosen = {name: chosen[name] for name in ("6205, no friction, no cage", *SHOWN)}
    rows: list[dict[str, object]] = []
    close: dict[str, tuple[Array, Array]] = {}
    for name, scene in chosen.items():
        found, signals = measure(name, scene, 2.0 * CHECKED if options.quick else DURATION)
        rows += found
        if name in SHOWN:
            close[name] = signals
    table = pl.DataFrame(rows)
    table.write_csv(options.output / "quasi_static.csv", float_precision=4)
    draw(table, close, options.output / "quasi_static.svg")
    errors = [name for name in table.columns if name.endswith("error") or name == "predictable_ms"]
    done = table.columns[table.columns.index("balls") :]
    with pl.Config(
        tbl_rows=-1, tbl_cols=-1, fmt_str_lengths=40, tbl_width_chars=300, float_precision=3
    ):
        print(table.select("scene", "band_hz", "rms_m_s2", *errors))
        print(table.select("scene", *done).unique(maintain_order=True))


if __name__ == "__main__":
    main()
