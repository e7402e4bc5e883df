"""Bearings by bore, outside diameter and width: what the rule of proportions is worth, against the catalogue."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

import ballrace as br
from ballrace.bearings.entry import Kind

KINDS: tuple[Kind, ...] = ("deep_groove", "angular_contact", "double_row")


def again(row: br.Bearing) -> br.Bearing:
    """What the rule makes of a bearing's boundary dimensions."""
    angle = row.contact_angle if row.kind == "angular_contact" else None
    return br.Bearing.from_dimensions(
        row.bore, row.outside_diameter, row.width, kind=row.kind, contact_angle=angle
    )


@pytest.mark.parametrize("kind", KINDS)
def test_nine_of_ten_bearings_are_nearer_than_is_stated(kind: Kind) -> None:
    """Literature: balls by makers' ratings. 88 to 98 of 100 keep it, so it is no larger than needed."""
    pairs = [(row, again(row)) for row in br.catalogue.find(kind=kind)]
    assert len(pairs) >= 30
    for name in ("ball_diameter", "ftf", "bpfo", "bpfi", "bsf"):
        kept = []
        for row, made in pairs:
            given = made.uncertainty
            assert given is not None
            own = made if name == "ball_diameter" else made.orders
            real = row if name == "ball_diameter" else row.orders
            off = given.ball_diameter if name == "ball_diameter" else getattr(given.orders, name)
            kept.append(abs(getattr(own, name) - getattr(real, name)) <= off)
        assert 0.88 <= np.mean(kept) <= 0.98, (name, np.mean(kept))


def test_balls_are_right_to_one() -> None:
    """As the documentation says: every second number of balls, and 97 in a hundred within one."""
    rows = [row for kind in KINDS for row in br.catalogue.find(kind=kind)]
    off = np.array([again(row).ball_count - row.ball_count for row in rows])
    assert np.mean(off == 0) == pytest.approx(0.53, abs=0.02)
    assert np.mean(np.abs(off) <= 1) == pytest.approx(0.97, abs=0.01)
    assert np.abs(off).max() == 2


PUBLISHED = {
    "6205": (9, 7.94, 39.04),  # Case Western Reserve
    "6203": (8, 6.75, 28.55),  # Paderborn
    "61804": (13, 3.5, 25.6),  # PRONOSTIA
    "608": (7, 3.968, 15.016),  # LADISK, Ljubljana, measured
    "7218B": (16, 22.23, 125.26),  # Harris
    "UER204": (8, 7.92, 34.55),  # XJTU-SY
    "ER-16K": (9, 7.938, 38.51),  # SpectraQuest
}
"""Balls and diameters [mm] that were measured or published of single bearings."""


def test_published_balls_are_those_of_the_ratings() -> None:
    """Literature: six of seven pitch diameters lie within 1.5 % of the mean of bore and outside diameter."""
    off = []
    for name, (balls, ball, pitch) in PUBLISHED.items():
        row = br.catalogue[name]
        assert row.ball_count == balls
        assert 1e3 * row.ball_diameter == pytest.approx(ball, rel=3e-3)
        off.append(abs(2e-3 * pitch / (row.bore + row.outside_diameter) - 1.0))
    assert np.count_nonzero(np.array(off) <= 0.0155) == 6
    assert max(off) < 0.032


def test_a_bearing_by_its_size_runs_and_says_what_it_is() -> None:
    made = br.Bearing.from_dimensions(25e-3, 52e-3, 15e-3)
    assert made.ball_count == 9
    assert made.ball_diameter == pytest.approx(7.9375e-3)
    assert made.dynamic_rating == pytest.approx(14000.0, rel=0.01)
    assert made.static_rating == pytest.approx(7850.0, rel=0.01)
    assert made.designation == "25x52x15 deep groove"
    assert made.sources.balls.startswith("estimated")
    assert br.bearing(made, radial_load=500.0, speed_rpm=1800.0).doubts() == ()
    assert br.catalogue["6205"].uncertainty is None
    pair = br.Bearing.from_dimensions(30e-3, 62e-3, 23.8e-3, kind="double row")  # type: ignore[arg-type]
    assert pair.kind == "double_row"
    assert pair.contact_angle == pytest.approx(math.radians(25.0))
    assert len(br.bearing(pair, speed_rpm=1800.0).rows) == 2
    steep = again(br.catalogue["7308B"])
    assert steep.contact_angle == pytest.approx(math.radians(40.0))
    assert br.fault_frequencies(replace(made, ball_count=8), 60.0).bpfo < made.orders.bpfo


@pytest.mark.parametrize(
    ("arguments", "field"),
    [
        ({"d": 25.0, "D": 52.0, "B": 15.0}, "d"), ({"d": 0.0}, "d"), ({"d": "25"}, "d"), ({"D": 24e-3}, "D"),
        ({"D": math.nan}, "D"),
        ({"D": 0.5}, "D"), ({"B": 1e-3}, "B"), ({"B": 0.1}, "B"), ({"kind": "thrust"}, "kind"),
        ({"kind": 7}, "kind"),
        ({"kind": "angular_contact"}, "contact_angle"),
        ({"kind": "angular_contact", "contact_angle": 40.0}, "contact_angle"),
        ({"contact_angle": -0.1}, "contact_angle"), ({"contact_angle": math.nan}, "contact_angle"),
    ],
)  # fmt: skip
def test_sizes_are_checked_by_their_names(arguments: dict[str, object], field: str) -> None:
    good: dict[str, object] = {"d": 25e-3, "D": 52e-3, "B": 15e-3}
    with pytest.raises(br.SceneError) as refused:
        br.Bearing.from_dimensions(**(good | arguments))  # type: ignore[arg-type]
    assert refused.value.path == field
