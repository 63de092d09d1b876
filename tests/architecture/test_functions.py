"""Functions that fit on a screen, and calls that can be read."""

from __future__ import annotations

import ast
import io
import tokenize
from functools import cache

from tests.support.each import each
from tests.support.sources import MODULES, text_of

# Lines of code of a body: without its docstring, comments and blank lines.
MOST_LINES = 60
# Parameters that may be given by their place; those by name alone say what they are.
MOST_POSITIONAL = 8
# A function that goes beyond says why, in a comment above it or before its first statement.
REASON = "# long: "
FILLING = {
    tokenize.COMMENT,
    tokenize.NL,
    tokenize.NEWLINE,
    tokenize.INDENT,
    tokenize.DEDENT,
    tokenize.ENCODING,
    tokenize.ENDMARKER,
}


def _code_lines(source):
    return {
        line
        for token in tokenize.generate_tokens(io.StringIO(source).readline)
        if token.type not in FILLING
        for line in range(token.start[0], token.end[0] + 1)
    }


def too_large(source):
    """(line, name, lines of code, positional parameters) of functions beyond the limits."""
    lines, found = source.splitlines(), []
    code_lines = cache(lambda: _code_lines(source))  # slow, and most functions are short anyway
    for node in ast.walk(ast.parse(source)):
        if not isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
            continue
        body = node.body[1:] if ast.get_docstring(node) is not None else node.body
        first = body[0].lineno if body else node.end_lineno
        given = [*node.args.posonlyargs, *node.args.args]
        positional = [name for name in given if name.arg not in ("self", "cls")]
        top = min([node.lineno, *(decorator.lineno for decorator in node.decorator_list)])
        head = [*lines[max(top - 2, 0) : top - 1], *lines[node.lineno : first - 1]]
        excused = any(line.strip().startswith(REASON) for line in head)
        inside = set(range(first, node.end_lineno + 1)) if body else set()
        n_lines = len(code_lines() & inside) if len(inside) > MOST_LINES else len(inside)
        if (n_lines > MOST_LINES or len(positional) > MOST_POSITIONAL) and not excused:
            found.append((node.lineno, node.name, n_lines, len(positional)))
    return found


def test_the_measure_by_hand():
    body = "\n".join(f"    x = {k}  # said\n\n    # why" for k in range(61))
    assert too_large(f'def f(self):\n    """Say.\n\n    More.\n    """\n{body}\n') == [
        (1, "f", 61, 0)
    ]
    assert too_large(f"# long: a table\n@once\ndef f():\n{body}\n") == []
    assert too_large(f'def f():\n    """Say."""\n    # long: a table\n{body}\n') == []
    assert too_large(f"def f():\n    x = 0\n    # long: too late\n{body}\n") == [(1, "f", 62, 0)]
    wide = "class A:\n    def f(self, a, b, c, d, e, f, g, h{}): ...\n"
    assert too_large(wide.format("")) == too_large(wide.format(", *, i, j")) == []
    assert too_large(wide.format(", i")) == [(2, "f", 1, 9)]
    text = '    x = """a\n' + "b\n" * 60 + '"""\n'
    assert too_large(f"def f():\n{text}") == [(1, "f", 62, 0)]


@each(MODULES)
def test_no_function_is_long_or_wide(name):
    assert too_large(text_of(MODULES[name])) == []
