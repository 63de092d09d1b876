"""The page in a browser: files come in, files go out, the program goes and comes back."""

import io
import json
import subprocess
import sys
import time

import pytest
from benchmarks.studio import DONE, give, opened, until
from tests.support.studio_page import LEAF, SQUARE, dropped, example, own, place_of_node, text

import shapespline as ss
from shapespline.formats import readable
from shapespline.studio.documents import MOST_BYTES

pytestmark = pytest.mark.slow


def test_files_are_dropped_pasted_and_refused(page):
    dropped(page, "square.csv", SQUARE)
    until(page, "() => studio.scene.shape.name === 'square.csv'")
    until(page, DONE)
    page.evaluate(
        'studio.files.takeText(\'<svg viewBox="0 0 9 9"><circle cx="4" cy="4" r="3"/></svg>\')'
    )
    until(page, "() => studio.scene.shape.name === 'pasted.svg'")
    until(page, DONE)
    before = text(page)
    for name, content, said in [
        ("program.exe", b"MZ", "no reader for this ending"),
        ("broken.png", b"no picture", "roken.png"),
        ("line.csv", b"1,1\n1,1\n", "ine.csv"),
    ]:
        dropped(page, name, content)
        until(page, f"() => document.querySelector('#trouble').innerText.includes({said!r})")
    page.evaluate(f"studio.files.take({{name: 'large.png', size: {MOST_BYTES + 1}}})")
    assert "at most 64 MB" in page.inner_text("#trouble")
    # What was open stays.
    assert text(page) == before
    example(page, "loop")
    assert not page.is_visible("#trouble")


def test_a_picture_is_read_again_with_other_options(page):
    page.fill("#p-specks", "3000")
    page.press("#p-specks", "Enter")
    until(page, "() => studio.scene.shape.outlines.length < 8")
    until(page, DONE)
    page.evaluate("studio.picture.cropTo([[-240, 240], [0, -240]])")
    until(page, "() => studio.scene.shape.options.crop === '0,0,240,480'")
    until(page, DONE)
    page.fill("#p-width", "120")
    page.press("#p-width", "Enter")
    until(page, "() => studio.scene.shape.unit === 'mm'")
    until(page, DONE)
    assert page.evaluate("studio.store.now.tolerance") == pytest.approx(0.125)
    for _ in range(3):
        page.click("#undo")
    until(
        page, "() => studio.scene.shape.outlines.length === 8 && studio.scene.shape.unit === 'px'"
    )
    until(page, DONE)


def test_every_format_is_written_and_read_back(page):
    example(page, "plate")
    fits = page.evaluate("studio.fitter.fits.length")
    for ending in page.evaluate("[...document.querySelector('#format').options].map(o => o.value)"):
        page.click("#export")
        page.select_option("#format", ending)
        if ending == ".dxf":
            page.check("#out-arcs")
        with page.expect_download() as download:
            page.click("#export-go")
        content = download.value.path().read_bytes()
        assert download.value.suggested_filename == f"plate_fit{ending}"
        if ending == ".py":
            compile(content, "plate", "exec")
        elif ending not in readable():
            assert len(content) > 200, ending
        else:
            back = ss.read(io.BytesIO(content), format=ending)
            # The plate is drawn in lines: in a picture they have two sides.
            assert len(back) == (2 * fits if ending == ".png" else fits), ending
    for kind, word in [("python", "ss.fit_shape("), ("command", "shapespline fit plate.svg"),
                       ("toml", "version = 1"), ("svg", "<svg")]:  # fmt: skip
        page.click("#copy")
        page.click(f"#copy-{kind}")
        until(page, f"() => document.querySelector('#copied').value.includes({word!r})")
        page.keyboard.press("Escape")


def test_a_session_is_saved_and_opened_again(page):
    example(page, LEAF)
    page.mouse.click(*place_of_node(page, 3)[:2])
    until(page, DONE)
    before, state = text(page), own(page)
    page.click("#copy")
    with page.expect_download() as download:
        page.click("#copy-session")
    page.keyboard.press("Escape")
    content = download.value.path().read_bytes()
    assert json.loads(content)["shapespline_studio"] == 1
    example(page, "loop")
    page.set_input_files(
        "#file", {"name": "scan.studio.json", "mimeType": "text/plain", "buffer": content}
    )
    until(page, "() => studio.scene.shape.name === 'scan.csv'")
    until(page, DONE)
    assert (text(page), own(page)) == (before, state)


def test_two_pages_know_nothing_of_each_other(page, browser, address):
    other = opened(browser, address)
    give(other, "square.csv", SQUARE)
    assert page.evaluate("studio.scene.shape.name") == "gear.png"
    page.fill("#tolerance-number", "2")
    page.press("#tolerance-number", "Enter")
    until(page, DONE)
    assert other.evaluate("studio.scene.shape.name") == "square.csv"
    other.context.close()


SERVER = """
import sys, uvicorn
from shapespline.studio.server import application
place = f"127.0.0.1:{sys.argv[1]}"
print("up", flush=True)
uvicorn.run(application("token", place), port=int(sys.argv[1]), log_level="error",
            ws="websockets-sansio", timeout_graceful_shutdown=1)
"""


def test_the_page_waits_for_a_program_that_is_gone_and_goes_on(browser, free_port):
    def start():
        return subprocess.Popen([sys.executable, "-c", SERVER, str(free_port)])

    server = start()
    try:
        page = browser.new_page()
        for _ in range(100):
            try:
                page.goto(f"http://127.0.0.1:{free_port}/token/")
                break
            except Exception:
                time.sleep(0.1)
        until(page, DONE)
        give(page, "square.csv", SQUARE)
        page.fill("#tolerance-number", "0.01")
        page.press("#tolerance-number", "Enter")
        until(page, DONE)
        server.terminate()
        server.wait(10)
        until(page, "() => document.querySelector('#trouble').textContent.includes('not answer')")
        server = start()
        until(page, "() => !document.querySelector('#trouble').textContent", 20)
        until(page, DONE)
        assert page.evaluate("[studio.scene.shape.name, studio.store.now.tolerance]") == [
            "square.csv",
            0.01,
        ]
    finally:
        server.terminate()
        server.wait(10)
