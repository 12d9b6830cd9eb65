# Needs make, and Python 3.11 or later with venv.  `make PYTHON=python3.12 lab` names another Python.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
# The small matrices of these searches are slower on two threads than on one.
export OPENBLAS_NUM_THREADS := 1
# Native code that tests make is not kept with that of the user.
test test-tools bench notebooks: export CAMKIT_CACHE := $(CURDIR)/.native
# Lessons have the numbers of this learner, and keep nothing.
test test-tools bench notebooks: export CAMKIT_LEARNER := instructor
# Byte code is kept, whatever the user's settings: a hundred kernels import the same.
test test-tools bench notebooks: export PYTHONDONTWRITEBYTECODE :=

PIP_INSTALL := $(BIN)/python -m pip install --quiet --disable-pip-version-check -c constraints.txt

# More options for JupyterLab: make lab LAB="--no-browser --port=8899"
LAB :=

# JupyterLab refuses to run as root unless told so.
AS_ROOT := $(if $(filter 0,$(shell id -u)),--allow-root)

# Two processes, each with a notebook, or with a file of tests, at a time: what is shared is made once.
NOTEBOOKS := $(BIN)/python -m pytest -n 2 --dist loadscope
# nbval, which takes seconds to load, is for the notebooks.
PYTEST := $(NOTEBOOKS) -p no:nbval
# Whichever process is done takes over some of the other's tests: none waits while a long file is gone through.
SPREAD := $(PYTEST) --dist worksteal

# The files in tests/browser as conftest.py there puts them, the slowest first, so that both processes end together.
BROWSER := $(PYTEST) --no-loadscope-reorder

# Coverage is asked of the maths alone, and of doctests and tests that between them go through it: watched, a test takes nearly
# twice as long.  The tests of a new module of the maths join them.
WATCHED := camkit $(patsubst %,tests/course/test_%.py,editions exercises records) tests/decision \
    tests/dynamics tests/linkage tests/papers tests/study tests/views tests/machines/test_high_speed.py \
    $(patsubst %,tests/test_%.py,command_line geometry markup package quantities units) \
    $(patsubst %,tests/cam/test_%.py,barrel closing followers impacts oscillating_roller outlines pair pins surfaces zones) \
    $(patsubst %,tests/files/test_%.py,blank decisions drawing export faults free_menus gcode hostile_exports motion_tables) \
    $(patsubst %,tests/files/test_%.py,motions outline_files own_laws_in_files report schema sessions_of_old solids to_workshop) \
    $(patsubst %,tests/files/test_%.py,tolerance_files workshop_tables) \
    $(patsubst %,tests/motion/test_%.py,acceleration_first matched_programs matching motion_laws motion_textbook own_laws tables) \
    $(patsubst %,tests/motion/test_%.py,vibration) $(patsubst %,tests/program/test_%.py,kernel recording) \
    $(patsubst %,tests/search/test_%.py,checkpoint goal_seek minimise options rates resume threads)

# Strict: every output is compared with the one stored, in the environment of this Python.
NBVAL := --nbval --nbval-current-env --nbval-sanitize-with tests/nbval_sanitize.cfg --nbval-cell-timeout 300

