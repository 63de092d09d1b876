"""Session: one page and what it opened; hears its messages, answers from its lanes.

Nothing of a session is shared with another, and nothing is kept when its page goes: the page holds
the settings and the file, and opens it again when it comes back.
"""

from __future__ import annotations

import logging
from time import perf_counter
from typing import TYPE_CHECKING, Any

import numpy as np

from shapespline.errors import InvalidInputError, ShapesplineError
from shapespline.fitting import REGULARITIES
from shapespline.formats import writable
from shapespline.studio import fits, outputs, papers
from shapespline.studio.asked import Asked
from shapespline.studio.crossings import crossings
from shapespline.studio.documents import (
    MOST_BYTES,
    MOST_DRAWN,
    Document,
    drawn_points,
    opened_example,
)
from shapespline.studio.examples import EXAMPLES, example_bytes
from shapespline.studio.jobs import Cancelled, Lane
from shapespline.studio.messages import packed, unpacked
from shapespline.studio.sketch import regularities, sketch
from shapespline.values import Drawing

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping, Sequence

    from shapespline.studio.jobs import Ticket
    from shapespline.studio.reading import Readers
    from shapespline.typing import FloatArray, IntArray
    from shapespline.values import Fit, Regularity

LOG = logging.getLogger(__name__)
# Drawings of more points are not encoded while a slider moves, to tell how large the file would be.
MOST_ENCODED = 3000
LANES = ("open", "a", "b", "paper", "file")


