# Acus. `make demo` and `make test` do everything on a fresh Debian or Ubuntu machine.

PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
PIP := $(BIN)/python -m pip install --quiet --disable-pip-version-check --constraint constraints.txt
TRAINER := $(VENV)/.trainer
TESTS := $(VENV)/.tests

.PHONY: setup extra demo run test test-long test-all test-changed by-hand careless load soak twin check bench trial fuzz kills accuracy firmware promises tests-page portraits docs docs-pictures looks spelling wheel wheels sbom deb try-deb wheelhouse kit clean

setup: $(TESTS)  ## make .venv with all that tests and checks need, and install what the system lacks

$(TRAINER): pyproject.toml constraints.txt tools/install-system
	./tools/install-system
	test -x $(BIN)/python || $(PYTHON) -m venv $(VENV)
	$(PIP) --editable '.[trainer]'
	touch $@

$(TESTS): $(TRAINER)
	./tools/install-system tests
	$(PIP) --editable '.[dev]'
	touch $@

extra: $(TRAINER)  ## the packages of one extra, such as NAME=arm
	$(PIP) --editable '.[$(NAME)]'

demo: $(TRAINER)  ## the trainer on the built-in patient; with no display a whole exercise, written to out/demo
	$(BIN)/acus demo $(DEMO)

# In a checkout attempts stay with it; `acus run` keeps them in the user's own data folder.
run: export ACUS_SESSIONS ?= $(CURDIR)/sessions
run: $(TRAINER)  ## the trainer, with its attempts in sessions/
	$(BIN)/acus run

# One more than there are cores: a test of pauses waits more than it computes.
WORKERS ?= $(shell expr $$(nproc) + 1)
# A test of real time can miss its moment when the machine is busy with others: what fails is run
# once more, and named at the end; what fails twice has failed.
AGAIN := --reruns 1 --reruns-delay 2 -rR
# A process of the tests that dies ends the run; with another in its place pytest-xdist would wait
# for ever for the tests of the dead one's file. All are run once more then, and it is said.
DEATHS := --max-worker-restart 0
PYTEST := ./tools/twice-if-killed ./tools/with-display $(BIN)/python -m pytest -q --numprocesses $(WORKERS) --dist loadfile \
	--no-loadscope-reorder --durations 20 --durations-min 0.5 $(AGAIN) $(DEATHS)
# Every process of the tests, and every program that one starts, reads what is compiled already.
test test-long test-changed: export PYTHONDONTWRITEBYTECODE =
test: setup  ## all but the long tests (no display and no network needed), a file at a time in each process
	$(BIN)/python -m tools.compile_kernels
	$(PYTEST) -m "not long" $(TEST)

test-long: setup  ## the others: statistics, journeys through real programs, long runs of machines
	$(BIN)/python -m tools.compile_kernels
	$(PYTEST) -m long $(TEST)

test-all: test test-long  ## every test

SINCE ?= HEAD
test-changed: setup  ## of `make test` what the changes since a commit can reach: SINCE=main
	$(BIN)/python -m tools.compile_kernels
	files=$$($(BIN)/python -m tools.changed_tests $(SINCE)) && $(PYTEST) -m "not long" $$files $(TEST)

by-hand: setup  ## one insertion in the real window with mouse and keyboard, on an X server of its own
	env -u DISPLAY ACUS_BY_HAND=1 ./tools/with-display $(BIN)/python -m pytest -q tests/display

MINUTES ?= 10
SEED ?= 1
careless: setup  ## the real window used at random by mouse and keyboard, and checked after every action
	$(BIN)/python -m tests.careless --minutes $(MINUTES) --seed $(SEED) $(CARELESS)

TWIN ?= --minutes 10
twin: setup  ## every part of a laboratory on one computer, each killed, hung and restarted: TWIN="--parts robot,slicer"
	$(BIN)/python -m tests.twin $(TWIN)

LOAD ?= --stations 50 --attempts 20
load: setup  ## stations that share a store while everything breaks, and what they end with: LOAD="--stations 8"
	$(BIN)/python -m tests.load $(LOAD)

SOAK ?= 60
soak: setup  ## an hour of random motion in virtual time, another scene every 5 s, then ten minutes of rest
	$(BIN)/python -m tests.soak --minutes $(SOAK) --seed $(SEED)

check: setup  ## style, types, structure
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/lint-imports
	$(BIN)/python -m tools.structure --check
	$(BIN)/python -m tools.words
	$(BIN)/python -m tools.translations

bench: setup  ## every figure against its peer, in one run
	./tools/with-display $(BIN)/python -m tests.bench $(BENCH)

SEEDS ?= 100
trial: setup  ## what five skills score in every exercise that ships; an hour or more, goes on where it stopped
	$(BIN)/python -m tools.trial_table --seeds $(SEEDS) $(TRIAL)

KILLS ?= 1000
SECONDS ?= 86400
kills: setup  ## programs killed at every step and at any moment, and what the next start finds
	$(BIN)/python -m tests.kills --kills $(KILLS) --seconds $(SECONDS) --seed $(SEED)

fuzz: setup  ## ten thousand mutated files of every kind through their readers
	$(BIN)/python -W ignore -m tests.fuzz $(FUZZ)

docs-pictures: setup  ## the pictures of README and docs
	./tools/with-display $(BIN)/python -m tools.docs_pictures

spelling: setup  ## the words of every language by hunspell and its dictionaries, where they are installed
	$(BIN)/python -m tools.spelling

looks: setup  ## every page and state in all sizes, languages and themes, judged by rules and compared: out/looks/index.html
	./tools/with-display $(BIN)/python -m tools.looks $(LOOKS)

accuracy: setup  ## docs/accuracy from the tables that `acus study all --write` keeps
	$(BIN)/python -m tools.accuracy_pages
	$(BIN)/python -m tools.published_page

wheels: setup  ## whether every package has a wheel for Windows and macOS; asks the package index
	$(BIN)/python -m tools.wheels

firmware:  ## the board's program for each chip, in out/firmware
	$(MAKE) -C firmware

promises: setup  ## docs/promises.md from the marks of the tests that hold them
	$(BIN)/python -m tools.promises

tests-page: setup  ## docs/tests.md from the marks of the long tests
	$(BIN)/python -m tools.long_tests

portraits: setup  ## pictures of the shipped exercises' patients, which the start page shows at once
	$(BIN)/python -m tools.portraits

docs: setup  ## the user guide as a site, in app/site: Help and F1 open it
	NO_MKDOCS_2_WARNING=1 $(BIN)/python -m mkdocs build --quiet --strict

wheel: docs  ## a wheel that runs anywhere, with the user guide in it
	$(BIN)/python -m build --wheel

kit: setup  ## the hardware kit: numbers of the profiles, print files and pictures, in out/kit
	./tools/with-display $(BIN)/python -m tools.kit --stl --pictures

sbom: setup  ## what the trainer consists of as CycloneDX, with digests and licences; asks the package index
	$(BIN)/python -m tools.sbom

try-deb:  ## that package as a stranger has it, in a Debian of its own: installed, used, installed again, removed
	./tools/try-deb

deb: wheel  ## a Debian package with the trainer, its own environment and a menu entry: dist/acus_*.deb
	$(BIN)/python -m tools.deb

wheelhouse: wheel  ## zips to install from without a network on Windows and macOS: WHEELHOUSE="--system macos-arm64"
	$(BIN)/python -m tools.wheelhouse $(WHEELHOUSE)

clean:
	rm -rf $(VENV) build dist out app/site
