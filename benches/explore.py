"""How fast the page of `ballrace explore` answers a change of load.

    python benches/explore.py [--page]

By bearing: from settings to drawings and table, without a browser, median and longest of 50 changes, and the
processor's time of them. With --page (extras app and test, Chromium) also in a browser: from the press of an arrow
key on the slider of the load until the table has the new number.
"""

from __future__ import annotations

import argparse
import os
import shutil
import statistics
import time

import ballrace as br
from ballrace.explore.live import solved
from ballrace.explore.numbers import page as table
from ballrace.explore.picture import pictures
from ballrace.explore.served import served
from ballrace.explore.settings import Settings

CHANGES = 50
WATCH = """() => {
  window.took = []; window.pressed = null;
  const load = () => [...document.querySelectorAll('.facts td')].find(e => e.textContent === 'largest load')
    ?.nextSibling.textContent;
  let last = load();
  addEventListener('keydown', () => { window.pressed = performance.now() }, true);
  new MutationObserver(() => {
    const now = load();
    if (now && now !== last && window.pressed !== null) {
      last = now; window.took.push(performance.now() - window.pressed); window.pressed = null;
    }
  }).observe(document.body, {subtree: true, childList: true, characterData: true});
}"""


def main() -> None:
    """Print what it measured."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--page", action="store_true", help="in a browser, too")
    options = parser.parse_args()
    print(f"load of the machine: {os.getloadavg()[0]:.1f}")
    scenes = [br.bearing(name, speed_rpm=1800.0) for name in ("6205", "6316", "7208B", "3206")]
    for scene in [*scenes, br.presets.wheel_bearing(), br.presets.motor()]:
        print(f"{scene.name:20}", times_in_words(*computed(scene)))
    if options.page:
        print(f"{'page, 6205':20}", times_in_words(shown()))


def times_in_words(took: list[float], cpu: float | None = None) -> str:
    """Return median and longest [ms], and the mean time of the processor."""
    text = f"median {1e3 * statistics.median(took):.0f} ms, longest {1e3 * max(took):.0f} ms"
    return text if cpu is None else f"{text}, processor {1e3 * cpu:.0f} ms"


def computed(scene: br.Scene) -> tuple[list[float], float]:
    """Return what changes took, and the processor's time of one [s]."""
    begun = Settings.of(scene).moved(oil="vg68", damage="spall")
    load = begun.radial_load or 100.0
    took, before = [], 0.0
    for change in range(CHANGES + 1):
        started = time.perf_counter()
        live = solved(begun.moved(radial_load=load * (1.0 + 1e-3 * change)).scene())
        _ = pictures(live) + table(live)
        took.append(time.perf_counter() - started)
        before = before or time.process_time()
    # The first loads tables.
    return took[1:], (time.process_time() - before) / CHANGES


def shown() -> list[float]:
    """Return what changes took on the page [s]."""
    from playwright.sync_api import sync_playwright

    program = shutil.which("chromium") or shutil.which("google-chrome")
    with served() as at, sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=program, args=["--no-sandbox"])
        page = browser.new_page(viewport={"width": 1400, "height": 900})
        page.goto(at.url)
        page.wait_for_selector(".facts table", timeout=60_000)
        page.locator("marimo-dropdown", has_text="damage").first.locator("select").select_option(
            label="spall"
        )
        page.wait_for_selector("rect.damage", timeout=60_000)
        page.wait_for_timeout(1000)
        page.evaluate(WATCH)
        page.get_by_role("slider").first.focus()
        for _ in range(CHANGES):
            page.keyboard.press("ArrowRight")
            page.wait_for_timeout(400)
        took = [1e-3 * each for each in page.evaluate("window.took")]
        browser.close()
    return took


if __name__ == "__main__":
    main()
