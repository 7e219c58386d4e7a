# make demo: set up and reproduce the paper.  make test: set up and run the tests, in five minutes (make test-slow: the slow
# ones; make test-all: all, with the long ones, which take minutes each).
# make quick: the tests that an edit can break.  make app: the page in the browser.
.PHONY: app demo test test-slow test-all quick quick-map lint types layers js docs pages bench hostile mutate mutate-check constraints floors readme rooms interpreter interpreter-check \
	screenshots dist release trials workflows clean

.DEFAULT_GOAL := demo

PYTHON ?= python3
BIN := .venv/bin
READY := .venv/.ready

# uv, which installs in a fifth of the time of pip: that of the machine, or one in out/
UV := $(or $(shell command -v uv 2>/dev/null),out/uv/bin/uv)

out/uv/bin/uv:
	@$(PYTHON) -m venv out/uv && out/uv/bin/python -m pip install --quiet --disable-pip-version-check uv

$(READY): pyproject.toml constraints.txt
	@echo "setting up .venv (half a minute, or two)"
	@{ $(MAKE) --silent $(UV) && \
		$(UV) venv --quiet --allow-existing --seed --python $(PYTHON) .venv && \
		$(UV) pip install --quiet --python $(BIN)/python --require-hashes --requirement constraints.txt; \
	} || { \
		echo "uv could not: pip installs, which takes longer" >&2; \
		$(PYTHON) -m venv .venv && \
		$(BIN)/python -m pip install --quiet --disable-pip-version-check --require-hashes --requirement constraints.txt; \
	}
	@$(BIN)/python -m pip install --quiet --disable-pip-version-check --no-deps --no-build-isolation --editable .
	@touch $@

# all versions with their hashes: constraints.txt, floors.txt with the oldest that pyproject.toml allows, and those of the
# container; new versions by UPGRADE=--upgrade
COMPILE := $(UV) pip compile --quiet --universal --python-version 3.11.5 --generate-hashes --no-emit-index-url --no-annotate \
	--custom-compile-command "make constraints"

constraints: $(UV)
	$(COMPILE) $(UPGRADE) --extra dev pyproject.toml --output-file constraints.txt
	$(COMPILE) $(UPGRADE) --extra calibrate --extra cluster --extra data --extra fast --extra test --extra web --resolution lowest-direct pyproject.toml --output-file floors.txt
	$(COMPILE) --constraint constraints.txt --extra fast --extra web pyproject.toml --output-file tools/container/requirements.txt

# the tests of what leans on other packages most, with the oldest of them
floors: $(UV)
	@$(UV) venv --quiet --clear --python $(PYTHON) out/floors
	@$(UV) pip install --quiet --python out/floors/bin/python --require-hashes --requirement floors.txt
	@$(UV) pip install --quiet --python out/floors/bin/python --no-deps --no-build-isolation --editable .
	out/floors/bin/python -m pytest -n 0 -k "not killed" tests/golden tests/compiler/kernels tests/faces/cli/test_cli.py tests/engine/sweeps/test_store.py \
		$(addprefix tests/cases/,test_catalogue.py test_duty_case.py test_nut_cases.py test_uncertain_value.py)

demo: $(READY)
	$(BIN)/ballscrew reproduce olaru2005 --out out/olaru2005

app: $(READY)
	$(BIN)/ballscrew serve --open

test: $(READY)
	$(BIN)/pytest

# the tests that an edit can break, as many as fit into a minute: chosen by a map of what each test runs, which
# make quick-map measures in twenty minutes. SINCE=commit: where the edit began; SECONDS=40: of the tests, without their start
quick: $(READY)
	@$(BIN)/python tools/mutation/quick.py --since $(or $(SINCE),HEAD) --seconds $(or $(SECONDS),40)

# what takes more than a second or two: browsers, every page and command of the docs, the API by its own description
test-slow: $(READY)
	$(BIN)/pytest -m "slow and not long"

quick-map: $(READY)
	$(BIN)/python tools/mutation/quick.py --measure

test-all: $(READY)
	$(BIN)/pytest -m "slow or not slow" --hypothesis-profile=long

lint: $(READY)
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .

types: $(READY)
	$(BIN)/basedpyright

