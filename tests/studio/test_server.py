"""The server: who gets in, what it hands out, what it refuses; and that it ends."""

import json
import os
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
import pytest

import shapespline as ss
from shapespline.studio.documents import MOST_BYTES, opened, safe_name
from shapespline.studio.messages import packed, unpacked
from shapespline.studio.server import application

client = pytest.importorskip("starlette.testclient", exc_type=ImportError)

PLACE = "127.0.0.1:8000"
HERE = {"host": PLACE}
# Seconds without a message after which a server says nothing any more.
SILENCE = 60


@pytest.fixture
def app():
    return application("token", PLACE)


@pytest.fixture
def http(app):
    with client.TestClient(app, base_url=f"http://{PLACE}") as made:
        yield made


def test_only_the_address_with_the_token_leads_to_the_page(http):
    page = http.get("/token/")
    assert page.status_code == 200
    assert "<canvas" in page.text
    for path in (
        "/",
        "/other/",
        "/token",
        "/tokem/main.js",
        "/token/../server.py",
        "/token/nope.js",
    ):
        assert http.get(path, follow_redirects=False).status_code in (307, 404), path
    assert http.get("/token/main.js").headers["content-type"].startswith("text/javascript")
    # A file of the package that is no part of the page is not handed out.
    assert http.get("/token/%2e%2e%2fserver.py").status_code == 404


def test_the_page_may_talk_to_this_server_only(http):
    headers = http.get("/token/").headers
    policy = headers["content-security-policy"]
    assert "default-src 'none'" in policy
    assert f"connect-src 'self' ws://{PLACE};" in policy
    assert "unsafe" not in policy
    assert headers["x-content-type-options"] == "nosniff"
    assert headers["referrer-policy"] == "no-referrer"


def test_other_hosts_and_origins_are_refused(http):
    assert http.get("/token/", headers={"host": "evil.example:8000"}).status_code == 403
    assert http.get("/token/", headers={"host": "127.0.0.1:9"}).status_code == 403
    assert http.get("/token/", headers={"origin": "http://evil.example"}).status_code == 403
    assert http.get("/token/", headers={"host": "localhost:8000"}).status_code == 200
    wrong = [
        {},
        {"origin": "http://evil.example"},
        {"origin": "null"},
        {"origin": "https://" + PLACE},
    ]
    for headers in wrong:
        with (
            pytest.raises(client.WebSocketDisconnect),
            http.websocket_connect("/token/socket", headers={**HERE, **headers}),
        ):
            pass


def test_a_socket_greets_and_answers_nonsense_with_a_sentence(http):
    with http.websocket_connect(
        "/token/socket", headers={**HERE, "origin": f"http://{PLACE}"}
    ) as socket:
        hello = unpacked(socket.receive_bytes())[0]
        assert hello["type"] == "hello"
        assert hello["most_bytes"] == MOST_BYTES
        socket.send_bytes(b"\xff\xff\xff\xffnonsense")
        said = unpacked(socket.receive_bytes())[0]
        assert said["type"] == "error"
        assert "message must begin with a header" in said["sentence"]


def test_names_of_a_client_lead_nowhere():
    names = {"../../etc/passwd": "passwd", "C:\\x\\y.svg": "y.svg", "": "_", "a\0b.csv": "a_b.csv"}
    assert {name: safe_name(name) for name in names} == names
    assert len(safe_name("x" * 500 + ".svg")) <= 80
    square = b"0,0\n1,0\n1,1\n0,1\n"
    before = set(Path(tempfile.gettempdir()).iterdir())
    assert opened("../../up.csv", square, {}).name == "up.csv"
    assert {p for p in Path(tempfile.gettempdir()).iterdir() if p.name.startswith("up")} <= before


@pytest.mark.parametrize(
    ("name", "content", "said"),
    [
        ("logo.exe", b"MZ", "no reader for this ending"),
        ("logo.png", b"no picture", "logo.png"),
        ("large.csv", bytes(MOST_BYTES + 1), "at most 64 MB, got 64"),
        ("empty.csv", b"", r"^cannot read empty\.csv: the file is empty$"),
    ],
)
def test_what_cannot_be_opened_is_said_in_the_programs_own_sentence(name, content, said):
    with pytest.raises(ss.ShapesplineError, match=said):
        opened(name, content, {})


