"""The command line: one module a command, one for what commands share.

Errors are one line on standard error: exit 1 for a file or value that cannot be used, 2 for a
wrong call, 3 where a curve keeps less than its tolerance, 130 after Ctrl-C. Numerical packages are
imported inside the commands, so that the help comes at once.
"""

from shapespline.cli.main import help_pages, run

__all__ = ["help_pages", "run"]
