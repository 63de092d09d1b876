"""A studio in a process of its own and a browser, both once for all tests that need them."""

import os
import socket

import pytest


@pytest.fixture(scope="session")
def browser():
    pytest.importorskip("playwright", exc_type=ImportError)
    from benchmarks.studio import browser_path, browsing

    if browser_path() is None:
        # One who may install a browser has to; on other machines these tests are left out.
        if os.environ.get("CI") and getattr(os, "geteuid", int)() == 0:
            pytest.fail("CI needs a browser: run sh scripts/browser.sh python")
        pytest.skip("there is no browser: sh scripts/browser.sh python looks for one")
    with browsing() as found:
        yield found


@pytest.fixture(scope="session")
def address():
    from benchmarks.studio import served

    with served() as (found, _):
        yield found


@pytest.fixture
def page(browser, address):
    """A page with the first example; nothing may go wrong in it unseen."""
    from benchmarks.studio import opened

    errors = []
    made = opened(browser, address, accept_downloads=True)
    made.on("pageerror", lambda error: errors.append(str(error)))
    made.on("console", lambda said: said.type == "error" and errors.append(said.text))
    yield made
    made.context.close()
    assert not errors


@pytest.fixture
def free_port():
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        return taken.getsockname()[1]