# What needs large tools is tested apart, in tests/tools/<tool>, each in a small environment of its own; NEEDS_<tool> is
# what is installed for it.
TOOLS := $(notdir $(wildcard tests/tools/*))
NEEDS_step := .[step]
NEEDS_print := .[print] lib3mf
NEEDS_report := .[report]
NEEDS_gcode := .
NEEDS_docs := .[docs]
NEEDS_course := .[report] otter-grader[grading] nbgrader nbconvert nbformat
# What a tool needs in another version than all others do.
LOOSE_course := wrapt
NEEDS_cluster := .[cluster]
NEEDS_notebook7 := .[lab] notebook playwright
NEEDS_wheel := . build hatchling

.PHONY: help lab app docs test test-tools lint bench notebooks constraints clean

help:
	@echo "make lab        open the workbook in JupyterLab (installs what it needs into $(VENV) first)"
	@echo "                LAB=... gives JupyterLab more options, such as LAB='--no-browser --port=8899'"
	@echo "make app        show the notebooks as pages without code, each with a kernel of its own (Voila);"
	@echo "                for this machine alone unless HOST=... names another address to listen on"
	@echo "make test       run all checks: style, types, imports, tests, notebooks, browser"
	@echo "make test-tools run the checks that need large tools: solids, G-code, reports, graders (each in .tools/<tool>)"
	@echo "make docs       make the site: notebooks, gallery, choices from measurements, theory, every public name"
	@echo "make lint       run the quick checks only: style, types, imports"
	@echo "make bench      measure speed"
	@echo "make notebooks  run every notebook again and store its outputs"
	@echo "make clean      remove caches (not $(VENV))"

# The settings in .jupyter are defaults of this JupyterLab alone: widgets are saved with their notebook, no news.
# What you set yourself, in this JupyterLab or in another one, comes before them.
LAB_SETTINGS := JUPYTER_CONFIG_PATH="$(CURDIR)/.jupyter$${JUPYTER_CONFIG_PATH:+:$$JUPYTER_CONFIG_PATH}"

lab: $(VENV)/.lab
	@echo "Opening notebooks/00_start_here.ipynb in JupyterLab in your browser; Ctrl-C here, twice, ends it."
	$(LAB_SETTINGS) $(BIN)/jupyter lab $(AS_ROOT) $(LAB) notebooks/00_start_here.ipynb

# The pages' templates are in .jupyter/voila.  Read "Publishing" in README.md before naming another HOST.  The limits are in notebooks/voila.json.
HOST := 127.0.0.1

app: $(VENV)/.app
	@echo "Opening the notebooks as cards in your browser; a page fills while its notebook runs. Ctrl-C here ends it."
	JUPYTER_PATH="$(CURDIR)/.jupyter$${JUPYTER_PATH:+:$$JUPYTER_PATH}" $(BIN)/voila notebooks --Voila.ip=$(HOST) --Voila.config_file_paths=notebooks

# Warnings, links that lead nowhere and anything that a page would ask of a network are errors.
docs: .tools/docs/.ready
	.tools/docs/bin/python -m sphinx -q -W --keep-going -j 2 docs .site
	@echo "The site is in .site: open .site/index.html in a browser."

test: lint
	@echo "== doctests, and tests that go through the maths: coverage (pytest)"
	$(SPREAD) $(WATCHED) --cov --cov-report=term-missing:skip-covered
	@echo "== all other tests: panels, pictures, long searches, tables of cases (pytest)"
	$(SPREAD) tests $(addprefix --ignore=,$(WATCHED) tests/browser)
	@echo "== every notebook gives its stored outputs (pytest with nbval)"
	$(NOTEBOOKS) $(NBVAL) notebooks
	@echo "== sliders and panels in JupyterLab in Chromium (pytest with Playwright)"
	$(BROWSER) -m browser tests/browser

# Solids, G-code and reports, read by the programs that a workshop reads them with; lessons, by those that grade them.
test-tools: $(TOOLS:%=.tools/%/.ready)
	@for tool in $(TOOLS); do \
	    echo "== what large tools read: $$tool (pytest in .tools/$$tool)"; \
	    .tools/$$tool/bin/python -m pytest -p no:cacheprovider -n 2 tests/tools/$$tool/test_*.py || exit 1; \
	done

.tools/%/.ready: pyproject.toml constraints.txt | $(BIN)/python
	@echo "Installing what the checks of $* need into .tools/$*; the first time takes a minute or two."
	$(BIN)/python -m venv .tools/$*
	grep -vE "^($(or $(LOOSE_$*),none))==" constraints.txt > .tools/$*/constraints.txt
	.tools/$*/bin/python -m pip install --quiet --disable-pip-version-check -c .tools/$*/constraints.txt pytest pytest-xdist -e $(NEEDS_$*)
	@touch $@

lint: $(VENV)/.test
	@echo "== errors and habits (ruff check)"
	$(BIN)/ruff check
	@echo "== layout of the code (ruff format)"
	$(BIN)/ruff format --check
	@echo "== types (mypy)"
	$(BIN)/mypy
	@echo "== imports point down only (import-linter)"
	$(BIN)/lint-imports

bench: $(VENV)/.test
	$(BIN)/python -m pytest benchmarks --benchmark-only

# Widget state and timings would change at every run, so they are not stored.  JupyterLab marks a notebook unsaved
# unless it says its language as the kernel does.
notebooks: $(VENV)/.test
	$(BIN)/jupyter nbconvert --to notebook --execute --inplace \
	    --ExecutePreprocessor.store_widget_state=False --ExecutePreprocessor.record_timing=False \
	    --ClearMetadataPreprocessor.enabled=True --ClearMetadataPreprocessor.clear_cell_metadata=False \
	    --ClearMetadataPreprocessor.preserve_nb_metadata_mask=kernelspec \
	    --ClearMetadataPreprocessor.preserve_nb_metadata_mask=language_info \
	    notebooks/*.ipynb notebooks/course/*.ipynb
	$(BIN)/python .jupyter/cards.py notebooks

# After an upgrade by hand in .venv: writes down what is installed there, camkit itself left out, and what only the
# environments of the tools have.  The first line of a package, that of .venv, is the one that is kept.
constraints: $(VENV)/.test $(TOOLS:%=.tools/%/.ready)
	for bin in $(BIN) $(TOOLS:%=.tools/%/bin); do $$bin/python -m pip freeze --exclude-editable --exclude camkit; done \
	    | LC_ALL=C sort -f -s -u -t= -k1,1 | LC_ALL=C sort -f > constraints.txt
	touch $(VENV)/.lab $(VENV)/.app $(VENV)/.test $(TOOLS:%=.tools/%/.ready)

clean:
	rm -rf build dist .site docs/api docs/notebooks .browser .native .camkit notebooks/.camkit .benchmarks .coverage .hypothesis .import_linter_cache .mypy_cache .pytest_cache .ruff_cache
	find camkit tests benchmarks notebooks -name __pycache__ -o -name .ipynb_checkpoints | xargs rm -rf


# A stamp file says that its extra is installed, so a second call starts at once.
$(VENV)/.lab $(VENV)/.app $(VENV)/.test: $(VENV)/.%: pyproject.toml constraints.txt | $(BIN)/python
	@echo "Installing camkit with all that 'make $*' needs into $(VENV); the first time takes a minute or two."
	$(PIP_INSTALL) -e '.[$*]'
	@touch $@

$(BIN)/python:
	@for python in "$(PYTHON)" python3.13 python3.12 python3.11; do \
	    if $$python -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null; then \
	        echo "Making the virtual environment $(VENV) with $$($$python --version)."; \
	        $$python -m venv $(VENV) && exit 0; \
	        rm -rf $(VENV); \
	        echo "$$python cannot make a virtual environment (on Debian or Ubuntu: apt-get install python3-venv)."; \
	        exit 1; \
	    fi; \
	done; \
	echo "camkit needs Python 3.11 or later, but '$(PYTHON) --version' says: $$($(PYTHON) --version 2>&1)."; \
	echo "Name one that is installed, for example: make PYTHON=/usr/bin/python3.12 $(or $(MAKECMDGOALS),lab)"; \
	exit 1
