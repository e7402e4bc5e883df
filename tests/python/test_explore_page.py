"""The page of `ballrace explore` in a browser: controls move what they should, and no other host is asked."""

from __future__ import annotations

import io
import json
import re
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any
from urllib.request import urlopen

import numpy as np
import pytest

import ballrace as br
from ballrace.explore.served import Page, served
from browser import Browser, Seen, opened

pytestmark = [pytest.mark.long, pytest.mark.serial]

PATIENCE = 60_000
"""Time that an answer may take on a busy machine [ms]."""


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    pytest.importorskip("marimo", reason="marimo is not installed")
    with opened() as found:
        yield found


@pytest.fixture(scope="module")
def explored(browser: Browser) -> Iterator[Page]:
    del browser  # so that none is served for nothing
    with served() as page:
        yield page


@contextmanager
def shown(browser: Browser, at: Page, width: int = 1400) -> Iterator[tuple[Any, Seen]]:
    with browser.blank(width, height=1000, offline=False) as (page, seen):
        page.set_default_timeout(PATIENCE)
        page.goto(at.url)
        page.wait_for_selector(".pictures svg")
        page.wait_for_selector(".facts table")
        yield page, seen
        hosts = {url.split("/")[2] for url in seen.requests if "://" in url}
        assert {host.split(":")[0] for host in hosts} == {"127.0.0.1"}
        assert [line for line in seen.console if line.startswith("error")] == []


def cell(page: Any, name: str) -> str:
    """What stands beside a name in the page's table."""
    rows: str = page.inner_text(".facts")
    found = (line.partition(name)[2] for line in rows.splitlines() if name in line)
    return next(found, "").strip()


def everything(page: Any) -> str:
    html: str = page.eval_on_selector_all(
        ".pictures, .facts", "all => all.map(e => e.innerHTML).join('')"
    )
    return html


def changed(page: Any, before: str) -> None:
    page.wait_for_function(
        "before => [...document.querySelectorAll('.pictures, .facts')].map(e => e.innerHTML).join('') !== before",
        arg=before,
    )


def moved(page: Any, name: str, was: str) -> None:
    """Wait until the table has something else beside a name; it comes after the drawings."""
    until = time.monotonic() + 1e-3 * PATIENCE
    while not cell(page, name) or f"{name}\t{cell(page, name)}" in was:
        assert time.monotonic() < until, f"{name} does not move"
        page.wait_for_timeout(50)


def slider(page: Any, label: str) -> Any:
    return page.locator("marimo-slider", has_text=label)


def typed(page: Any, label: str, value: str) -> None:
    """Type a number into the field beside a slider."""
    field = slider(page, label).locator("input")
    field.fill(value)
    field.press("Enter")


def picked(page: Any, label: str, option: str) -> None:
    page.locator("marimo-dropdown", has_text=label).first.locator("select").select_option(
        label=option
    )


def test_without_the_token_nothing_is_shown(explored: Page) -> None:
    bare, _, token = explored.url.partition("?access_token=")
    assert len(token) >= 32
    assert bare.startswith("http://127.0.0.1:")
    with urlopen(bare) as answer:
        assert "/auth/login" in answer.url
        assert b"marimo-cell" not in answer.read()


STATIC = {
    "housing: masses": ("2", ""),
    "radial load": ("1500", "largest load"),
    "thrust": ("500", "contact angles"),
    "moment": ("4", "tilt about x, y"),
    "speed": ("3000", "s (Hz)"),
    "clearance": ("60", "radial stiffness"),
}
"""Numbers with what they are set to, and what of the table that moves.

A housing moves a run alone; it is first, so that it is there once the others have moved."""


def test_numbers_move_what_follows_from_them(browser: Browser, explored: Page) -> None:
    with shown(browser, explored) as (page, _):
        for label, (value, row) in STATIC.items():
            was = page.inner_text(".facts")
            typed(page, label, value)
            if row:
                moved(page, row, was)
        scene = br.Scene.from_toml(saved(page, "Scene").decode())
        assert scene == br.Scene.from_toml(scene.to_toml())
        assert scene.loads["radial"].force == 1500.0
        assert scene.rows[0].clearance == pytest.approx(60e-6)
        assert scene.structure is not None
        pedestal = br.bearing("6205", radial_load=1500.0, speed_rpm=3000.0).structure
        assert pedestal is not None
        twice = [2.0 * mode.mass for mode in pedestal.modes]
        assert [mode.mass for mode in scene.structure.modes] == pytest.approx(twice)


