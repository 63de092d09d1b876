"""The studio in a browser: how soon there is a picture, how a drag feels, how large the page is.

    python -m benchmarks.studio              # the figures of docs/studio.md
    python -m benchmarks.studio --soak       # 2 000 moves of the slider: memory, threads
    python -m benchmarks.studio --figures    # its pictures

Needs a browser: Debian's chromium or Playwright's.
"""

from __future__ import annotations

import io
import math
import os
import shutil
import signal
import subprocess
import sys
import time
from contextlib import contextmanager
from pathlib import Path
from statistics import median
from typing import TYPE_CHECKING, Any

import numpy as np
from PIL import Image, ImageDraw

import shapespline as ss

if TYPE_CHECKING:
    from collections.abc import Iterator

    from playwright.sync_api import Browser, Page

ROOT = Path(__file__).resolve().parent.parent
PAGE = ROOT / "src" / "shapespline" / "studio" / "page"
FIGURES = ROOT / "docs" / "figures"
PLANE = ROOT / "examples" / "data" / "outlines" / "plane1100_closed.csv"
LEAF = ROOT / "examples" / "data" / "paper" / "leaf840.csv"
NAMES = ("chromium", "chromium-browser", "google-chrome")
# Milliseconds from the address to the first fit on the screen.
SHOWN = "() => window.studio?.fitter.first"
# The whole is fitted, not only a draft of it.
DONE = (
    "() => Boolean(window.studio?.fitter.done && !studio.fitter.done.draft && !studio.fitter.busy)"
)
DRAGS = 240
FRAMES = """async () => {
  const began = performance.now();
  let n = 0;
  for (; performance.now() - began < 2000; n++) {
    studio.scene.view.pan(n % 40 < 20 ? 2 : -2, 0);
    studio.scene.paint();
    await new Promise(requestAnimationFrame);
  }
  return (1000 * n) / (performance.now() - began);
}"""
# Moves of the slider, the next as soon as the one before has shown a fit.
SOAK = """async (moves) => {
  const slider = document.querySelector("#tolerance");
  for (let k = 0; k < moves; k++) {
    slider.value = 560 + 120 * Math.sin(k / 9);
    slider.dispatchEvent(new Event("input"));
    while (studio.fitter.flying && !studio.fitter.flying.answered) {
      await new Promise((next) => setTimeout(next, 4));
    }
  }
  slider.dispatchEvent(new Event("change"));
}"""


def browser_path() -> str | None:
    """An installed browser, or Playwright's own."""
    for name in NAMES:
        if found := shutil.which(name):
            return found
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        own = playwright.chromium.executable_path
    return own if Path(own).exists() else None


@contextmanager
def served(*arguments: str) -> Iterator[tuple[str, subprocess.Popen[str]]]:
    """The address of a studio in a process of its own, and the process."""
    environment = {**os.environ, "PYTHONPATH": str(Path(ss.__file__).parent.parent)}
    command = [sys.executable, "-m", "shapespline", "studio", "--no-browser", *arguments]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=environment) as process:
        assert process.stdout is not None
        try:
            yield process.stdout.readline().split()[-1], process
        finally:
            process.send_signal(signal.SIGINT)
            process.wait(20)


@contextmanager
def browsing() -> Iterator[Browser]:
    """A browser without a window."""
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        arguments = ["--no-sandbox"] if hasattr(os, "geteuid") and os.geteuid() == 0 else []
        browser = playwright.chromium.launch(executable_path=browser_path(), args=arguments)
        yield browser
        browser.close()


def until(page: Page, expression: str, seconds: float = 20.0) -> None:
    """Wait until an expression is true; the page's policy forbids the waiting of Playwright."""
    end = time.monotonic() + seconds
    while not page.evaluate(expression):
        if time.monotonic() > end:
            raise TimeoutError(f"{expression}; the page says: {page.inner_text('footer')}")
        page.wait_for_timeout(15)
    painted(page)


