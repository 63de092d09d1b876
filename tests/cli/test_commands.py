"""The command line, as a user meets it: files in, files out, exit codes."""

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from benchmarks.howto_figures import bracket
from PIL import Image
from tests.support.command_line import one_line
from tests.support.places import DATA
from tests.support.shapes import flower

import shapespline as ss

HAND = DATA / "outlines" / "hand620_closed.csv"


@pytest.mark.slow
def test_fit_writes_what_it_says(shapespline, tmp_path):
    output, picture = tmp_path / "hand.json", tmp_path / "hand.png"
    code, out, err = shapespline("fit", HAND, "-n", 24, "-o", output, "--plot", picture)
    assert (code, err) == (0, "")
    assert out.startswith(f"{output}: 1 curve, 24 points")
    (fit,) = ss.read(output).fits
    assert fit.n_control_points == 24
    assert fit.closed
    assert picture.read_bytes().startswith(b"\x89PNG")
    assert sorted(tmp_path.iterdir()) == [output, picture]


def test_fit_of_a_picture_keeps_its_frame_and_holes(shapespline, tmp_path):
    output = tmp_path / "glyph.svg"
    code, out, _ = shapespline(
        "fit", DATA / "images" / "NotoSerif-Regular_U0067_512.png", "-n", 24, "-o", output
    )
    assert code == 0
    assert "3 curves, 72 points" in out
    text = output.read_text()
    assert 'viewBox="0 0 512 512"' in text
    assert text.count("<path") == 1
    assert text.count("Z") == 3


def test_a_drawing_can_be_fitted_again(shapespline, tmp_path):
    first, second = tmp_path / "first.json", tmp_path / "second.json"
    assert shapespline("fit", HAND, "-n", 20, "-o", first)[0] == 0
    assert shapespline("fit", first, "-n", 30, "--degree", 4, "-o", second)[0] == 0
    (fit,) = ss.read(second).fits
    assert (fit.n_control_points, fit.degree) == (30, 4)
    np.testing.assert_array_equal(fit.contour.points, np.loadtxt(HAND, delimiter=","))


LOGO = """<svg xmlns="http://www.w3.org/2000/svg" width="80mm" height="60mm" viewBox="0 0 40 30">
<text x="1" y="2">A</text><circle cx="10" cy="10" r="8"/><circle cx="10" cy="10" r="2"/></svg>"""


@pytest.mark.filterwarnings("ignore:logo.svg")
def test_a_drawing_in_svg_becomes_a_dxf_in_its_unit(shapespline, tmp_path):
    source, output = tmp_path / "logo.svg", tmp_path / "logo.dxf"
    source.write_text(LOGO)
    code, out, err = shapespline("fit", source, "-o", output, "--tolerance", 0.1)
    assert code == 0
    assert "2 curves" in out
    assert one_line(err)
    assert "left out: text" in err
    drawing = ss.read(output)
    assert (drawing.unit, drawing.parents) == ("mm", (-1, 0))
    assert ss.compare(drawing, ss.read(source)).hausdorff_distance < 1e-6  # circles, as drawn
    fewest = ("-t", 0.1, "--character", "fewest")
    assert shapespline("fit", source, "-o", output, *fewest)[0] == 0
    # Samples are off by 2 % of the tolerance at most, and there are 20 000 of those that compare.
    found = ss.compare(ss.read(output), ss.read(source))
    assert 0.01 < found.hausdorff_distance <= 0.1 * 1.02 + found.spacing**2
    assert shapespline("fit", source, "-o", output, "-t", 0.005, "--unit", "in")[0] == 0
    assert ss.read(output).unit == "in"
    assert shapespline("convert", source, "-o", output)[0] == 0
    assert ss.compare(ss.read(output), ss.read(source)).hausdorff_distance < 1e-8


@pytest.mark.filterwarnings("ignore:logo.svg")
def test_arcs_for_machines(shapespline, tmp_path):
    source, output = tmp_path / "logo.svg", tmp_path / "logo.dxf"
    source.write_text(LOGO)
    assert shapespline("fit", source, "-o", output, "-t", 0.1, "--arcs")[0] == 0
    assert b"LWPOLYLINE" in output.read_bytes()
    assert b"SPLINE\n" not in output.read_bytes().replace(b"LWPOLYLINE\n", b"")
    # Fitted to the data, not made of a curve that was: within the tolerance, in every format.
    drawing = ss.read(output)
    assert {piece.kind for fit in drawing for piece in fit.pieces} <= {"line", "arc"}
    found = ss.compare(drawing, ss.read(source))
    assert found.hausdorff_distance <= 0.1 * 1.02 + found.spacing**2
    assert shapespline("fit", source, "-o", tmp_path / "x.svg", "-t", 0.1, "--arcs")[0] == 0
    assert "A" in (tmp_path / "x.svg").read_text()
    code, out, err = shapespline("fit", source, "-o", tmp_path / "x.svg", "--arcs")
    assert (code, out) == (1, "")
    assert one_line(err)
    assert "arcs is not an option for x.svg" in err
    code, out, err = shapespline("fit", source, "-o", output, "--form", "arcs")
    assert (code, out) == (1, "")
    assert "--form arcs" in err
    assert "within a tolerance" in err