def test_oil_damage_and_noise_move_what_they_should(browser: Browser, explored: Page) -> None:
    with shown(browser, explored) as (page, _):
        for label, option, row in (("oil", "vg68", "oil film, "), ("damage", "spall", "")):
            before = everything(page)
            picked(page, label, option)
            changed(page, before)
            page.wait_for_selector(f".facts:has-text('{row}')")
        was = page.inner_text(".facts")
        typed(page, "oil temperature", "100")
        moved(page, "oil film, inner race", was)
        assert page.locator("rect.damage").count() == 1
        for label, value in (("damage: size", "2.5"), ("damage: place", "45")):
            before = everything(page)
            typed(page, label, value)
            changed(page, before)
        assert float(page.locator("rect.damage").get_attribute("width")) == pytest.approx(2.5)
        before = everything(page)
        picked(page, "damage on", "inner race")
        changed(page, before)


def test_bearings_by_name_and_by_size(browser: Browser, explored: Page) -> None:
    with shown(browser, explored) as (page, _):
        for name, text in (("6316/C3", "8 balls"), ("NU205", "roller"), ("7208 BECBP", "14 balls")):
            field = page.locator("marimo-text input")
            field.fill(name)
            field.press("Enter")
            page.wait_for_selector(f"text=/{text}/")
        picked(page, "bearing", "by its size")
        page.wait_for_selector("text=/An estimate/")


def test_a_load_is_turned_by_the_keyboard_alone(browser: Browser, explored: Page) -> None:
    with shown(browser, explored) as (page, _):
        was = cell(page, "largest load")
        for _ in range(40):
            page.keyboard.press("Tab")
            focused = (
                "(() => { let a = document.activeElement; while (a?.shadowRoot?.activeElement)"
            )
            focused += " a = a.shadowRoot.activeElement; return a?.getAttribute('role') })()"
            if page.evaluate(focused) == "slider":
                break
        else:
            pytest.fail("Tab comes to no slider")
        for _ in range(20):
            page.keyboard.press("ArrowRight")
        page.wait_for_function(
            "was => ![...document.querySelectorAll('.facts tr')].some(r => r.innerText.includes(was))",
            arg=was,
        )
        before, now = (
            float(re.sub(r"[^\d.]", "", each)) for each in (was, cell(page, "largest load"))
        )
        assert now > before


def ran(page: Any) -> None:
    page.get_by_role("button", name="Run", exact=True).click()
    page.wait_for_selector("audio", state="attached")
    for place in range(3):
        page.locator(".main-svg:first-child").nth(place).wait_for()


def saved(page: Any, label: str) -> bytes:
    with page.expect_download() as coming:
        page.get_by_text(label, exact=True).click()
    return Path(coming.value.path()).read_bytes()


def test_a_run_its_sound_and_its_files(browser: Browser, explored: Page) -> None:
    from scipy.io import wavfile

    with shown(browser, explored) as (page, _):
        before = everything(page)
        picked(page, "damage", "spall")
        changed(page, before)
        ran(page)
        assert page.locator("text=BPFO").count() > 2
        source = page.locator("audio").first.get_attribute("src")
        sound = page.request.get(page.evaluate("s => new URL(s, location).href", source)).body()
        rate, x = wavfile.read(io.BytesIO(sound))
        assert (rate, x.size) == (25_600, 10_240)
        scene = br.Scene.from_toml(saved(page, "Scene").decode())
        assert scene.defects["damage"].on == "outer_race"
        assert json.loads(saved(page, "Notebook"))["nbformat"] == 4
        assert b"Ball loads, contact pressure and rating life" in saved(page, "Report of the run")
        # A louder sensor changes the run's figures and needs no new run.
        typed(page, "noise", "15")
        page.wait_for_selector(f'audio:not([src="{source}"])', state="attached")


def test_a_run_is_stopped(browser: Browser, explored: Page) -> None:
    with shown(browser, explored) as (page, _):
        typed(page, "simulated time", "2")
        page.get_by_role("button", name="Run", exact=True).click()
        page.wait_for_selector("text=/running, [0-9]+%/")
        page.get_by_role("button", name="Stop", exact=True).click()
        page.wait_for_selector("text=/stopped, /")
        assert page.locator("audio").count() == 0


def test_it_runs_when_idle(browser: Browser, explored: Page) -> None:
    with shown(browser, explored) as (page, _):
        typed(page, "simulated time", "0.1")
        page.get_by_role("switch").click()
        page.wait_for_selector("audio", state="attached")


def measured(folder: Path) -> Path:
    spall = br.defects.spall(on="outer_race", width_mm=2.0)
    out = br.simulate(
        br.bearing("6205", radial_load=1500.0, defects=spall, speed_rpm=1800.0),
        duration=1.0,
        fs=20e3,
    )
    noise = np.random.default_rng(1).normal(scale=2.0, size=out.n_samples)
    path = folder / "pump.csv"
    br.Recording(
        columns={"sensor": out["outer.ay"] + noise}, fs=out.fs, units={"sensor": "m/s^2"}
    ).write(path)
    return path