def painted(page: Page) -> None:
    """Wait for the frame that shows what the page knows: its sentences are written once a frame."""
    page.evaluate("() => new Promise(requestAnimationFrame)")


def opened(browser: Browser, address: str, **options: Any) -> Page:
    """A page of its own that has shown a whole fit."""
    options = {"viewport": {"width": 1280, "height": 800}, **options}
    page = browser.new_context(**options).new_page()
    page.goto(address)
    until(page, DONE)
    return page


def give(page: Page, name: str, content: bytes) -> None:
    """Open a file in the page, and wait until it is fitted."""
    page.set_input_files("#file", {"name": name, "mimeType": "text/plain", "buffer": content})
    until(page, f"() => studio.scene.shape?.name === {name!r}", 60)
    until(page, DONE, 120)


def dragged(page: Page, moves: int = DRAGS) -> list[float]:
    """Milliseconds from asking to a verified fit on the screen, while the slider is dragged."""
    page.evaluate("studio.fitter.times.length = 0")
    box = page.locator("#tolerance").bounding_box()
    assert box is not None
    y = box["y"] + 0.5 * box["height"]
    # From a part in 4000 to a part in 40 of the size, and back.
    at = [box["x"] + box["width"] * (0.68 - 0.2 * math.cos(k / 19)) for k in range(moves)]
    page.mouse.move(at[0], y)
    page.mouse.down()
    for x in at:
        page.mouse.move(x, y)
        page.wait_for_timeout(16)
    page.mouse.up()
    until(page, DONE)
    return sorted(page.evaluate("studio.fitter.times"))


