# Everything here sets itself up: an own virtual environment, the compiled kernel, nothing global.
#   make demo    fit a real photograph, an icon and a measured outline; pictures and files
#   make test    every check
#   make docs    the documentation as a site, with its gallery
#   make wheel   what is installed without a compiler, tried in a fresh environment
#   make sanitize    memory and undefined behaviour in the kernel
#   make fuzz    ten minutes of damaged and hostile files for every reader
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
READY := $(VENV)/.ready
IMAGES := examples/data/images
OUTLINES := examples/data/outlines
KERNEL := $(wildcard kernels/bindings/*.[ch]pp kernels/include/shapespline/*/*.hpp)

.PHONY: demo test quick sanitize fuzz lint bench paper figures docs wheel clean
.DEFAULT_GOAL := demo

demo: $(READY)
	@mkdir -p demo-output
	$(BIN)/shapespline fit $(IMAGES)/mdi_leaf-maple_256.png --tolerance 0.5 -o demo-output/leaf.svg --plot demo-output/leaf.png
	$(BIN)/shapespline fit $(IMAGES)/gameicons_jet-fighter_256.png --dpi 96 --tolerance 0.1 -o demo-output/jet.dxf
	$(BIN)/shapespline fit $(IMAGES)/opencv_butterfly.jpg --tolerance 1.5 -o demo-output/butterfly.svg --plot demo-output/butterfly.png
	$(BIN)/shapespline fit $(OUTLINES)/hand620_closed.csv -n 36 -o demo-output/hand.json --plot demo-output/hand.png
	$(BIN)/shapespline paper examples/data/paper/leaf840.csv --length 2 -o demo-output/paper
	@echo "Look into demo-output: SVG opens in a browser or in Inkscape, DXF in CAD; the pictures show the error."

test: lint
	@sh scripts/browser.sh $(BIN)/python
	@sh scripts/typescript.sh $(BIN)/python
	$(BIN)/python -m pytest -q -n logical --dist worksteal

quick: $(READY)
	$(BIN)/python -m pytest -q -n logical --dist worksteal -m "not slow"

# The kernel under AddressSanitizer and UndefinedBehaviorSanitizer: its native tests, the quick suite.
sanitize: $(READY)
	sh scripts/sanitize.sh $(BIN)/python

# What was found lies in bench-output/fuzz.
fuzz: $(READY)
	$(BIN)/python -m benchmarks.fuzz --minutes 10

lint: $(READY)
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy

bench: $(READY)
	$(BIN)/python -m benchmarks

paper: $(READY)
	$(BIN)/python -m benchmarks.paper

figures: $(READY)
	$(BIN)/python -m benchmarks.readme_figures
	$(BIN)/python -m benchmarks.howto_figures
	$(BIN)/python -m benchmarks.picture_options
	$(BIN)/python -m benchmarks.picture_peers
	$(BIN)/python -m benchmarks.engine_figures
	$(BIN)/python -m benchmarks.studio --figures
	$(BIN)/python scripts/rooms_picture.py

docs: $(READY)
	$(BIN)/python -m sphinx -W --keep-going -q -b html -d build/docs/doctrees docs build/docs/html
	@echo "Open build/docs/html/index.html."

wheel: $(READY)
	sh scripts/wheel.sh $(BIN)/python

clean:
	rm -rf $(VENV) build dist docs/_generated demo-output bench-output .pytest_cache .mypy_cache .ruff_cache .hypothesis .benchmarks

$(READY): pyproject.toml CMakeLists.txt src/shapespline/_version.py $(KERNEL)
	@PYTHON="$(PYTHON)" sh scripts/check_tools.sh
	test -x $(BIN)/python || $(PYTHON) -m venv $(VENV)
	@sh scripts/install.sh $(BIN)/python --upgrade pip
	@sh scripts/install.sh $(BIN)/python --editable ".[dev]"
	@touch $(READY)