def test_a_dropped_record_is_judged(browser: Browser, explored: Page, tmp_path: Path) -> None:
    with shown(browser, explored) as (page, _):
        page.locator("input[type=file]").first.set_input_files(measured(tmp_path))
        page.wait_for_selector("text=/6205: damaged, outer race/")
        ran(page)
        page.wait_for_selector("text=/^measured$/")
        page.locator("input[type=file]").first.set_input_files(
            {"name": "x.mat", "mimeType": "", "buffer": b"no record"}
        )
        page.wait_for_selector(".refused >> text=/x.mat/")


def test_it_begins_with_a_scene_or_a_record(browser: Browser, tmp_path: Path) -> None:
    (tmp_path / "mine.toml").write_text(
        br.bearing("6309", speed_rpm=1800.0).to_toml(), encoding="utf-8"
    )
    with served(tmp_path / "mine.toml") as at, shown(browser, at) as (page, _):
        page.wait_for_selector("text=/6309: 8 balls/")
    with served(measured(tmp_path)) as at, shown(browser, at) as (page, _):
        # Moves that come together, while the verdict is computed, all count.
        picked(page, "damage", "spall")
        picked(page, "oil", "vg68")
        page.wait_for_selector("text=/6205: damaged, outer race/")
        page.wait_for_selector("rect.damage")
        page.wait_for_selector(".facts:has-text('oil film, ')")


def test_a_run_is_offered_with_its_time_above_the_fold(browser: Browser, explored: Page) -> None:
    """Highlighted, as to stop is not; the time follows the simulated time."""
    for width in (390, 1400):
        with shown(browser, explored, width) as (page, _):
            run, stop = (page.get_by_role("button", name=n, exact=True) for n in ("Run", "Stop"))
            box = run.bounding_box()
            assert box["y"] + box["height"] < 844.0
            colours = [
                each.evaluate("e => getComputedStyle(e).backgroundColor") for each in (run, stop)
            ]
            least, largest = zip(*([min(c), max(c)] for c in map(channels, colours)), strict=True)
            assert largest[0] - least[0] > 0.3
            assert largest[1] - least[1] < 0.1
            page.wait_for_selector("text=/A run of 0.4 s takes some [0-9.]+ s/")
    with shown(browser, explored) as (page, _):
        typed(page, "simulated time", "2")
        page.wait_for_selector("text=/A run of 2 s takes some [0-9.]+ s/")


def channels(colour: str) -> list[float]:
    """Red, green and blue of a colour, 0 to 1, as browsers write it: ``rgb(64, …)``, ``color(srgb 0.25 …)``."""
    largest = 255.0 if colour.startswith("rgb") else 1.0
    return [float(each) / largest for each in re.findall(r"[\d.]+", colour)[:3]]


def test_fields_have_plain_names(browser: Browser, explored: Page) -> None:
    """As a screen reader has them: words without tags."""
    with shown(browser, explored) as (page, _):
        tree = page.context.new_cdp_session(page).send("Accessibility.getFullAXTree")["nodes"]
    named = [
        (n["role"]["value"], n["name"]["value"]) for n in tree if n.get("name", {}).get("value")
    ]
    fields = [name for role, name in named if role in {"slider", "textbox", "combobox", "switch"}]
    assert {"radial load / N", "radial load / N value input", "damage on", "run when idle"} <= set(
        fields
    )
    assert len(fields) > 25
    assert not [name for _, name in named if "<" in name]


def test_all_drawings_are_in_sight_while_a_slider_moves_on_a_phone(
    browser: Browser, explored: Page
) -> None:
    with shown(browser, explored, 390) as (page, _):
        for label in ("radial load", "noise"):
            before = everything(page)
            thumb = slider(page, label).get_by_role("slider")
            thumb.focus()
            page.keyboard.press("ArrowRight")
            if label == "radial load":
                changed(page, before)
            low = thumb.bounding_box()["y"]
            boxes = [svg.bounding_box() for svg in page.locator(".pictures svg").all()]
            assert len(boxes) == 3
            for box in boxes:
                assert box["x"] >= 0.0
                assert box["x"] + box["width"] <= 390.0
                assert 0.0 <= box["y"] <= box["y"] + box["height"] <= low


@pytest.mark.parametrize("width", [390, 1400])
def test_it_fits_a_phone_and_a_screen(browser: Browser, explored: Page, width: int) -> None:
    with shown(browser, explored, width) as (page, _):
        ran(page)
        assert page.evaluate("document.documentElement.scrollWidth") <= width
        page.mouse.wheel(0, 600)
        box = page.locator(".pictures").bounding_box()
        # The drawings stay in sight of the controls.
        assert 0.0 <= box["y"] < 500.0
