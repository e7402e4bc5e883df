"""Takes the picture of ``ballrace explore``: ``python docs/figures/explore.py`` (extras ``app`` and ``test``)."""

from __future__ import annotations

import base64
import shutil
from pathlib import Path

from playwright.sync_api import sync_playwright

from ballrace.explore.served import served

PICTURE = Path(__file__).with_suffix(".webp")
WEBP = """async png => {
  const image = new Image();
  image.src = "data:image/png;base64," + png;
  await image.decode();
  const canvas = Object.assign(document.createElement("canvas"), {width: image.width, height: image.height});
  canvas.getContext("2d").drawImage(image, 0, 0);
  return canvas.toDataURL("image/webp", 0.9).split(",")[1];
}"""


def draw() -> None:
    """Set a damage and an oil, and take the picture."""
    program = shutil.which("chromium") or shutil.which("google-chrome")
    with served() as at, sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=program, args=["--no-sandbox"])
        page = browser.new_page(viewport={"width": 1400, "height": 900})
        page.goto(at.url)
        page.wait_for_selector(".facts table", timeout=60_000)
        for label, option in (("oil", "vg68"), ("damage", "spall")):
            choice = page.locator("marimo-dropdown", has_text=label).first
            choice.locator("select").select_option(label=option)
        page.wait_for_selector("rect.damage", timeout=60_000)
        page.wait_for_selector("text=/A run of .* takes some/", timeout=60_000)
        png = base64.b64encode(page.screenshot()).decode()
        PICTURE.write_bytes(base64.b64decode(page.evaluate(WEBP, png)))
        browser.close()


if __name__ == "__main__":
    draw()
