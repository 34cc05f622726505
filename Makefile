# Everything runs in .venv, made on first use from the versions in constraints.txt.
PYTHON ?= python3
BIN := .venv/bin
USED := .venv/used-installed
INSTALLED := .venv/installed
PEERS := .venv/peers-installed
# The checker of the pages' scripts, of package.json; only where npm is.
SCRIPTS := node_modules/installed
# Tests of words, files and pages, in which no number depends on how a processor rounds.
WORDS := check cli dh documents errors exam fuzz malformed misuse notebooks pages plots project public xacro

# Bytecode is kept: without it each process of a test compiles the package again.
unexport PYTHONDONTWRITEBYTECODE

.PHONY: exam test sweep portable check notebooks pictures docs coverage fuzz bench clean

exam: $(USED)  ## solve the exam of 13 January 2025 and check every published value
	$(BIN)/robotics1 exam

test: $(INSTALLED)  ## the tests, in minutes; pictures of the pages are kept in build/pictures
	ROBOTICS1_PICTURES=build/pictures $(BIN)/python -m pytest -n auto --dist loadfile

sweep: $(INSTALLED)  ## what takes longer: every arm, more examples of each property, an installed wheel, mutants of robot files
	$(BIN)/python -m pytest -n auto --dist loadfile -m "sweep or hypothesis" --hypothesis-profile=sweep
	$(BIN)/python tests/mutations.py --count 10000 --seed 1
	$(BIN)/python tests/arms_at_random.py --count 100

portable: $(INSTALLED)  ## the numeric tests as an older processor computes them, which rounds otherwise
	OPENBLAS_CORETYPE=Nehalem NPY_DISABLE_CPU_FEATURES="X86_V3 X86_V4 AVX512_ICL AVX512_SPR" \
	$(BIN)/python -m pytest -n auto --dist loadfile $(WORDS:%=--ignore-glob='tests/test_%*.py')

check: $(INSTALLED)  ## style, types, layers, the scripts of the pages
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/lint-imports
	@if command -v npm >/dev/null; then $(MAKE) --no-print-directory $(SCRIPTS) && npm run --silent lint; \
	else echo "npm is not installed, so the scripts of the pages are not checked"; fi

$(SCRIPTS): package.json
	npm install --no-package-lock --no-audit --no-fund --silent
	touch $@

notebooks: $(INSTALLED)  ## execute the notebooks
	$(BIN)/python -m pytest tests/test_notebooks.py

pictures: $(INSTALLED)  ## the pictures of the pages in docs/pictures, made by the tests of the pages
	mkdir -p docs/pictures
	ROBOTICS1_PICTURES=docs/pictures $(BIN)/python -m pytest -m "" tests/test_page_robots.py tests/test_page_motion.py \
	    -k "ur5 or rendezvous"

docs: $(INSTALLED)  ## the pages as a site, in build/docs; a warning, as of a broken link, is an error
	$(BIN)/python -m sphinx -W --keep-going -q -b html docs build/docs

coverage: $(INSTALLED)  ## tests with a coverage report
	$(BIN)/python -m pytest -n auto --dist loadfile --cov --cov-report=term-missing:skip-covered

# What a user installs; the developers' tools come on top, when they are needed.
$(USED): pyproject.toml constraints.txt
	$(PYTHON) -m venv .venv
	$(BIN)/python -m pip install --quiet --no-compile --constraint constraints.txt --editable '.[viewer,plots]'
	touch $@

$(INSTALLED): $(USED)
	$(BIN)/python -m pip install --quiet --constraint constraints.txt --editable '.[dev]'
	touch $@

fuzz: $(INSTALLED)  ## 300 arms drawn at random, and 100 000 mutants of robot files, in child processes
	$(BIN)/python tests/arms_at_random.py --count 300
	$(BIN)/python tests/mutations.py --count 100000 --seed 1

bench: $(PEERS)  ## benchmarks beside the peers, some ten minutes; writes benchmarks/results
	$(BIN)/python benchmarks/formulas.py
	$(BIN)/python -m benchmarks.inverse_kinematics
	$(BIN)/python -m benchmarks.all_solutions
	$(BIN)/python -m benchmarks.scans
	$(BIN)/python -m benchmarks.maps
	$(BIN)/python -m benchmarks.workspaces
	$(BIN)/python -m benchmarks.scaling
	$(BIN)/python -m benchmarks.command_line

$(PEERS): $(INSTALLED)
	$(BIN)/python -m pip install --quiet --constraint constraints.txt --editable '.[dev,bench]'
	touch $@

clean:
	rm -rf .venv node_modules build dist docs/_made docs/reference exam_2025_01_13.html .pytest_cache .mypy_cache .ruff_cache .import_linter_cache
