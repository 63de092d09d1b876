"""Entry point: ``shapespline`` and ``python -m shapespline``."""

from __future__ import annotations

import sys


def main() -> None:
    """Answer ``--version`` at once, everything else through the command line interface."""
    if sys.argv[1:] == ["--version"]:
        from shapespline._version import __version__

        print(f"shapespline {__version__}")
        return
    try:
        from shapespline.cli import run
    except KeyboardInterrupt:
        sys.exit(130)
    sys.exit(run())


if __name__ == "__main__":
    main()
