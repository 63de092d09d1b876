"""Damage, drawn from a seed: bytes, numbers and words of the format."""

# ruff: noqa: E501 - tables
from __future__ import annotations

import random
import re

NUMBER = re.compile(rb"-?\d+\.?\d*(?:[eE][-+]?\d+)?")
# Numbers that make arithmetic overflow, divide by nothing, or ask for too much.
NUMBERS = (b"0", b"-1", b"1e309", b"-1e308", b"1e-320", b"nan", b"inf", b"99999999999", b"4294967295",
           b"1e154", b"0.0", b"-0", b"2147483648", b"1e5", b"1000000", b"")  # fmt: skip
WORDS = {
    "svg": (b'<use href="#one"/>', b'<use href="#two"/>', b"<g>", b"</g>", b'id="one"', b'id="two"',
            b'transform="scale(1e200)"', b'transform="matrix(1 2 3)"', b'viewBox="0 0 0 0"', b"A0 0 0 0 0",
            b'<!DOCTYPE svg [<!ENTITY a "b">]>', b"&a;", b"&#0;", b'd="M0 0"', b"<svg>", b"<style>",
            b"url(#one)", b"%", b"em", b"rotate(", b'points="1"', b"C", b"z", b"calc("),
    "dxf": (b"\n0\nINSERT\n8\n0\n2\nA\n", b"\n2\nB\n", b"\n70\n30000\n71\n30000\n", b"\n0\nENDSEC\n",
            b"\n0\nLINE\n", b"\n230\n-1\n", b"\n40\n0\n", b"\n90\n1000000000\n", b"\n0\nVERTEX\n", b"\n999\n"),
    "json": (b"null", b"[", b"]", b"{", b"}", b"true", b'"x"', b"[[[[", b"1e999", b"NaN"),
    "csv": (b",", b";", b"\t", b" ", b"\x00", b"#", b'"', b"\n\n", b"\r", b"x,y\n", b"\xef\xbb\xbf"),
    "step": (b"#1", b"$", b"*", b"()", b"#99999999", b"(#1,#1)", b";", b"''"),
}  # fmt: skip
WORDS |= {"geojson": WORDS["json"], "iges": (b",", b";", b"1H,", b"9999999", b"-1")}
BYTES = (b"\x00", b"\xff", b"\x7f\xff\xff\xff", b"\xff\xff\xff\xff", b"\x00\x00\x00\x00", b"\x80")


def mutated(files: list[bytes], ending: str, seed: int) -> bytes:
    """A file made of sound ones: one to six faults, the same for the same seed."""
    rng = random.Random(f"{ending} {seed}")
    data = rng.choice(files)
    for _ in range(rng.choice((1, 1, 2, 3, 6))):
        data = _once(data, files, ending, rng)
    return data


def _once(data: bytes, files: list[bytes], ending: str, rng: random.Random) -> bytes:
    """One fault more."""
    at = rng.randrange(len(data) + 1)
    end = min(len(data), at + rng.choice((1, 3, 20, 200)))
    kind = rng.choice(
        ("cut", "drop", "bytes", "word", "word", "number", "number", "repeat", "splice")
    )
    numbers = list(NUMBER.finditer(data)) if kind == "number" else []
    if kind == "number" and numbers:
        found = rng.choice(numbers)
        return data[: found.start()] + rng.choice(NUMBERS) + data[found.end() :]
    if kind == "word" and ending in WORDS:
        return data[:at] + rng.choice(WORDS[ending]) + data[at + rng.choice((0, 0, 4)) :]
    if kind == "cut":
        return data[:at]
    if kind == "drop":
        return data[:at] + data[end:]
    if kind == "repeat":
        return data[:at] + data[at:end] * rng.choice((2, 5, 1000)) + data[end:]
    if kind == "splice":
        other = rng.choice(files)
        start = rng.randrange(len(other))
        return data[:at] + other[start : start + rng.choice((4, 40, 400))] + data[end:]
    new = rng.choice((*BYTES, bytes([rng.randrange(256)])))
    return data[:at] + new + data[at + len(new) :]
