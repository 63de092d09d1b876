"""Drawings as SVG, and the colours of places in them."""

from __future__ import annotations

import io

import shapespline as ss

HEAD = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100"'
RED, GREEN, BLUE = "#cc2222", "#22aa66", "#2255cc"


def svg(body, more=""):
    return f"{HEAD}{more}>{body}</svg>".encode()


def read(body, more=""):
    return ss.read(io.BytesIO(svg(body, more)), format=".svg")


def rect(x, y, wide, high, **style):
    told = " ".join(f'{name.replace("_", "-")}="{value}"' for name, value in style.items())
    return f'<rect x="{x}" y="{y}" width="{wide}" height="{high}" {told}/>'


def ring(x, y, wide, high, by, **style):
    """A rectangle with a hole, as one element by the even-odd rule."""
    told = " ".join(f'{name.replace("_", "-")}="{value}"' for name, value in style.items())
    inner = f"M{x + by} {y + by}h{wide - 2 * by}v{high - 2 * by}h{2 * by - wide}z"
    return f'<path fill-rule="evenodd" d="M{x} {y}h{wide}v{high}h{-wide}z{inner}" {told}/>'


# Drawings, and the colours of places in them.
PICTURES = {
    "areas upon each other": (
        rect(10, 10, 80, 80, fill=GREEN)
        + rect(20, 20, 60, 60, fill=RED)
        + rect(30, 30, 40, 40, fill="white")
        + rect(40, 40, 20, 20, fill="black"),
        {(15, 15): GREEN, (25, 25): RED, (35, 35): "#ffffff", (50, 50): "#000000"},
    ),
    "through the hole of an area": (
        rect(30, 30, 40, 40, fill=RED) + ring(10, 10, 80, 80, 30, fill=GREEN),
        {(20, 50): GREEN, (50, 50): RED},
    ),
    "details beneath a frame": (
        rect(20, 20, 60, 60, fill=RED)
        + rect(45, 45, 10, 10, fill=BLUE)
        + ring(15, 15, 70, 70, 10, fill="black"),
        {(18, 50): "#000000", (30, 50): RED, (50, 50): BLUE},
    ),
    "a hole beneath a frame": (
        ring(10, 10, 80, 80, 30, fill=RED) + ring(35, 35, 30, 30, 8, fill="black"),
        {(20, 50): RED, (38, 50): "#000000", (50, 50): "#ffffff"},
    ),
    "a white bar over two stripes": (
        rect(0, 0, 100, 50, fill=RED)
        + rect(0, 50, 100, 50, fill=BLUE)
        + rect(40, 20, 20, 60, fill="white"),
        {(50, 10): RED, (50, 40): "#ffffff", (50, 60): "#ffffff", (50, 90): BLUE},
    ),
    "a bar that runs the other way": (
        rect(0, 0, 100, 50, fill=RED)
        + rect(0, 50, 100, 50, fill=BLUE)
        + '<path fill="white" d="M40 20V80H60V20z"/>',
        {(50, 40): "#ffffff", (50, 60): "#ffffff"},
    ),
    "a frame with a stroke": (
        ring(20, 20, 60, 60, 15, fill=GREEN, stroke=RED, stroke_width=4),
        {(27, 50): GREEN, (50, 50): "#ffffff", (20, 50): RED, (35, 50): RED},
    ),
    "a black frame within a line": (
        rect(5, 5, 90, 90, fill="none", stroke="black", stroke_width=4) + ring(20, 20, 60, 60, 15),
        {(5, 50): "#000000", (12, 50): "#ffffff", (27, 50): "#000000", (50, 50): "#ffffff"},
    ),
    "white corners that meet a border": (
        rect(0, 0, 100, 50, fill=RED)
        + rect(0, 50, 100, 50, fill=BLUE)
        + '<path fill="white" d="M0 0L60 50L0 100z"/>',
        {(20, 50): "#ffffff", (80, 20): RED, (80, 80): BLUE},
    ),
    "a white bar over black": (
        rect(20, 20, 60, 60) + rect(0, 45, 100, 10, fill="white"),
        {(50, 30): "#000000", (50, 50): "#ffffff", (10, 50): "#ffffff"},
    ),
    "strokes and areas": (
        rect(20, 20, 60, 60, fill=GREEN, stroke=RED, stroke_width=8)
        + '<path fill="none" stroke="#2255cc" stroke-width="6" d="M30 50L70 50"/>',
        {(17, 50): RED, (23, 50): RED, (50, 40): GREEN, (50, 50): BLUE},
    ),
    "a closed stroke fills nothing": (
        rect(10, 10, 80, 80, fill=GREEN)
        + rect(30, 30, 10, 40, fill=BLUE)
        + rect(20, 20, 60, 60, fill="none", stroke=RED, stroke_width=4),
        {(50, 50): GREEN, (35, 50): BLUE, (20, 50): RED},
    ),
    "a stroke above what covers its area": (
        rect(10, 10, 80, 80, fill=GREEN)
        + rect(50, 10, 40, 80, fill=BLUE)
        + rect(10, 10, 80, 80, fill="none", stroke=RED, stroke_width=8),
        {(30, 50): GREEN, (70, 50): BLUE, (87, 50): RED, (93, 50): RED},
    ),
    "the hole of a white frame on paper": (
        '<path d="M5 5H95V95H5ZM20 20V80H80V20Z" fill="white"/>' + rect(40, 40, 20, 20, fill=RED),
        {(30, 50): "#ffffff", (50, 50): RED},
    ),
    "an area beneath a frame of its outline": (
        rect(10, 10, 80, 80, fill=GREEN) + ring(10, 10, 80, 80, 20, fill=RED),
        {(15, 50): RED, (50, 50): GREEN},
    ),
    "an area in the hole of a frame": (
        rect(30, 30, 40, 40, fill=BLUE) + ring(10, 10, 80, 80, 20, fill=RED),
        {(15, 50): RED, (50, 50): BLUE},
    ),
    "two frames with one hole": (
        ring(10, 10, 80, 80, 30, fill=RED) + ring(20, 20, 60, 60, 20, fill=GREEN),
        {(15, 50): RED, (25, 50): GREEN, (50, 50): "#ffffff"},
    ),
    "two frames of one colour with one hole": (
        ring(10, 10, 80, 80, 30, fill=RED)
        + ring(20, 20, 60, 60, 20, fill=RED)
        + rect(0, 90, 9, 9, fill=BLUE),
        {(15, 50): RED, (30, 50): RED, (50, 50): "#ffffff"},
    ),
    "a stroke beneath the area within it": (
        rect(20, 20, 60, 60, fill="none", stroke="black", stroke_width=20)
        + rect(20, 20, 60, 60, fill="#ffff00"),
        {(13, 50): "#000000", (25, 50): "#ffff00"},
    ),
    "two strokes along a line that is closed": (
        rect(20, 20, 60, 60, fill="none", stroke=BLUE, stroke_width=20)
        + rect(20, 20, 60, 60, fill="none", stroke="#ffff00", stroke_width=8),
        {(13, 50): BLUE, (20, 50): "#ffff00", (27, 50): BLUE, (50, 50): "#ffffff"},
    ),
    "a wide stroke and a narrow one around an area": (
        rect(20, 20, 60, 60, fill=GREEN, stroke=BLUE, stroke_width=20)
        + rect(20, 20, 60, 60, fill="none", stroke="white", stroke_width=8),
        {(13, 50): BLUE, (20, 50): "#ffffff", (27, 50): BLUE, (50, 50): GREEN},
    ),
    "white over a line": (
        '<path d="M10 50H90" stroke="black" stroke-width="10"/>'
        + rect(40, 30, 20, 40, fill="white"),
        {(20, 50): "#000000", (50, 50): "#ffffff"},
    ),
    "a stroke that reaches beyond what covers it": (
        rect(25, 25, 50, 50, fill="none", stroke=RED, stroke_width=20)
        + rect(20, 20, 60, 60, fill=BLUE),
        {(17, 50): RED, (22, 50): BLUE, (50, 50): BLUE},
    ),
    "dots": (
        '<g stroke="black" stroke-width="20">'
        '<path stroke-linecap="round" d="M30 30h0"/><path stroke-linecap="square" d="M70 30z"/>'
        '<line stroke-linecap="butt" x1="30" y1="70" x2="30" y2="70"/></g>',
        {
            (30, 30): "#000000",
            (38, 30): "#000000",
            (37.5, 37.5): "#ffffff",
            (62, 22): "#000000",
            (30, 70): "#ffffff",
        },
    ),
    "what lets others show through": (
        rect(10, 10, 80, 80, fill="#ffff00") + rect(30, 30, 40, 40, fill="black", opacity=0.5),
        {(20, 50): "#ffff00", (50, 50): "#808000"},
    ),
    "a veil over details": (
        rect(10, 10, 80, 80, fill="#ffff00")
        + rect(20, 20, 60, 60, fill=RED)
        + rect(10, 10, 80, 80, fill="#000000", fill_opacity="50%"),
        {(15, 50): "#808000", (50, 50): "#661111"},
    ),
    "a star that crosses itself": (
        f'<path fill="{RED}" d="M50 5L76 86L7 36H93L24 86z"/>' + rect(0, 90, 9, 9, fill=BLUE),
        {(50, 20): RED, (50, 50): RED},
    ),
}
