"""Whatever text comes to the page of `ballrace explore`, a browser runs nothing of it and asks no other host.

Where markup came into the page all the same, its policy would stop it.
"""

from __future__ import annotations

import threading
from collections.abc import Iterator
from contextlib import contextmanager
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import ballrace as br
from ballrace.explore.served import served
from browser import Browser, Seen, opened

pytestmark = pytest.mark.serial

PATIENCE = 60_000
"""Time that an answer may take on a busy machine [ms]."""

EVIL = "http://evil.invalid"
RAN = "(window.parent || window).ran = 1"

PAYLOADS = {
    "script": f"<script>{RAN}</script>",
    "handler": f"<img src=x onerror='{RAN}'>",
    "frame": f'<iframe srcdoc="<script>{RAN}</script>"></iframe>',
    "refresh": f'<meta http-equiv="refresh" content="0;url={EVIL}/">',
    "picture": f"<img src={EVIL}/a.png>",
    "link": f"<link rel=stylesheet href={EVIL}/a.css>",
    "drawing": f"<svg onload='{RAN}'><image href={EVIL}/a.svg></image></svg>",
    "style": f"<style>@import '{EVIL}/b.css'; * {{ background: url({EVIL}/b.png) }}</style>",
    "marimo": f"<marimo-anywidget data-js-url='\"{EVIL}/a.js\"' data-model-id='\"a\"'></marimo-anywidget>",
    "marimo frame": f"<marimo-iframe data-src='\"{EVIL}/\"'></marimo-iframe><marimo-image src={EVIL}/c.png>",
    "markdown": f"[a](javascript:{RAN}) ![b]({EVIL}/d.png) `x` $\\href{{javascript:{RAN}}}{{y}}$",
    "attribute": f"\"'><script>{RAN}</script><details open ontoggle='{RAN}'>",
    "object": f"<object data={EVIL}/e></object><embed src={EVIL}/f><base href={EVIL}/>",
    "form": f"<form action={EVIL}/g><input autofocus onfocus='{RAN}'></form><video><source onerror='{RAN}'>",
}  # fmt: skip
"""Ways of markup to run a script, or to ask another host."""

ALIVE = """
() => {
  const found = [];
  const look = root => {
    for (const one of root.querySelectorAll('*')) {
      for (const {name, value} of one.attributes ?? [])
        if (/^(src|href|xlink:href|srcdoc|action|content|style)$|^on/.test(name) && /evil|\\.ran/.test(value))
          found.push(one.outerHTML.slice(0, 200));
      if (one.shadowRoot) look(one.shadowRoot);
    }
  };
  look(document);
  return {found, ran: window.ran, title: document.title, host: location.host};
}
"""
"""What of a payload has come to life in a page, whatever is within it."""


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    pytest.importorskip("marimo", reason="marimo is not installed")
    with opened() as found:
        yield found


def hostile_scene(text: str) -> br.Scene:
    """A scene with a text wherever one may stand: names of loads and so on have letters, digits, _ and - alone."""
    scene = br.bearing("6205", radial_load=1000.0, speed_rpm=1800.0)
    for part in ("loads", "probes"):
        with pytest.raises(br.SceneError, match="name of letters, digits"):
            scene.replace({part: {text: next(iter(getattr(scene, part).values()))}})
    return scene.replace({"name": text})


def hostile_record(folder: Path, text: str) -> Path:
    """A record with a text as the name of its column, its unit and its file."""
    path = folder / (text.replace("/", "").replace("\0", "")[:80] + ".csv")
    noise = np.random.default_rng(1).normal(size=20_000)
    quoted = text.replace('"', '""')
    lines = [f'"{quoted} [{quoted[:20]}]"', *(f"{each:.6g}" for each in noise)]
    path.write_text("\n".join(lines), encoding="utf-8")
    return path


@contextmanager
def shown(browser: Browser, url: str) -> Iterator[tuple[Any, Seen]]:
    """Show the page, and see to it that nothing in it comes to life."""
    with browser.blank(1400, height=1000, offline=False) as (page, seen):
        page.set_default_timeout(PATIENCE)
        page.goto(url)
        page.wait_for_selector(".pictures svg")
        yield page, seen
        page.wait_for_timeout(300)
        alive = page.evaluate(ALIVE)
        assert (alive["found"], alive["ran"], alive["title"]) == ([], None, "ballrace explore")
        asked = {url.split("/")[2].split(":")[0] for url in seen.requests if "://" in url}
        assert asked == {"127.0.0.1"}
        # The policy was not even needed.
        assert [line for line in seen.console if "ontent Security Policy" in line] == []