layers: $(READY)
	$(BIN)/lint-imports

# the page in the browser: types, against the API as it describes itself, and lint
NODE_READY := tools/page/node_modules/.ready

$(NODE_READY): tools/page/package.json tools/page/package-lock.json
	cd tools/page && npm install --silent --no-save
	@touch $@

js: $(READY) $(NODE_READY)
	$(BIN)/python tools/page/openapi.py tools/page/api.json
	cd tools/page && npm run --silent check

# what programs make for the pages, written into them: outputs of commands, tables, figures, numbers, formulas. One page
# by PAGE=howto/duty; CHECK=1 only compares; UNLESS_STAMPED=1 does nothing where no file has changed since all were written
pages: $(READY)
	OPENBLAS_NUM_THREADS=1 $(BIN)/python docs/writer/write.py $(if $(CHECK),--check) $(if $(UNLESS_STAMPED),--unless-stamped) $(PAGE)

# into out/docs, with the static page beside it, which takes most of the time, and out/cheat_sheet.pdf
# What is written while a build goes on is not whole: out/docs/.built stands from its end to the next
docs: $(READY)
	@rm -f out/docs/.built
	$(BIN)/sphinx-build -W --keep-going -q -j auto -b html docs out/docs
	@touch out/docs/.built
	$(BIN)/python docs/make_cheat_sheet.py out/cheat_sheet.pdf
	$(BIN)/python -m pytest -q -n 0 -k built tests/docs/test_links.py

readme: $(READY)
	OPENBLAS_NUM_THREADS=1 $(BIN)/python docs/writer/write.py ../README start equations

rooms: $(READY)
	$(BIN)/python docs/make_rooms.py

# one-line changes of the source, a sample of them: which do the tests notice?
mutate: $(READY)
	$(BIN)/python tools/mutation/mutate.py --sample $(or $(SAMPLE),400) --seed $(or $(SEED),1)

# a dozen of them, of a room whose tests are quick; what is changed elsewhere leaves them as they are
mutate-check: $(READY)
	$(BIN)/python tools/mutation/mutate.py --check --sample 12 --seed 1 --rooms sizing

# the prebuilt interpreter and FMU of exports: for Linux on x86-64 by gcc, for other platforms cross-compiled by zig, and
# never run; and the solver of the balls for the static page. The same sources and the same compilers give the same bytes
C_SOURCES := src/ballscrew/data/exports
C_FILES := $(C_SOURCES)/ballscrew_*.c $(C_SOURCES)/fmi*.c
C_FLAGS := -std=c99 -O2 -Wall -Wextra -pedantic -Werror -shared -fvisibility=hidden -s
ZIG := out/zig/bin/python -m ziglang cc

out/zig:
	@$(PYTHON) -m venv out/zig && out/zig/bin/python -m pip install --quiet --disable-pip-version-check ziglang==0.17.1

# where its libraries go
INTO := $(C_SOURCES)
LIBRARIES := linux64/ballscrew.so aarch64-linux/ballscrew.so win64/ballscrew.dll darwin64/ballscrew.dylib \
	aarch64-darwin/ballscrew.dylib wasm32/loads.wasm

