"""The architecture, read from the sources: arrows run one way, importing costs nothing."""

from __future__ import annotations

import ast
import importlib
import subprocess
import sys

import pytest
from tests.support.each import each
from tests.support.places import ROOT
from tests.support.sources import MODULES, SOURCES, imports, tree_of

import shapespline

by_module = each(name for name in MODULES if name)


def first(name):
    return name.split(".")[0]


def test_the_visitor_sees_every_kind_of_import(tmp_path):
    source = tmp_path / "x.py"
    source.write_text(
        "import scipy.linalg\n"
        "if TYPE_CHECKING:\n    from shapespline.curve import C\n"
        "class A:\n    import json\n"
        "    def f(self):\n        from shapespline import _kernels, read\n"
        "try:\n    import numpy as np\nexcept ImportError:\n    pass\n"
        "async def g():\n    if x:\n        import os\n",
        encoding="utf-8",
    )
    assert imports(source) == [
        ("scipy.linalg", None, "load"),
        ("shapespline.curve", "C", "types"),
        ("json", None, "load"),
        ("shapespline", "_kernels", "call"),
        ("shapespline", "read", "call"),
        ("numpy", None, "load"),
        ("os", None, "call"),
    ]


@by_module
def test_the_command_line_uses_public_names_only(name):
    if first(name) not in ("cli", "studio"):
        return
    for module, imported, _ in imports(MODULES[name]):
        if module.startswith("shapespline"):
            assert "._" not in module
            assert imported is None or not imported.startswith("_"), f"{module}.{imported}"
    tree = tree_of(MODULES[name])
    used = {
        node.attr
        for node in ast.walk(tree)
        if isinstance(node, ast.Attribute)
        and isinstance(node.value, ast.Name)
        and node.value.id == "ss"
    }
    assert used <= set(shapespline.__all__)


@pytest.mark.slow
@by_module
def test_scipy_is_imported_when_it_is_asked_for(name):
    for module, _, when in imports(MODULES[name]):
        assert first(module) not in ("scipy", "matplotlib") or when != "load", name


@pytest.mark.slow
@by_module
def test_the_library_neither_prints_nor_exits(name):
    if first(name) in ("cli", "__main__"):
        return
    for node in ast.walk(tree_of(MODULES[name])):
        if isinstance(node, ast.Call):
            called = ast.unparse(node.func)
            assert called not in ("print", "exit", "quit", "sys.exit", "os._exit"), name
        if isinstance(node, ast.ExceptHandler):
            assert node.type is not None, f"bare except in {name}, line {node.lineno}"
        assert not isinstance(node, ast.Assert), f"assert in {name}, line {node.lineno}"


@each([*SOURCES, *sorted((ROOT / "kernels").rglob("*.[ch]pp"))])
def test_no_file_is_long_or_wide(path):
    lines = path.read_text(encoding="utf-8").splitlines()
    assert len(lines) <= 400
    if path.suffix != ".py":  # ruff looks at these
        assert max(map(len, lines)) <= 100


@by_module
def test_every_module_says_what_it_is(name):
    assert ast.get_docstring(tree_of(MODULES[name]))


# --- the public face ---------------------------------------------------------------------------


def run_python(code):
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", code], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    return done.stdout.split()


def test_import_loads_neither_numpy_nor_scipy():
    loaded = run_python("import sys, shapespline; print(*{m.split('.')[0] for m in sys.modules})")
    assert "shapespline" in loaded
    assert not {"numpy", "scipy", "PIL", "matplotlib", "click", "ezdxf"} & set(loaded)


@pytest.mark.slow
def test_fitting_needs_neither_scipy_nor_masked_arrays():
    code = (
        "import sys, shapespline as ss, numpy as np\n"
        "t = np.linspace(0, 6, 90)\n"
        "c = ss.Contour(np.column_stack([t, np.sin(t)]), closed=False)\n"
        "fit = ss.fit_curve(c, tolerance=0.01)\n"
        "sparse = ss.fit_curve(c)\n"
        "print(fit.kept, 'numpy.ma' in sys.modules)\n"  # PKG-08
        "fit = ss.optimize(c, ss.initial_curve(c, length=6))\n"
        "print(fit.hausdorff_distance, 'scipy' in sys.modules)\n"
        "picture = np.full((64, 64), 255, np.uint8); picture[16:48, 16:48] = 0\n"
        "(fit,) = ss.fit_shape(ss.trace(picture), tolerance=0.5)\n"
        "print(fit.kept, 'scipy' in sys.modules)\n"
    )
    said = run_python(code)
    assert said[:2] == ["True", "False"]
    assert said[3:] == ["False", "True", "False"]


def test_public_names():
    assert set(shapespline.__all__) == {*shapespline._HOME, "__version__"}
    assert dir(shapespline) == sorted(shapespline.__all__)
    assert shapespline.__version__.count(".") == 2
    with pytest.raises(AttributeError, match="has no attribute 'nothing'"):
        _ = shapespline.nothing


@each(sorted(shapespline._HOME))
def test_every_public_name_resolves_to_what_its_module_defines(name):
    home = shapespline._HOME[name]
    module = importlib.import_module(f"shapespline.{home}")
    assert getattr(shapespline, name) is getattr(module, name)


def test_the_kernel_and_python_agree_on_the_largest_degree():
    from shapespline import _kernels
    from shapespline.values.knots import MAX_DEGREE

    assert _kernels.MAX_DEGREE == MAX_DEGREE


def test_every_error_is_a_shapespline_error():
    from shapespline import errors

    for name, value in vars(errors).items():
        if isinstance(value, type) and name.endswith("Error"):
            assert issubclass(value, errors.ShapesplineError)
    assert issubclass(errors.InvalidInputError, ValueError)
    assert issubclass(errors.DegenerateContourError, errors.InvalidInputError)
    assert issubclass(errors.OrderError, errors.InvalidInputError)
    assert issubclass(errors.UnknownFormatError, errors.FormatError)