def test_a_document_has_a_limit_of_points(monkeypatch):
    monkeypatch.setattr("shapespline.studio.documents.MOST_POINTS", 3)
    with pytest.raises(ss.InvalidInputError, match="and 3 points, got 1 and 4; leave out specks"):
        opened("square.csv", b"0,0\n1,0\n1,1\n0,1\n", {})


def test_options_of_reading_are_those_that_a_page_knows():
    with pytest.raises(ss.InvalidInputError, match="no option of reading"):
        opened("x.csv", b"0,0\n1,1\n2,0\n", {"path": "/etc/passwd"})


def test_a_port_that_is_taken_and_addresses_for_everybody_are_refused():
    import socket

    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        with pytest.raises(ss.InvalidInputError, match="take another port"):
            ss.open_studio(port=taken.getsockname()[1], browser=False)
    with pytest.raises(ss.InvalidInputError, match="one address of this machine"):
        ss.open_studio(host="0.0.0.0", browser=False)
    with pytest.raises(ss.InvalidInputError, match="no such file"):
        ss.open_studio("nowhere.png", browser=False)


def _long_reading(socket):
    t = np.linspace(0, 2 * np.pi, 300_000, endpoint=False)
    text = "".join(f"{x:.5f},{y:.5f}\n" for x, y in zip(np.cos(t), np.sin(5 * t), strict=True))
    socket.send(packed({"type": "open", "name": "a.csv", "generation": 1}) + text.encode())


def _long_fit(socket):
    socket.send(packed({"type": "example", "id": "scan", "generation": 1}))
    while unpacked(socket.recv(SILENCE))[0]["type"] != "shape":
        pass
    # A tenth of the noise: every point costs; the search would take its minute.
    settings = {"tolerance": 0.015, "effort": "smallest"}
    socket.send(packed({"type": "fit", "generation": 2, "settings": settings}))


@pytest.mark.slow
@pytest.mark.parametrize("begin", [_long_reading, _long_fit])
def test_ctrl_c_ends_it_cleanly_and_leaves_nothing_behind(tmp_path, begin):
    connect = pytest.importorskip("websockets.sync.client").connect
    source = Path(ss.__file__).parent.parent
    environment = {**os.environ, "PYTHONPATH": str(source), "TMPDIR": str(tmp_path)}
    with subprocess.Popen(
        [sys.executable, "-m", "shapespline", "studio", "--no-browser"],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=environment,
    ) as server:  # fmt: skip
        address = server.stdout.readline().split()[-1]
        assert address.startswith("http://127.0.0.1:")
        # The token has 24 random bytes.
        assert len(address.rstrip("/").rsplit("/", 1)[1]) == 32
        end = time.monotonic() + 10
        while not list(tmp_path.iterdir()) and time.monotonic() < end:
            time.sleep(0.02)
        # Everything temporary goes into one folder, which is deleted whatever was going on.
        assert [folder.name.partition("-")[0] for folder in tmp_path.iterdir()] == ["studio"]
        # A job that is under way does not hold it up, nor is its end an error.
        place = address.removeprefix("http://").partition("/")[0]
        with connect(address.replace("http", "ws") + "socket", origin=f"http://{place}") as socket:
            begin(socket)
            while unpacked(socket.recv(SILENCE))[0]["type"] != "progress":
                pass
            began = time.monotonic()
            server.send_signal(signal.SIGINT)
            code = server.wait(10)
        assert (code, server.stderr.read()) == (0, "")
    assert time.monotonic() - began < 5
    assert list(tmp_path.iterdir()) == []


def test_messages_hold_arrays_as_they_were():
    points = np.array([[0.5, 1.0], [2.0, -3.25]])
    header, rest = unpacked(packed({"type": "x", "word": "é"}, {"p": points, "k": np.arange(3)}))
    assert (header["type"], header["word"]) == ("x", "é")
    kind, shape, at = header["arrays"]["p"]
    assert (kind, shape) == ("f", [2, 2])
    assert np.frombuffer(rest, "<f4", 4, at).tolist() == points.ravel().tolist()
    kind, shape, at = header["arrays"]["k"]
    assert np.frombuffer(rest, "<i4", 3, at).tolist() == [0, 1, 2]
    json.dumps(header)