def logo(side: int) -> bytes:
    """A picture with letters and rings, so large."""
    side *= 2
    picture = Image.new("L", (side, side), 255)
    draw = ImageDraw.Draw(picture)
    for k in range(6):
        x, y = side * (0.2 + 0.3 * (k % 3)), side * (0.3 + 0.4 * (k // 3))
        r = 0.12 * side
        draw.ellipse([x - r, y - r, x + r, y + r], fill=0)
        draw.regular_polygon((x, y, 0.6 * r), 3 + k, fill=255)
    content = io.BytesIO()
    # Drawn twice as large, so that edges cover parts of pixels.
    picture.reduce(2).save(content, "PNG")
    return content.getvalue()


def frames_per_second(page: Page) -> float:
    """Frames that the browser shows of all layers while the drawing is moved; it stops at 60."""
    return page.evaluate(FRAMES)


def measure() -> None:
    """Print what the page reaches."""
    n_bytes = sum(file.stat().st_size for file in PAGE.iterdir())
    print(f"page and modules: {n_bytes / 1000:.0f} kB")
    with served() as (address, _), browsing() as browser:
        time.sleep(1.0)
        pictures = []
        for _ in range(5):
            page = browser.new_page(viewport={"width": 1280, "height": 800})
            page.goto(address)
            until(page, SHOWN)
            pictures.append(page.evaluate(SHOWN) / 1000)
            page.close()
        print(f"first picture with a fit: {median(pictures):.2f} s, largest {max(pictures):.2f} s")
        page = opened(browser, address)
        give(page, "plane.csv", PLANE.read_bytes())
        times = dragged(page)
        print(
            f"drag, 1 100 points: {len(times)} fits, median {median(times):.0f} ms, 95th percentile"
            f" {times[int(0.95 * len(times))]:.0f} ms, largest {times[-1]:.0f} ms"
        )
        # Every point a corner, every side a line.
        t = np.linspace(0, 2 * np.pi, 5000, endpoint=False)
        r = 100 + 5 * (-1.0) ** np.arange(5000)
        give(page, "many.csv", _table(np.column_stack([r * np.cos(t), r * np.sin(t)])))
        n_pieces = page.evaluate("studio.fitter.fits[0].kinds.length")
        shown = frames_per_second(page)
        print(f"5 000 points and {n_pieces} pieces: {shown:.0f} frames a second")
        t = np.linspace(0, 2 * np.pi, 1_000_000, endpoint=False)
        r = 100 + 20 * np.cos(5 * t) + 3 * np.sin(31 * t)
        began = time.monotonic()
        give(page, "million.csv", _table(np.column_stack([r * np.cos(t), r * np.sin(t)])))
        seconds, shown = time.monotonic() - began, frames_per_second(page)
        print(
            f"1 000 000 points: opened and fitted in {seconds:.1f} s, {shown:.0f} frames a second"
        )
        content = logo(4000)
        began = time.monotonic()
        page.set_input_files("#file", {"name": "l.png", "mimeType": "", "buffer": content})
        until(page, "() => studio.scene.shape?.name === 'l.png'", 60)
        traced = time.monotonic() - began
        until(page, "() => studio.fitter.fits.filter(Boolean).length === 12", 60)
        drafted = time.monotonic() - began
        until(page, DONE, 60)
        print(
            f"4000 x 4000 logo: traced in {traced:.1f} s, all outlines with a verified draft after"
            f" {drafted:.1f} s, fitted after {time.monotonic() - began:.1f} s"
        )


def soak(browser: Browser, moves: int = 2000) -> dict[str, list[float]]:
    """Memory and threads of the program, memory of the page, at every quarter of many moves."""
    told: dict[str, list[float]] = {"program, MB": [], "threads": [], "page, MB": []}
    with served() as (address, process):
        page = opened(browser, address)
        give(page, "plane.csv", PLANE.read_bytes())
        tools = page.context.new_cdp_session(page)
        for quarter in range(5):
            if quarter:
                page.evaluate(SOAK, moves // 4)
                until(page, DONE, 60)
            tools.send("HeapProfiler.collectGarbage")
            heap = tools.send("Runtime.getHeapUsage")["usedSize"]
            status = Path(f"/proc/{process.pid}/status").read_text()
            said = dict(line.split(":\t") for line in status.splitlines() if ":\t" in line)
            told["program, MB"].append(round(int(said["VmRSS"].split()[0]) / 1000, 1))
            told["threads"].append(int(said["Threads"]))
            told["page, MB"].append(round(heap / 1e6, 1))
        page.context.close()
    for name, values in told.items():
        print(f"{name} after 0 to {moves} moves: {', '.join(f'{value:g}' for value in values)}")
    return told


def _table(points: np.ndarray) -> bytes:
    content = io.StringIO()
    np.savetxt(content, points, fmt="%.7g", delimiter=",")
    return content.getvalue().encode()


def figures() -> None:
    """The pictures of docs/studio.md."""
    with served() as (address, _), browsing() as browser:
        page = opened(browser, address, viewport={"width": 1240, "height": 760})
        page.click("#hints-away")
        page.check("#layer-error")
        page.wait_for_timeout(200)
        _saved(page, "studio.png")
        page.uncheck("#layer-error")
        give(page, "leaf.csv", LEAF.read_bytes())
        page.click("#paper")
        until(page, "() => Object.keys(studio.paper.films).length > 0")
        page.evaluate("studio.paper.turnTo(0)")
        page.wait_for_timeout(200)
        _saved(page, "studio-paper.png")


def _saved(page: Page, name: str) -> None:
    """A screenshot with few colours, which is small."""
    picture = Image.open(io.BytesIO(page.screenshot())).convert("RGB")
    few = picture.quantize(200, Image.Quantize.FASTOCTREE, dither=Image.Dither.NONE)
    few.save(FIGURES / name, optimize=True)
    print(f"docs/figures/{name}: {(FIGURES / name).stat().st_size / 1000:.0f} kB")


if __name__ == "__main__":
    if "--figures" in sys.argv[1:]:
        figures()
    elif "--soak" in sys.argv[1:]:
        with browsing() as browser:
            soak(browser)
    else:
        measure()
