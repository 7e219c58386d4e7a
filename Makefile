# make demo: set up and reproduce the paper.  make test: set up and run the tests.  make app: the page in the browser.
.PHONY: app demo test lint types layers docs bench readme screenshots clean

PYTHON ?= python3
BIN := .venv/bin
READY := .venv/.ready

$(READY): pyproject.toml constraints.txt
	@echo "setting up .venv (a minute or two)"
	@if command -v uv >/dev/null 2>&1; then \
		uv venv --quiet --allow-existing --python $(PYTHON) .venv && \
		uv pip install --quiet --python $(BIN)/python --constraint constraints.txt --editable '.[dev]'; \
	else \
		$(PYTHON) -m venv .venv && \
		$(BIN)/python -m pip install --quiet --disable-pip-version-check --constraint constraints.txt --editable '.[dev]'; \
	fi
	@touch $@

demo: $(READY)
	$(BIN)/ballscrew reproduce olaru2005 --out out/olaru2005

app: $(READY)
	$(BIN)/ballscrew serve --open

test: $(READY)
	$(BIN)/pytest

lint: $(READY)
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .

types: $(READY)
	$(BIN)/basedpyright

layers: $(READY)
	$(BIN)/lint-imports

docs: $(READY)
	$(BIN)/sphinx-build -W --keep-going -q -b html docs out/docs

readme: $(READY)
	$(BIN)/python docs/make_readme.py
	$(BIN)/python docs/make_equation_table.py

screenshots: $(READY)
	$(BIN)/python docs/make_screenshots.py

bench: $(READY)
	$(BIN)/python benchmarks/engine.py
	$(BIN)/python benchmarks/sweep.py
	$(BIN)/python benchmarks/reference.py
	$(BIN)/python benchmarks/four_point.py
	$(BIN)/python benchmarks/loads.py

clean:
	rm -rf .venv out build dist
