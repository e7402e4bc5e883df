"""Kinematic frequencies against a published bearing and against each other."""

from __future__ import annotations

import math

import pytest

import ballrace as br
from ballrace import frequencies

CWRU = (9, 7.94e-3, 39.04e-3)


def test_published_orders_of_the_6205() -> None:
    # Case Western Reserve University bearing data center, drive end.
    found = frequencies.orders(*CWRU)
    assert found.bpfo == pytest.approx(3.5848, abs=5e-4)
    assert found.bpfi == pytest.approx(5.4152, abs=5e-4)
    assert found.ftf == pytest.approx(0.39828, abs=5e-5)
    assert 2.0 * found.bsf == pytest.approx(4.7135, abs=5e-4)


def test_relations() -> None:
    found = frequencies.orders(13, 11.906e-3, 60e-3, math.radians(13))
    assert found.bpfo + found.bpfi == pytest.approx(13)
    assert found.bpfo == pytest.approx(13 * found.ftf)


def test_faces_agree() -> None:
    row = br.presets.deep_groove_6205().rows[0]
    found = frequencies.of_row(row)
    assert found == frequencies.orders(*CWRU)
    functions = (frequencies.ftf, frequencies.bpfo, frequencies.bpfi, frequencies.bsf)
    assert [f(*CWRU) for f in functions] == [found.ftf, found.bpfo, found.bpfi, found.bsf]
    assert found.at(30.0).bpfo == pytest.approx(30.0 * found.bpfo)


@pytest.mark.parametrize(
    "arguments",
    [(0, 1.0, 2.0), (9, 0.0, 2.0), (9, 2.0, 2.0), (9, 1.0, math.nan), (9, 1.0, 2.0, 2.0)],
)
def test_bad_numbers(arguments: tuple[float, ...]) -> None:
    with pytest.raises(br.SceneError):
        frequencies.orders(*arguments)  # type: ignore[arg-type]
