# The two commands a user needs: `make run` and `make test`.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
# Two processes test at a time: threads of their libraries would only wait for each other.
ALONE := OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 MKL_NUM_THREADS=1

# `make test` leaves out what is marked long; `make test-all` runs every test.
.PHONY: run test test-all types quick benchmark docs clean

run: $(VENV)/.run
	$(BIN)/clast run configs/crush_grain.yaml

test: $(VENV)/.test
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(MAKE) --jobs=2 types quick

types: $(VENV)/.test
	$(BIN)/mypy

quick: $(VENV)/.test
	$(ALONE) $(BIN)/pytest -n 2 -m "not long"

test-all: $(VENV)/.test
	$(ALONE) $(BIN)/pytest -n 2

benchmark: $(VENV)/.test
	$(BIN)/clast bench --peer lammps

docs: $(VENV)/.docs
	NO_MKDOCS_2_WARNING=1 $(BIN)/mkdocs build
	@echo "site/index.html"

$(VENV)/bin/python:
	$(PYTHON) -m venv $(VENV)

$(VENV)/.run: $(VENV)/bin/python pyproject.toml
	$(BIN)/python -m pip install --quiet --editable .
	touch $@

$(VENV)/.test: $(VENV)/bin/python pyproject.toml
	$(BIN)/python -m pip install --quiet --editable ".[test]"
	touch $(VENV)/.run $@

$(VENV)/.docs: $(VENV)/.run
	$(BIN)/python -m pip install --quiet --editable ".[docs]"
	touch $@

clean:
	rm -rf $(VENV) runs site .mypy_cache .ruff_cache .pytest_cache