def visited(browser: Browser, folder: Path, text: str, *, runs: bool) -> None:
    """Bring a text to every place of the page."""
    given = folder / "a.toml"
    given.write_text(hostile_scene(text).to_toml(), encoding="utf-8")
    with served(given) as at, shown(browser, at.url) as (page, _):
        page.wait_for_selector("text=/9 balls of 7.94 mm/")
        page.locator("input[type=file]").first.set_input_files(hostile_record(folder, text))
        # It has no sampling rate, and says so with its name.
        page.wait_for_selector(".refused >> text=/fs = /")
        field = page.locator("marimo-number", has_text="its sampling rate").locator("input")
        field.fill("20000")
        field.press("Enter")
        page.wait_for_selector(".facts.verdict")
        if runs:
            page.get_by_role("button", name="Run", exact=True).click()
            page.wait_for_selector("audio", state="attached")
            page.locator(".main-svg:first-child").nth(2).wait_for()
        page.locator("input[type=file]").first.set_input_files(
            {"name": f"{text}.mat".replace("/", ""), "mimeType": "", "buffer": b"no record"}
        )
        page.wait_for_selector(".refused >> text=/mat/")
        page.locator("marimo-dropdown", has_text="bearing").first.locator("select").select_option(
            label="by the name on its box"
        )
        field = page.locator("marimo-text input")
        field.fill(text)
        field.press("Enter")
        page.wait_for_selector(".refused >> text=/designation/")


def test_all_at_once(browser: Browser, tmp_path: Path) -> None:
    visited(browser, tmp_path, " ".join(PAYLOADS.values()), runs=False)


@pytest.mark.long
@pytest.mark.parametrize("payload", PAYLOADS)
def test_each_at_every_place(browser: Browser, tmp_path: Path, payload: str) -> None:
    visited(browser, tmp_path, PAYLOADS[payload], runs=True)


@contextmanager
def other_host() -> Iterator[tuple[str, list[str]]]:
    """Give the address of another origin, and what it is asked for."""
    asked: list[str] = []

    class Asked(BaseHTTPRequestHandler):
        def do_GET(self) -> None:
            asked.append(self.path)
            self.send_error(404)

        def log_message(self, *args: object) -> None:
            del args

    with ThreadingHTTPServer(("127.0.0.1", 0), Asked) as server:
        thread = threading.Thread(target=server.serve_forever)
        thread.start()
        try:
            yield f"http://127.0.0.1:{server.server_port}", asked
        finally:
            server.shutdown()
            thread.join()


INSERTED = """
markup => {
  document.body.insertAdjacentHTML('beforeend', markup);
  const one = document.createElement('script');
  one.textContent = 'window.ran = 2';
  document.body.append(one);
}
"""


@pytest.mark.long
def test_the_policy_stops_what_came_into_the_page(browser: Browser, tmp_path: Path) -> None:
    """Put there by hand: handlers, frames with scripts, pictures and scripts of other hosts.

    And the file's own name is one that marimo could take for a pair.
    """
    given = tmp_path / "load=5.toml"
    given.write_text(br.bearing("6309", speed_rpm=1800.0).to_toml(), encoding="utf-8")
    with (
        served(given) as at,
        other_host() as (host, asked),
        browser.blank(1400, height=1000, offline=False) as (page, seen),
    ):
        page.set_default_timeout(PATIENCE)
        page.goto(at.url)
        page.wait_for_selector("text=/6309: 8 balls/")
        for name, payload in PAYLOADS.items():
            if name != "refresh":  # no policy stops that one: it must not come into the page
                page.evaluate(INSERTED, payload.replace(EVIL, host))
        page.wait_for_timeout(1000)
        assert page.evaluate("window.ran") is None
        assert asked == []
        assert any("ontent Security Policy" in line for line in seen.console)
        # Nor is it shown in a frame of another page.
        page.goto(host)
        page.set_content(f"<iframe src='{at.url}'></iframe>")
        page.wait_for_timeout(1000)
        (frame,) = page.frames[1:]
        assert frame.locator(".marimo-cell").count() == 0
        assert any("frame-ancestors" in line or "X-Frame-Options" in line for line in seen.console)