def test_the_size_of_a_pixel(shapespline, tmp_path):
    picture = DATA / "images" / "mdi_leaf-maple_256.png"
    output = tmp_path / "leaf.dxf"
    assert shapespline("fit", picture, "-o", output, "-t", 0.1, "--dpi", 127)[0] == 0
    (fit,) = ss.read(output)
    (traced,) = ss.read(picture)
    assert fit.contour.box_diagonal == pytest.approx(0.2 * traced.box_diagonal, rel=0.01)
    code, _, err = shapespline("fit", picture, "-o", output, "-t", 0.1, "--unit", "mm")
    assert code == 1
    assert one_line(err)
    assert "needs the size of a pixel" in err


def test_open_and_y_down(shapespline, tmp_path):
    outline, output = tmp_path / "arc.csv", tmp_path / "arc.json"
    t = np.linspace(0, np.pi, 60)
    np.savetxt(outline, np.column_stack([np.cos(t), np.sin(t)]), delimiter=",")
    assert shapespline("fit", outline, "--open", "--y-down", "-n", 6, "-o", output)[0] == 0
    (fit,) = ss.read(output).fits
    assert not fit.closed
    assert fit.contour.points[30, 1] < 0.01  # the top of the arc has become its bottom


@pytest.mark.slow
def test_paper_writes_its_report(shapespline, tmp_path):
    folder = tmp_path / "figures"
    code, out, err = shapespline(
        "paper", DATA / "paper" / "palm620.csv", "--length", 3, "-o", folder
    )
    assert (code, err) == (0, "")
    written = {Path(line) for line in out.split("\n") if line}
    assert written == set(folder.iterdir())
    assert len([path for path in written if path.suffix == ".png"]) == 6


def test_repeated_points_are_said(shapespline, tmp_path):
    outline, output = tmp_path / "twice.csv", tmp_path / "twice.svg"
    points = np.loadtxt(HAND, delimiter=",")
    np.savetxt(outline, np.repeat(points, 2, axis=0), delimiter=",")
    code, _, err = shapespline("fit", outline, "-n", 20, "-o", output)
    assert code == 0
    assert err == "shapespline: dropped 620 of 1240 points: equal to the point before them\n"


def test_what_holds_for_several_outlines_is_said_once(shapespline, tmp_path):
    y, x = np.mgrid[:40, :80] + 0.5
    discs = np.minimum(np.hypot(x - 20, y - 20), np.hypot(x - 60, y - 20)) < 14
    Image.fromarray(np.where(discs, 0, 255).astype(np.uint8)).save(tmp_path / "discs.png")
    given = [str(tmp_path / "discs.png"), "-o", str(tmp_path / "discs.svg")]
    code, _, err = shapespline("fit", *given, "--tolerance", "0.35")
    assert code == 0
    assert err.count("the picture tells an outline to 0.62 only") == 1
    assert "--tolerance 0.66 or more" in err