interpreter: out/zig
	mkdir -p $(INTO)/linux64 $(INTO)/win64 $(INTO)/darwin64 $(INTO)/aarch64-darwin $(INTO)/aarch64-linux $(INTO)/wasm32
	gcc $(C_FLAGS) -fPIC -Wl,--build-id=none -include tools/exports/old_glibc.h $(C_FILES) -o $(INTO)/linux64/ballscrew.so -lm
	$(ZIG) $(C_FLAGS) -fPIC -target aarch64-linux-gnu.2.17 $(C_FILES) -o $(INTO)/aarch64-linux/ballscrew.so -lm
	$(ZIG) $(C_FLAGS) -target x86_64-windows-gnu $(C_FILES) -o $(INTO)/win64/ballscrew.dll
	$(ZIG) $(C_FLAGS) -target x86_64-macos -Wl,-install_name,@rpath/ballscrew.dylib $(C_FILES) -o $(INTO)/darwin64/ballscrew.dylib
	$(ZIG) $(C_FLAGS) -target aarch64-macos -Wl,-install_name,@rpath/ballscrew.dylib $(C_FILES) -o $(INTO)/aarch64-darwin/ballscrew.dylib
	rm -f $(INTO)/win64/*.lib $(INTO)/win64/*.pdb
	$(ZIG) -std=c99 -O2 -Wall -Wextra -pedantic -Werror -s -target wasm32-wasi -mexec-model=reactor -Wl,--import-memory \
		-Wl,-z,stack-size=65536 -Wl,--export=loads -Wl,--export=__heap_base $(C_SOURCES)/site_loads.c $(C_SOURCES)/ballscrew_loads.c -o $(INTO)/wasm32/loads.wasm
	cat $(C_FILES) $(C_SOURCES)/site_*.c $(C_SOURCES)/ballscrew_*.h $(C_SOURCES)/fmi*.h | sha256sum | cut -d " " -f 1 > $(INTO)/sources.sha256

# the libraries built once more, and compared byte by byte with those of the package
interpreter-check:
	rm -rf out/interpreter
	$(MAKE) interpreter INTO=out/interpreter
	@for file in $(LIBRARIES) sources.sha256; do \
		cmp out/interpreter/$$file $(C_SOURCES)/$$file || exit 1; \
		echo "the same bytes: $$file"; \
	done

# dist/*.whl and dist/*.tar.gz, built twice, their libraries compiled again, their files compared with tools/release/rules.toml;
# PUBLISH=1 also refuses what must not be published
RELEASE_TOOLS := out/release/tools

$(RELEASE_TOOLS)/.ready: tools/release/requirements.txt
	@$(PYTHON) -m venv $(RELEASE_TOOLS)
	@$(RELEASE_TOOLS)/bin/python -m pip install --quiet --disable-pip-version-check --requirement tools/release/requirements.txt
	@touch $@

dist: $(READY) $(RELEASE_TOOLS)/.ready
	@rm -rf out/interpreter
	@$(MAKE) --silent interpreter INTO=out/interpreter
	$(BIN)/python tools/release/dist.py --twine $(RELEASE_TOOLS)/bin/twine $(if $(PUBLISH),--publish)

# shows what make release VERSION=0.2.0 would commit and tag; DO=1 does it
release: $(READY)
	@$(BIN)/python tools/release/release.py $(or $(VERSION),$(error VERSION: not given: make release VERSION=0.2.0)) $(if $(DO),--do)

# the wheel of dist/ into empty environments: no extras, each extra alone, oldest and pinned packages
trials: $(UV)
	$(PYTHON) tools/release/trials.py --uv $(UV) $(if $(ONLY),--only $(ONLY))

# the workflows, forms and hooks, by the linters of their makers
workflows: $(RELEASE_TOOLS)/.ready
	$(RELEASE_TOOLS)/bin/check-jsonschema --builtin-schema vendor.github-workflows .github/workflows/*.yml
	$(RELEASE_TOOLS)/bin/check-jsonschema --builtin-schema vendor.github-issue-forms $(filter-out %/config.yml,$(wildcard .github/ISSUE_TEMPLATE/*.yml))
	$(RELEASE_TOOLS)/bin/check-jsonschema --builtin-schema vendor.github-issue-config .github/ISSUE_TEMPLATE/config.yml
	$(RELEASE_TOOLS)/bin/check-jsonschema --builtin-schema vendor.dependabot .github/dependabot.yml
	$(RELEASE_TOOLS)/bin/pre-commit validate-config .pre-commit-config.yaml
	$(RELEASE_TOOLS)/bin/zizmor --offline --quiet --persona pedantic .github

screenshots: $(READY)
	$(BIN)/python docs/make_screenshots.py

bench: $(READY)
	$(BIN)/python benchmarks/engine.py
	$(BIN)/python benchmarks/reference.py
	$(BIN)/python benchmarks/four_point.py

# random, mutated and damaged input for up to 25 minutes; fewer by SCALE=0.01. Writes the table of docs/reliability.md
SCALE ?= 1

hostile: $(READY)
	$(BIN)/python -m benchmarks.hostile --scale $(SCALE)

clean:
	rm -rf .venv out build dist
