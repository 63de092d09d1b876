"""Server: one page on this machine, for whoever has its address.

A token stands in the path of every address, so that no other page and no other user of the machine
finds the studio; Host and Origin are checked, so that no name on the network leads here and no
other page talks to it. Nothing is written but temporary files that are gone when a job ends.
"""

from __future__ import annotations

import asyncio
import contextlib
import ipaddress
import secrets
import socket
import sys
import tempfile
import threading
import webbrowser
from pathlib import Path
from time import monotonic
from typing import TYPE_CHECKING, Any

from shapespline.errors import InvalidInputError, require
from shapespline.studio.asked import Asked
from shapespline.studio.documents import MOST_BYTES, Document, opened, opened_example
from shapespline.studio.examples import EXAMPLES
from shapespline.studio.fits import fitted
from shapespline.studio.jobs import Ticket
from shapespline.studio.reading import Readers
from shapespline.studio.session import Session
from shapespline.studio.sketch import sketch

if TYPE_CHECKING:
    import os
    from collections.abc import Callable, Iterator

    from starlette.applications import Starlette
    from starlette.types import ASGIApp, Receive, Scope, Send
    from starlette.websockets import WebSocket

PAGE = Path(__file__).parent / "page"
# Headers and settings beside the file.
MOST_MESSAGE = MOST_BYTES + 5_000_000
MOST_SESSIONS = 16
# A fit that is in Python lets the thread of the messages in after so many seconds (STU-04).
SWITCH_SECONDS = 0.001
# Messages that wait for a slow page; more, and it is told goodbye: it comes back by itself.
MOST_WAITING = 4000
POLICY = (
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:;"
    " connect-src 'self' ws://{host}; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
)
# Seconds that jobs have to end in at the end (STU-07).
MOST_ENDING = 4.0
KINDS = {
    ".html": "text/html",
    ".js": "text/javascript",
    ".css": "text/css",
    ".svg": "image/svg+xml",
}
LOCAL = "localhost"


def open_studio(
    path: str | os.PathLike[str] | None = None,
    *,
    port: int = 0,
    host: str = "127.0.0.1",
    browser: bool = True,
    announce: Callable[[str], object] | None = None,
) -> None:
    """Open a local page that shows fits while one steers them; returns after Ctrl-C.

    Parameters
    ----------
    path : path-like, optional
        A file to begin with: a picture, an outline, a drawing.
    port : int
        0 takes a free one.
    host : str
        The address to listen at; another than this machine's own makes the page reachable for
        others who know the token.
    browser : bool
        Whether to open the page in the browser.
    announce : callable, optional
        Called with the address of the page as soon as it is listened at.

    Raises
    ------
    MissingExtraError
        If starlette and uvicorn are not installed.
    InvalidInputError, FormatError
        If the file cannot be read, or there is no listening at the address.

    Examples
    --------
    >>> open_studio(port=70000)
    Traceback (most recent call last):
    ...
    shapespline.errors.InvalidInputError: port must be a number from 0 to 65535, got 70000
    """
    if not (isinstance(port, int) and 0 <= port <= 65535):
        raise InvalidInputError(f"port must be a number from 0 to 65535, got {port!r}")
    uvicorn = _uvicorn()
    first = None if path is None else _from_path(Path(path))
    listening = _listening(host, port)
    token = secrets.token_urlsafe(24)
    shown = f"[{host}]" if ":" in host else host
    place = f"{shown}:{listening.getsockname()[1]}"
    address = f"http://{place}/{token}/"
    server = uvicorn.Server(
        uvicorn.Config(
            application(token, place, first),
            log_level="warning",
            access_log=False,
            ws="websockets-sansio",
            ws_max_size=MOST_MESSAGE,
            proxy_headers=False,
            server_header=False,
            timeout_graceful_shutdown=1,
        )
    )
    if announce is not None:
        announce(address)
    before = sys.getswitchinterval()
    sys.setswitchinterval(SWITCH_SECONDS)
    threading.Thread(target=_warm, name="studio-warm", daemon=True).start()
    if browser:
        threading.Timer(0.3, webbrowser.open, [address]).start()
    try:
        with _own_temporary_folder(), listening:
            with contextlib.suppress(KeyboardInterrupt):
                server.run(sockets=[listening])
            with contextlib.suppress(KeyboardInterrupt):
                _wait_for_threads()
    finally:
        sys.setswitchinterval(before)


def _wait_for_threads() -> None:
    """Let jobs that were told to end do so: a thread cut off in the kernel ends the program ill."""
    end = monotonic() + MOST_ENDING
    for thread in threading.enumerate():
        if thread.name.startswith("studio-"):
            thread.join(max(0.0, end - monotonic()))


@contextlib.contextmanager
def _own_temporary_folder() -> Iterator[None]:
    """Temporary files go where they are deleted at the end, even if a job is cut off."""
    before = tempfile.tempdir
    with tempfile.TemporaryDirectory(prefix="studio-", ignore_cleanup_errors=True) as folder:
        tempfile.tempdir = folder
        try:
            yield
        finally:
            tempfile.tempdir = before