class Session:
    """What one page opened, and the threads that work for it.

    Parameters
    ----------
    send : callable
        Takes a message as bytes, from any thread.
    readers : Readers
        Processes that read files.
    first : Document, optional
        What the program was started with.
    """

    def __init__(
        self, send: Callable[[bytes], None], readers: Readers, first: Document | None = None
    ) -> None:
        self._send = send
        self._readers = readers
        self._document = first
        self._drawn: list[IntArray] = []
        self._drawings: dict[str, Drawing] = {}
        self._lanes = {name: Lane(f"studio-{name}") for name in LANES}
        self._handlers = {
            "open": self._open,
            "example": self._example,
            "reread": self._reread,
            "fit": self._fit,
            "cancel": self._cancel,
            "paper": self._paper,
            "export": self._export,
            "copy": self._copy,
        }

    def greet(self) -> None:
        """Say what there is: examples, formats, words, limits; the first document."""
        self._say(
            {
                "type": "hello",
                "examples": [{"id": name, "title": e.title} for name, e in EXAMPLES.items()],
                "formats": list(writable()),
                "choices": fits.choices(),
                "defaults": fits.defaults(),
                "regularities": list(REGULARITIES),
                "methods": list(papers.METHODS),
                "most_bytes": MOST_BYTES,
                "has_document": self._document is not None,
            }
        )
        if self._document is not None:
            content = np.frombuffer(self._document.content, dtype=np.uint8)
            self._show(self._document, 0, None, {"file": content})

    def hear(self, message: bytes) -> None:
        """Act on a message; what is wrong with it is answered with a sentence."""
        try:
            header, content = unpacked(message)
            handler = self._handlers.get(header["type"])
            if handler is None:
                raise InvalidInputError(f"type of a message must be known, got {header['type']!r}")
            handler(header, content)
        except (ShapesplineError, TypeError, ValueError, KeyError) as error:
            self._say({"type": "error", "sentence": str(error), "about": "message"})

    def close(self) -> None:
        """End all that is under way; threads end when they next ask whether to go on."""
        for lane in self._lanes.values():
            lane.close()

    # What a message asks for

    def _open(self, header: Mapping[str, Any], content: bytes) -> None:
        options = dict(header.get("options") or {})
        name = header.get("name")
        self._read(header, lambda t: self._readers.opened(name, content, options, t), None)

    def _example(self, header: Mapping[str, Any], _: bytes) -> None:
        name = str(header.get("id"))
        example_bytes(name)
        self._read(header, lambda _: opened_example(name), EXAMPLES[name].tolerance)

    def _reread(self, header: Mapping[str, Any], _: bytes) -> None:
        document = self._opened()
        options = dict(header.get("options") or {})
        name, content = document.name, document.content
        self._read(header, lambda t: self._readers.opened(name, content, options, t), None)

    def _read(
        self,
        header: Mapping[str, Any],
        make: Callable[[Ticket], Document],
        tolerance: float | None,
    ) -> None:
        def work(ticket: Ticket) -> None:
            self._say(
                {
                    "type": "progress",
                    "generation": ticket.generation,
                    "text": "reading",
                    "slot": "open",
                }
            )
            document = make(ticket)
            ticket.check()
            # Until here the fits of the document before went on.
            for slot in ("a", "b", "paper"):
                self._lanes[slot].cancel()
            self._document = document
            self._drawings.clear()
            # The page has its own files; those of examples it gets once.
            content = np.frombuffer(document.content, dtype=np.uint8)
            self._show(
                document, ticket.generation, tolerance, {"file": content} if tolerance else None
            )

        self._submit("open", header, work)

    def _show(
        self,
        document: Document,
        generation: int,
        tolerance: float | None,
        extra: Mapping[str, np.ndarray] | None = None,
    ) -> None:
        """Send the outlines of a document, thinned where there are too many to draw."""
        shape, box = document.shape, document.box
        size = float(np.hypot(box[2] - box[0], box[3] - box[1]))
        n_points = sum(map(len, shape))
        share = [max(50, MOST_DRAWN * len(one) // n_points) for one in shape]
        self._drawn = [
            drawn_points(one, most, size / 4000) for one, most in zip(shape, share, strict=True)
        ]
        points = [c.points[d] - document.origin for c, d in zip(shape, self._drawn, strict=True)]
        frame = shape.frame
        self._say(
            {
                "type": "shape",
                "generation": generation,
                "name": document.name,
                "picture": document.is_picture,
                "options": dict(document.options),
                "unit": shape.unit,
                "box": list(box),
                "origin": document.origin.tolist(),
                "diagonal": size,
                "frame": None if frame is None else [frame.x, frame.y, frame.width, frame.height],
                "tolerance": tolerance
                if tolerance is not None
                else _first_tolerance(document, size),
                "sentences": list(document.sentences),
                "outlines": [
                    {
                        "n_points": len(one),
                        "n_drawn": len(kept),
                        "closed": one.closed,
                        "hole": shape.is_hole(k),
                        "color": shape.colors[k],
                        "length": one.length,
                    }
                    for k, (one, kept) in enumerate(zip(shape, self._drawn, strict=True))
                ],
            },
            {
                "points": np.concatenate(points),
                "indices": np.concatenate(self._drawn),
                "at": np.concatenate(
                    [c.arc_length[: len(c)][d] for c, d in zip(shape, self._drawn, strict=True)]
                ),
                **(extra or {}),
            },
        )

    def _fit(self, header: Mapping[str, Any], _: bytes) -> None:
        document, slot = self._opened(), header.get("slot", "a")
        if slot not in ("a", "b"):
            raise InvalidInputError(f"slot must be a or b, got {slot!r}")
        asked = Asked.of(header, document) if "settings" in header else None
        with_peer = header.get("peer") == "splprep"
        draft, first = bool(header.get("draft")), int(header.get("outline") or 0)
        n_outlines, drawn = len(document.shape), self._drawn
        order = [first % n_outlines, *(k for k in range(n_outlines) if k != first % n_outlines)]

        def work(ticket: Ticket) -> None:
            began = perf_counter()
            found: Iterable[tuple[int, Fit]]
            across: Sequence[Regularity] = ()
            if with_peer:
                tolerance = float(header["tolerance"])
                found = (
                    (k, fits.splprep_fit(document.shape.contours[k], tolerance, 3, ticket))
                    for k in order
                )
            elif asked is None:
                raise InvalidInputError("settings must be given with a fit")
            elif draft or not asked.is_plain:
                found = ((k, fits.fitted(asked, k, ticket, draft=draft)) for k in order)
            else:
                made_as_one = fits.whole(asked, ticket)
                found, across = enumerate(made_as_one), made_as_one.regularities
            kept: dict[int, Fit] = {}
            lines: dict[int, FloatArray] = {}
            for index, fit in found:
                ticket.check()
                kept[index] = fit
                all_there = len(fit.contour) == len(document.shape.contours[index])
                made = sketch(fit, document.origin, drawn[index] if all_there else None)
                lines[index] = made.line
                about = {"type": "fit", "generation": ticket.generation, "outline": index}
                about |= {"slot": slot, "draft": draft, "seconds": perf_counter() - began}
                self._say({**about, **made.figures}, made.arrays)
            every = [kept[k] for k in range(n_outlines)]
            drawing = Drawing.of(document.shape, every, regularities=across)
            if not draft:
                self._drawings[slot] = drawing
            about = {"slot": slot, "draft": draft, "seconds": perf_counter() - began}
            about["remarks"] = [] if asked is None else fits.remarks(asked, drawing)
            self._done(drawing, [lines[k] for k in range(n_outlines)], ticket, about)

        self._submit(slot, header, work)

    def _done(
        self, drawing: Drawing, lines: list[FloatArray], ticket: Ticket, about: dict[str, Any]
    ) -> None:
        n_points, n_bytes = sum(fit.n_stored_points for fit in drawing), None
        if n_points <= MOST_ENCODED or not about["draft"]:
            n_bytes = len(outputs.encoded(drawing, ".svg"))
        met = crossings(lines)
        ticket.check()
        figures = {
            "n_stored_points": n_points,
            "n_bytes": n_bytes,
            "n_kept": sum(fit.kept for fit in drawing),
            "distance": max(fit.hausdorff_distance for fit in drawing),
            "regularities": regularities(drawing.regularities),
        }
        said = {"type": "done", "generation": ticket.generation, **about, **figures}
        self._say(said, {"crossings": met})
        if not about["draft"]:
            self._readers.prepare()

    def _cancel(self, header: Mapping[str, Any], _: bytes) -> None:
        for name in LANES if header.get("slot") is None else (header["slot"],):
            self._lanes[name].cancel()

    def _paper(self, header: Mapping[str, Any], _: bytes) -> None:
        document = self._opened()
        index = int(header.get("outline") or 0) % len(document.shape)
        contour, methods = document.shape.contours[index], list(header.get("methods") or ())

        def work(ticket: Ticket) -> None:
            timed = papers.begun(header, contour)
            made = papers.first_sketch(timed, contour, document.origin)
            about = {"generation": ticket.generation, "outline": index}
            self._say({"type": "paper", **about, **made.figures}, made.arrays)
            for method in methods[: len(papers.METHODS)]:
                ticket.check()
                film = papers.run(timed.start, contour, str(method), ticket)
                moved = {
                    name: array - document.origin if name != "history" else array
                    for name, array in film.arrays.items()
                }
                self._say({"type": "film", **about, "asked": method, **film.figures}, moved)

        self._submit("paper", header, work)

    def _export(self, header: Mapping[str, Any], _: bytes) -> None:
        drawing, ending = self._drawings.get("a"), str(header.get("format"))
        document, options = self._opened(), dict(header.get("options") or {})
        if drawing is None:
            raise InvalidInputError("there is no finished fit to write: wait for it")

        def work(ticket: Ticket) -> None:
            content = outputs.encoded(drawing, ending, options)
            name = document.name.rsplit(".", 1)[0] + "_fit" + ending
            self._say(
                {"type": "file", "generation": ticket.generation, "name": name},
                {"bytes": np.frombuffer(content, dtype=np.uint8)},
            )

        self._submit("file", header, work)

    def _copy(self, header: Mapping[str, Any], _: bytes) -> None:
        asked = Asked.of(header, self._opened())
        makers: dict[str, Callable[[Asked], str]] = {
            "python": outputs.python_text,
            "command": outputs.command_line,
            "toml": outputs.settings_text,
        }
        kind = str(header.get("kind"))
        if kind not in makers:
            raise InvalidInputError(f"kind must be one of {', '.join(makers)}, got {kind!r}")
        text = makers[kind](asked)
        self._say({"type": "text", "kind": kind, "text": text, "name": self._opened().name})

    # How it is done

    def _opened(self) -> Document:
        if self._document is None:
            raise InvalidInputError("nothing is open: open a file or an example")
        return self._document

    def _submit(self, slot: str, header: Mapping[str, Any], work: Callable[[Ticket], None]) -> None:
        def guarded(ticket: Ticket) -> None:
            about = {"type": "error", "generation": ticket.generation, "about": header["type"]}
            about["slot"] = slot
            try:
                work(ticket)
            except Cancelled:
                return
            except (ShapesplineError, MemoryError) as error:
                sentence = str(error) or "there is not enough memory for that"
            except Exception as error:
                LOG.exception("a job of the studio failed")
                sentence = f"the program failed on this ({type(error).__name__}); please report it"
            else:
                return
            if ticket.wanted:
                self._say({**about, "sentence": sentence})

        generation = int(header.get("generation") or 0)

        def tell(text: str) -> None:
            self._say({"type": "progress", "slot": slot, "generation": generation, "text": text})

        self._lanes[slot].submit(generation, guarded, tell)

    def _say(
        self, header: Mapping[str, Any], arrays: Mapping[str, np.ndarray] | None = None
    ) -> None:
        self._send(packed(header, arrays))


def _first_tolerance(document: Document, size: float) -> float:
    """Where the slider stands at first: half a pixel, or a part in 500 of the size."""
    if document.is_picture and document.shape.unit == "px":
        return 0.5
    return float(f"{size / 500:.1g}")
