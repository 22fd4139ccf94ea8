# Acus. `make demo` and `make test` do everything on a fresh Debian or Ubuntu machine.

PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
STAMP := $(VENV)/.installed

.PHONY: setup demo run test by-hand careless check bench fuzz docs-pictures wheel clean

setup: $(STAMP)  ## make .venv and install what the system lacks

$(STAMP): pyproject.toml constraints.txt tools/install-system
	./tools/install-system
	test -x $(BIN)/python || $(PYTHON) -m venv $(VENV)
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --constraint constraints.txt --editable '.[dev]'
	touch $(STAMP)

demo: setup  ## the trainer on the built-in patient; with no display a whole exercise, written to out/demo
	$(BIN)/acus demo $(DEMO)

run: setup  ## the trainer
	$(BIN)/acus run

test: setup  ## the tests (no display and no network needed), a file at a time on each core
	$(BIN)/python -m tools.compile_kernels
	./tools/with-display $(BIN)/python -m pytest -q --numprocesses auto --dist loadfile $(TEST)

by-hand: setup  ## one insertion in the real window with mouse and keyboard, on an X server of its own
	env -u DISPLAY ACUS_BY_HAND=1 ./tools/with-display $(BIN)/python -m pytest -q tests/display

MINUTES ?= 10
SEED ?= 1
careless: setup  ## the real window used at random by mouse and keyboard, and checked after every action
	$(BIN)/python -m tests.careless --minutes $(MINUTES) --seed $(SEED) $(CARELESS)

check: setup  ## style, types, structure
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/lint-imports

bench: setup  ## every figure against its peer, in one run
	./tools/with-display $(BIN)/python -m tests.bench $(BENCH)

fuzz: setup  ## ten thousand mutated files of every kind through their readers
	$(BIN)/python -W ignore -m tests.fuzz $(FUZZ)

docs-pictures: setup  ## the pictures of README and docs
	./tools/with-display $(BIN)/python -m tools.docs_pictures

wheel: setup  ## a wheel that runs anywhere
	$(BIN)/python -m build --wheel

clean:
	rm -rf $(VENV) build dist out