def test_version_loads_nothing():
    code = (
        "import sys; sys.argv = ['shapespline', '--version'];"
        "from shapespline.__main__ import main; main();"
        "print([name for name in ('numpy', 'scipy', 'click') if name in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == f"shapespline {ss.__version__}\n[]\n"


@pytest.mark.slow
def test_help_does_not_load_the_numerical_packages():
    code = (
        "import sys; sys.argv = ['shapespline', 'fit', '--help'];"
        "from shapespline.cli import run; run();"
        "print([name for name in ('numpy', 'scipy') if name in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.endswith("[]\n")
    assert "--control-points" in done.stdout


@pytest.fixture
def mixed(tmp_path):
    """A folder of good files, two broken ones and one of another kind."""
    folder = tmp_path / "scans"
    folder.mkdir()
    for name in ("hand620_closed", "loop500_open", "leaf840_closed"):
        points = np.loadtxt(DATA / "outlines" / f"{name}.csv", delimiter=",")
        np.savetxt(folder / f"{name}.csv", points, delimiter=",")
    np.save(folder / "hand620_closed.npy", points)
    (folder / "broken.csv").write_text("1,2\n3,x\n")
    (folder / "empty.png").write_bytes(b"")
    (folder / "notes.md").write_text("not an outline")
    return folder


@pytest.mark.parametrize("jobs", [1, 2])
def test_a_folder_with_broken_files(shapespline, tmp_path, mixed, jobs):
    out = tmp_path / "out"
    code, said, err = shapespline("fit", mixed, "-o", out, "-f", "json", "-n", 20, "--jobs", jobs)
    assert code == 1
    written = {"hand620_closed.csv.json", "hand620_closed.npy.json", "loop500_open.json",
               "leaf840_closed.json"}  # fmt: skip
    assert {path.name for path in out.iterdir()} == written
    assert said.count("\n") == 4
    lines = sorted(err.splitlines())
    assert len(lines) == 2
    assert "broken.csv" in lines[0]
    assert "line 2" in lines[0]
    assert "empty.png: the file is empty" in lines[1]


@pytest.mark.slow
def test_jobs_change_no_byte(shapespline, tmp_path, mixed):
    for jobs in (1, 2):
        folder = tmp_path / f"out{jobs}"
        shapespline("fit", mixed / "*.csv", "-o", folder, "-f", "svg", "-n", 20, "-j", jobs)
    names = sorted(path.name for path in (tmp_path / "out1").iterdir())
    assert len(names) == 3
    for name in names:
        assert (tmp_path / "out1" / name).read_bytes() == (tmp_path / "out2" / name).read_bytes()


def test_resume_skips_what_is_done(shapespline, tmp_path):
    folder = tmp_path / "out"
    arguments = ("fit", HAND, "-o", folder, "-f", "svg", "-n", 12, "--resume")
    assert shapespline(*arguments)[1].count("\n") == 1
    assert shapespline(*arguments)[1] == ""
    (folder / "hand620_closed.svg").unlink()
    assert shapespline(*arguments)[1].count("\n") == 1


def test_json_for_scripts(shapespline, tmp_path):
    code, out, err = shapespline("fit", HAND, "-n", 12, "-o", tmp_path / "x.svg", "--json")
    assert (code, err) == (0, "")
    record = json.loads(out)
    assert record["input"] == str(HAND)
    assert record["output"] == str(tmp_path / "x.svg")
    (curve,) = record["curves"]
    assert (curve["control_points"], curve["closed"], curve["status"]) == (12, True, "KEPT")
    code, out, _ = shapespline("fit", tmp_path / "no.csv", "-o", tmp_path / "y.svg", "--json")
    assert code == 1
    assert "there is no such file" in json.loads(out)["error"]


def piped(*arguments, given):
    return subprocess.run(
        [sys.executable, "-m", "shapespline", *map(str, arguments)],
        input=given,
        capture_output=True,
        check=False,
    )


@pytest.mark.slow
def test_standard_streams(tmp_path):
    done = piped("fit", "-", "-o", "-", "-f", "svg", "-n", 12, given=HAND.read_bytes())
    assert done.returncode == 0
    assert done.stdout.lstrip().startswith(b"<?xml") or done.stdout.startswith(b"<svg")
    assert b"1 curve, 12 points" in done.stderr
    assert piped("fit", HAND, "-o", tmp_path / "x.svg", "-n", 12, given=b"").returncode == 0
    assert (tmp_path / "x.svg").read_bytes() == done.stdout


@pytest.mark.slow
def test_standard_input_that_is_broken():
    done = piped("fit", "-", "-o", "-", "-f", "svg", given=b"1,2\n3,x\n")
    assert (done.returncode, done.stdout) == (1, b"")
    assert b"line 2" in done.stderr


def test_what_is_compared_may_differ_in_kind(shapespline, tmp_path):
    table, curve, inches = (tmp_path / name for name in ("table.csv", "curve.svg", "inches.svg"))
    points = flower(80).points
    rows = "".join(f"{number},{x},{y}\n" for number, (x, y) in enumerate(points))
    table.write_text("no,x,y\n" + rows)
    code, _, err = shapespline("fit", table, "-o", curve)
    assert (code, err.count("say which two: --columns 2,3\n")) == (1, 1)
    columns = ("--columns", "x,y", "--closed")
    assert shapespline("fit", table, *columns, "-n", 20, "-o", curve)[0] == 0
    code, out, err = shapespline("compare", table, curve, *columns)
    assert (code, err, out.count("\n")) == (0, "", 3)
    assert shapespline("compare", curve, curve, "--columns", "x,y")[0] == 1  # of neither
    ss.write(inches, ss.read(table, columns="x,y", closed=True), unit="in")
    code, _, err = shapespline("compare", curve, inches)
    assert code == 0
    assert "in in: their numbers are compared; --unit says one for both" in err


def test_compare_and_info(shapespline, tmp_path):
    drawing = tmp_path / "hand.json"
    assert shapespline("fit", HAND, "-t", 0.5, "-o", drawing)[0] == 0
    (fit,) = ss.read(drawing).fits
    code, out, _ = shapespline("compare", HAND, drawing, "--json")
    assert code == 0
    found = json.loads(out)
    assert found["hausdorff_distance"] <= 0.5
    assert found["hausdorff_distance"] >= fit.hausdorff_distance - found["spacing"]
    code, out, _ = shapespline("compare", HAND, HAND)
    assert code == 0
    assert out.count("\n") == 3
    code, out, _ = shapespline("info", HAND, drawing)
    assert code == 0
    lines = out.splitlines()
    assert "1 outline, 620 points, 1 closed, 0 holes" in lines[0]
    assert f"{fit.n_stored_points} stored points, fitted to 620 points" in lines[1]
    code, out, _ = shapespline("info", HAND, "--json")
    assert json.loads(out)["points"] == 620


@pytest.mark.slow
def test_trace_and_convert(shapespline, tmp_path):
    picture = DATA / "images" / "fa_leaf_256.png"
    code, out, _ = shapespline("trace", picture, "-o", tmp_path / "leaf.json")
    assert code == 0
    assert "outline" in out
    shape = ss.read(picture)
    drawing = ss.read(tmp_path / "leaf.json")
    for contour, fit in zip(shape, drawing, strict=True):
        np.testing.assert_array_equal(fit.contour.points, contour.points)
        assert fit.degree == 1
        assert fit.max_distance <= 1e-12 * contour.box_diagonal
    code, _, _ = shapespline("convert", tmp_path / "leaf.json", "-o", tmp_path / "leaf.svg")
    assert code == 0
    assert (tmp_path / "leaf.svg").read_text().count("<path") == 1


def test_ends_outliers_and_time(shapespline, tmp_path):
    outline, output = tmp_path / "wave.csv", tmp_path / "wave.json"
    x = np.linspace(0, 10, 200)
    points = np.column_stack([x, np.sin(x)])
    points[77] = (5, 9)
    np.savetxt(outline, points, delimiter=",")
    arguments = ("fit", outline, "--open", "-t", 0.05, "-o", output, "--ends", "fixed")
    code, out, _ = shapespline(*arguments, "--outliers", "--json")
    assert code == 0
    assert json.loads(out)["curves"][0]["outliers"] == 1
    (fit,) = ss.read(output).fits
    assert fit.outliers.tolist() == [77]
    np.testing.assert_array_equal(fit.control_points[[0, -1]], points[[0, -1]])
    code, _, err = shapespline(*arguments, "--time-limit", 1e-9)
    assert code == 0
    assert "the time limit of 1e-09 s ran out" in err
    assert shapespline(*arguments, "--time-limit", -1)[0] == 1


def test_no_argument_shows_the_help(shapespline):
    code, out, err = shapespline()
    assert (code, err) == (0, "")
    assert out.startswith("Usage: ")


@pytest.mark.slow
def test_a_folder_with_pictures_is_many_inputs_for_every_part(shapespline, tmp_path):
    sources, results, pictures = (tmp_path / name for name in ("in", "out", "pics"))
    for folder in (sources, results, pictures):
        folder.mkdir()
    for name in ("a", "b"):
        np.savetxt(sources / f"{name}.csv", flower(120).points, delimiter=",")
    arguments = ["-o", results, "--format", "svg", "--plot", pictures, "--tolerance", "0.1"]
    code, _, err = shapespline("fit", sources, *arguments)
    assert (code, err) == (0, "")
    assert sorted(path.name for path in results.iterdir()) == ["a.svg", "b.svg"]
    assert sorted(path.name for path in pictures.iterdir()) == ["a.csv.png", "b.csv.png"]


def test_what_an_estimate_is_made_of_is_said_and_nothing_of_what_was_asked_for(
    shapespline, tmp_path
):
    part, output = tmp_path / "part.csv", tmp_path / "part.json"
    np.savetxt(part, bracket("1 % strays"), delimiter=",")
    _, out, _ = shapespline("fit", part, "--closed", "-o", output)
    assert "16 points, estimated: 6 lines, 5 arcs, data and curve within" in out
    _, out, _ = shapespline("fit", HAND, "-n", "24", "-o", output)
    assert "estimated" not in out
    _, out, _ = shapespline("fit", HAND, "-t", "0.5", "-o", output)
    assert "estimated" not in out
