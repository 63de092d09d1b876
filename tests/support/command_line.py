"""What the command line says, for the tests of it."""


def one_line(error):
    """Whether an error is one line of the program."""
    return error.startswith("shapespline: ") and error.count("\n") == 1 and "Traceback" not in error
