# Everything runs in .venv, made on first use from the versions in constraints.txt.
PYTHON ?= python3
BIN := .venv/bin
INSTALLED := .venv/installed
PEERS := .venv/peers-installed

.PHONY: exam test check notebooks coverage fuzz bench clean

exam: $(INSTALLED)  ## solve the exam of 13 January 2025 and check every published value
	$(BIN)/robotics1 exam

test: $(INSTALLED)  ## all tests
	$(BIN)/python -m pytest -n auto

check: $(INSTALLED)  ## style, types, layers
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/lint-imports

notebooks: $(INSTALLED)  ## execute the notebooks
	$(BIN)/python -m pytest tests/test_notebooks.py

coverage: $(INSTALLED)  ## tests with a coverage report
	$(BIN)/python -m pytest -n auto --cov --cov-report=term-missing:skip-covered

$(INSTALLED): pyproject.toml constraints.txt
	$(PYTHON) -m venv .venv
	$(BIN)/python -m pip install --quiet --constraint constraints.txt --editable '.[dev]'
	touch $@

fuzz: $(INSTALLED)  ## 100 000 mutants of robot files, in child processes
	$(BIN)/python tests/mutations.py --count 100000 --seed 1

bench: $(PEERS)  ## benchmarks beside the peers, some ten minutes; writes benchmarks/results
	$(BIN)/python benchmarks/formulas.py
	$(BIN)/python -m benchmarks.inverse_kinematics
	$(BIN)/python -m benchmarks.scans

$(PEERS): $(INSTALLED)
	$(BIN)/python -m pip install --quiet --constraint constraints.txt --editable '.[dev,bench]'
	touch $@

clean:
	rm -rf .venv build dist exam-2025-01-13 .pytest_cache .mypy_cache .ruff_cache .import_linter_cache
