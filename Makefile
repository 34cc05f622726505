# Everything runs in .venv, made on first use from the versions in constraints.txt.
PYTHON ?= python3
BIN := .venv/bin
USED := .venv/used-installed
INSTALLED := .venv/installed
PEERS := .venv/peers-installed
# The checker of the pages' scripts, of package.json; only where npm is.
SCRIPTS := node_modules/installed
# Each process begins with its share of the tests, file after file; one that is ready takes some from another.
PYTEST := $(BIN)/python -m pytest -n auto --dist worksteal
OLDER := OPENBLAS_CORETYPE=Nehalem NPY_DISABLE_CPU_FEATURES="X86_V3 X86_V4 AVX512_ICL AVX512_SPR"
# Tests whose answer is a count, a rank, a status, a branch or an order: there the last digit of a number decides.
# What asserts numbers within a tolerance hardly depends on how a processor rounds: `make fuzz` computes that so too.
ROUNDED := all_solutions arm_angle bases_on_branches boundary_by_search cuspidal dh_from_urdf \
    differential_kinematics double_zeros elimination every_root exams_inverse exams_singularity \
    families fewer_joints fractions_of_turns general_six ik_by_priority ik_formulas ik_formulas_drawn \
    jacobian_slopes locus meeting minimum_time minimum_time_joints nearest_miss orientation_axis \
    orientation_euler orientation_pointing planar_loop polynomial postures printed_digits printed_velocities \
    reachability redundancy rigid_motions self_motion singular_set_edges singular_sets_at_limits \
    singular_targets singularity solution_solver solutions solutions_kinds solve_ik solve_ik_honest solve_trig \
    spaces statics surfaces_of_solutions symbolic_singularities textbook_questions time_optimal \
    timing_profiles two_slides units_of_length unreachable workspace workspace_distances workspace_in_space \
    workspace_laws

# Bytecode is kept: without it each process of a test compiles the package again.
unexport PYTHONDONTWRITEBYTECODE

.PHONY: exam test sweep portable check notebooks pictures docs coverage fuzz bench clean

exam: $(USED)  ## solve the exam of 13 January 2025 and check every published value
	$(BIN)/robotics1 exam

test: $(INSTALLED)  ## the tests, in minutes; pictures of the pages are kept in build/pictures
	ROBOTICS1_PICTURES=build/pictures $(PYTEST)

sweep: $(INSTALLED)  ## what takes longer: more arms, brute force, an installed wheel, mutants of robot files
	$(PYTEST) -m "sweep and not fuzz"

portable: $(INSTALLED)  ## the tests in which rounding decides, as an older processor computes them, which rounds otherwise
	$(OLDER) $(PYTEST) $(ROUNDED:%=tests/test_%.py)

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
	$(PYTEST) --cov --cov-report=term-missing:skip-covered

# What a user installs; the developers' tools come on top, when they are needed.
$(USED): pyproject.toml constraints.txt
	$(PYTHON) -m venv .venv
	$(BIN)/python -m pip install --quiet --no-compile --constraint constraints.txt --editable '.[viewer,plots]'
	touch $@

$(INSTALLED): $(USED)
	$(BIN)/python -m pip install --quiet --constraint constraints.txt --editable '.[dev]'
	touch $@

fuzz: $(INSTALLED)  ## before a release, some hours: all cases, 100 examples of each property, 300 arms, 100 000 mutants
	$(PYTEST) -m "fuzz or hypothesis" --hypothesis-profile=fuzz
	$(OLDER) $(PYTEST)
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