def application(token: str, place: str, first: Document | None = None) -> Starlette:
    """The application: the page, its modules and its WebSocket, behind a guard."""
    from starlette.applications import Starlette
    from starlette.responses import Response
    from starlette.routing import Route, WebSocketRoute

    pages = {file.name: file for file in PAGE.iterdir() if file.suffix in KINDS}
    sessions: set[Session] = set()
    readers = Readers()

    async def page(request: Any) -> Response:
        name = request.path_params.get("name") or "index.html"
        if name not in pages:
            return Response(status_code=404)
        file = pages[name]
        return Response(file.read_bytes(), media_type=KINDS[file.suffix])

    async def talk(websocket: WebSocket) -> None:
        await _talk(websocket, sessions, readers, first)

    @contextlib.asynccontextmanager
    async def lifespan(_: Starlette) -> Any:
        yield
        for session in list(sessions):
            session.close()
        readers.close()

    routes = [
        WebSocketRoute(f"/{token}/socket", talk),
        Route(f"/{token}/", page),
        Route(f"/{token}/{{name}}", page),
    ]
    app = Starlette(routes=routes, lifespan=lifespan)
    app.add_middleware(Guard, place=place)
    return app


class Guard:
    """Refuses what does not come from this page at this address; says what the page may do."""

    def __init__(self, app: ASGIApp, place: str) -> None:
        self._app = app
        port = place.rpartition(":")[2]
        loopback = ("127.0.0.1", LOCAL, "[::1]")
        names = {place, *(f"{name}:{port}" for name in loopback)} if _is_local(place) else {place}
        self._hosts = {name.encode() for name in names}
        self._origins = {f"http://{name}".encode() for name in names}
        policy = POLICY.format(host=place)
        self._headers = [
            (b"content-security-policy", policy.encode()),
            (b"x-content-type-options", b"nosniff"),
            (b"referrer-policy", b"no-referrer"),
            (b"cross-origin-opener-policy", b"same-origin"),
            (b"cross-origin-resource-policy", b"same-origin"),
            (b"cache-control", b"no-store"),
        ]

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass on what is allowed."""
        if scope["type"] == "lifespan":
            await self._app(scope, receive, send)
            return
        headers = dict(scope["headers"])
        origin = headers.get(b"origin")
        is_socket = scope["type"] == "websocket"
        allowed = headers.get(b"host") in self._hosts and (
            origin in self._origins or (origin is None and not is_socket)
        )
        if not allowed:
            await _refuse(scope, receive, send)
            return

        async def with_headers(message: Any) -> None:
            if message["type"] == "http.response.start":
                message["headers"] = [*message.get("headers", ()), *self._headers]
            await send(message)

        await self._app(scope, receive, with_headers)


async def _refuse(scope: Scope, receive: Receive, send: Send) -> None:
    if scope["type"] == "websocket":
        await receive()
        await send({"type": "websocket.close", "code": 1008})
        return
    await send({"type": "http.response.start", "status": 403, "headers": []})
    await send({"type": "http.response.body", "body": b"not from here\n"})


async def _talk(
    websocket: WebSocket, sessions: set[Session], readers: Readers, first: Document | None
) -> None:
    """One page: hear it until it goes."""
    from starlette.websockets import WebSocketDisconnect

    await websocket.accept()
    if len(sessions) >= MOST_SESSIONS:
        await websocket.close(1013, "too many pages are open; close one")
        return
    loop = asyncio.get_running_loop()
    waiting: asyncio.Queue[bytes] = asyncio.Queue()

    def send(message: bytes) -> None:
        with contextlib.suppress(RuntimeError):  # the loop has ended
            loop.call_soon_threadsafe(waiting.put_nowait, message)

    async def pour() -> None:
        while True:
            message = await waiting.get()
            if waiting.qsize() > MOST_WAITING:
                await websocket.close(1013, "the page does not keep up")
                return
            await websocket.send_bytes(message)

    session = Session(send, readers, first)
    sessions.add(session)
    pouring = asyncio.create_task(pour())
    try:
        session.greet()
        while True:
            session.hear(await websocket.receive_bytes())
    except (WebSocketDisconnect, KeyError, RuntimeError):
        pass
    finally:
        pouring.cancel()
        sessions.discard(session)
        session.close()


def _warm() -> None:
    """Load what the first picture needs while the browser starts."""
    name = next(iter(EXAMPLES))
    document = opened_example(name)
    asked = Asked(document, {"tolerance": EXAMPLES[name].tolerance})
    sketch(fitted(asked, len(document.shape) - 1, Ticket(0), draft=True), document.origin)


def _from_path(path: Path) -> Document:
    """The document that the program is started with: the only path ever read."""
    if not path.is_file():
        raise InvalidInputError(f"cannot open {path}: there is no such file")
    return opened(path.name, path.read_bytes(), {})


def _listening(host: str, port: int) -> socket.socket:
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    if host in ("", "0.0.0.0", "::"):
        raise InvalidInputError(
            f"host must be one address of this machine, got {host!r}; name it, so that it can be"
            " checked"
        )
    found = socket.socket(family)
    found.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        found.bind((host, port))
        # From here on a browser is not turned away: it waits for the server to begin.
        found.listen()
    except OSError as error:
        found.close()
        raise InvalidInputError(
            f"cannot listen at {host}, port {port}: {error.strerror or error}; take another port"
        ) from error
    return found


def _is_local(place: str) -> bool:
    name = place.rpartition(":")[0].strip("[]")
    if name == LOCAL:
        return True
    try:
        return ipaddress.ip_address(name).is_loopback
    except ValueError:
        return False


def _uvicorn() -> Any:
    for module in ("starlette", "uvicorn", "websockets"):  # said here, not amid a page
        require(module, "studio", "the studio needs")
    import uvicorn

    return uvicorn
