# What can be done here; `make help` lists it.

SHELL := bash
.SHELLFLAGS := -euo pipefail -c
.NOTPARALLEL:
.DEFAULT_GOAL := help

CARGO ?= cargo
PREFIX ?= /usr/local
DESTDIR ?=
TARGET := $(abspath $(or $(CARGO_TARGET_DIR),target))
TOOLS := symdetect wedgecut periodic-surf tetwedge rotassemble meshqual
# Python with meshio, vtk and gmsh, which read meshes independently of this project, and Snakemake, which
# runs a flow: in tests only.
REFEREE := $(TARGET)/referee
FUZZ := tests/fuzz
# Cargo's own tools, where make installs them when they are missing.
TOOLBOX := $(TARGET)/tools/bin

.PHONY: help setup calibrate build build-body demo test check readme check-docs readme-update fmt lint fuzz fuzz-tool audit soak faults bench bench-quick bench-publish bench-programs manual install dist deb wheel clean

help: ## list the targets
	@sed -n 's/^\([a-z-]*\):.*## \(.*\)/  make \1\t\2/p' Makefile | expand -t 20

setup: ## install what is missing: TetGen, a C++ compiler
	@.ci/setup

# All that is built in the release profile is built beside the tools, and no test with it: every library then has
# the same features in each of these targets, and none of them compiles again what another has compiled.
BUILD := $(CARGO) build --release --bins -p symtet

build: setup ## build the tools, release profile, into target/release
	$(BUILD)

demo: setup ## mesh a through-silicon via of three materials, stage by stage, and report its quality
	@echo "Building takes about three minutes on two cores the first time, meshing a few seconds."
	$(BUILD) -p body
	mkdir -p $(TARGET)/demo
	$(MAKE) --no-print-directory -C $(TARGET)/demo -f $(CURDIR)/examples/flows/tsv.mk --always-make BIN=$(TARGET)/release/ \
	  MESHQUAL_FLAGS='--check --html tsv.html'
	@echo
	@echo "In $(TARGET)/demo there are now:"
	@echo "  tsv.stl          the surface that the pipe read"
	@echo "  tsv.*.tmesh      what each stage handed to the next; \`rotassemble --to txt FILE\` lists one"
	@echo "  tsv.vtk          the mesh, for ParaView: paraview $(TARGET)/demo/tsv.vtk"
	@echo "  tsv.html         its quality, with pictures, for a browser: xdg-open $(TARGET)/demo/tsv.html"
	@echo "  tsv.quality.txt  the same as text, as above"

test: setup ## run every test
	@.ci/referee $(REFEREE)
	$(CARGO) build --workspace --bins --tests
	REFEREE=$(REFEREE) $(CARGO) test --workspace

fmt: ## check the formatting
	$(CARGO) fmt --all --check
	$(CARGO) fmt --manifest-path $(FUZZ)/Cargo.toml --check

lint: setup ## run clippy, warnings are errors
	$(CARGO) clippy --workspace --all-targets -- -D warnings
	$(CARGO) clippy --manifest-path $(FUZZ)/Cargo.toml --target-dir $(TARGET) --all-targets -- -D warnings

check: fmt lint test readme ## what CI runs: formatting, lints, every test, what README shows

# Snakemake is there.
README := PATH=$$PATH:$(REFEREE)/bin .ci/readme

# With the tests, as `make test` builds: without them libraries have fewer features, and all are compiled again.
readme: setup ## run what README shows without other programs, and compare; after `make test`, whose binaries it takes
	$(CARGO) build --workspace --bins --tests
	$(README) check --quick --binaries $(TARGET)/debug

check-docs: build-body ## run all that README shows, with CalculiX, Snakemake and dolfinx where they are; minutes
	@.ci/referee $(REFEREE)
	$(README) check --binaries $(TARGET)/release

readme-update: build-body ## the same, and write what comes out into README
	@.ci/referee $(REFEREE)
	$(README) update --binaries $(TARGET)/release

build-body: setup
	$(BUILD) -p body

# Seconds per fuzz target.
SECONDS ?= 60

fuzz-tool:
	@PATH=$(TOOLBOX):$$PATH cargo fuzz --version >/dev/null 2>&1 || $(CARGO) install cargo-fuzz@0.13.2 --locked --root $(TARGET)/tools

fuzz: setup fuzz-tool ## fuzz decoder and readers, SECONDS (default 60) each; TARGETS="stl obj" for some
	$(CARGO) run --quiet --manifest-path $(FUZZ)/Cargo.toml --target-dir $(TARGET)/fuzz --example seeds -- $(TARGET)/fuzz/seeds
	CARGO_TARGET_DIR=$(TARGET)/fuzz PATH=$(TOOLBOX):$$PATH $(CARGO) fuzz build --fuzz-dir $(FUZZ) --sanitizer none --release
	CARGO_TARGET_DIR=$(TARGET)/fuzz $(FUZZ)/run $(SECONDS) $(TARGETS)

audit: ## check licences, sources and known vulnerabilities of all dependencies (cargo-deny)
	@PATH=$(TOOLBOX):$$PATH .ci/audit $(TARGET)/tools

# Number of bodies, seed of the first, trials at the same time, other options of `soak run`.
N ?= 1000
SEED ?= 1
JOBS ?= 1
SOAK_OPTIONS ?=

soak: setup ## send N=1000 random bodies through the whole pipe; goes on where it was interrupted
	$(BUILD) -p soak
	$(TARGET)/release/soak run --count $(N) --seed $(SEED) --jobs $(JOBS) --binaries $(TARGET)/release --out $(TARGET)/soak $(SOAK_OPTIONS)

# How often each fault is injected, in units of what `make test` does.
FAULTS ?= 20

faults: setup ## inject faults into every stage, many times; prints kind, stage, runs and violations
	FAULTS=$(FAULTS) $(CARGO) test --release --test faults -- --nocapture --test-threads 1 | grep -E '^fault|^test result|panicked'

BENCH := python3 examples/benchmark/bench.py
# More options of `bench.py run`, such as --hxt or --stop-after 60.
BENCH_OPTIONS ?=

bench-programs: setup
	$(BUILD) -p body

bench: bench-programs ## measure pipe against direct mesh, every cell: hours; goes on where it was interrupted
	$(BENCH) run --binaries $(TARGET)/release --out $(TARGET)/bench/full $(BENCH_OPTIONS)
	$(BENCH) scaling --binaries $(TARGET)/release --out $(TARGET)/bench/full

bench-quick: bench-programs ## the same with two sets of parameters, within ten minutes
	$(BENCH) run --quick --binaries $(TARGET)/release --out $(TARGET)/bench/quick $(BENCH_OPTIONS)

calibrate: setup ## measure the coefficients that order and hub are chosen by; print them
	$(BUILD) -p body
	$(CARGO) run --release --package estimate --example calibrate -- $(TARGET)/release

bench-publish: ## copy the report of the full benchmark to examples/benchmark/results
	$(BENCH) report --out $(TARGET)/bench/full
	install -d examples/benchmark/results
	install -m 644 $(TARGET)/bench/full/*.{md,csv,json,svg} examples/benchmark/results

MANUAL := $(TARGET)/manual

manual: setup ## write man pages and shell completions into target/manual
	$(BUILD) -p manual
	$(TARGET)/release/manual $(MANUAL)

install: build manual ## install the tools, their man pages and completions under PREFIX (default /usr/local)
	install -d $(DESTDIR)$(PREFIX)/bin $(DESTDIR)$(PREFIX)/share/man/man1
	install -m 755 $(TOOLS:%=$(TARGET)/release/%) tools/symtet/symtet $(DESTDIR)$(PREFIX)/bin
	install -m 644 $(TOOLS:%=$(MANUAL)/man1/%.1) $(DESTDIR)$(PREFIX)/share/man/man1
	install -d $(DESTDIR)$(PREFIX)/share/bash-completion/completions
	install -m 644 $(TOOLS:%=$(MANUAL)/bash/%) $(DESTDIR)$(PREFIX)/share/bash-completion/completions
	install -d $(DESTDIR)$(PREFIX)/share/zsh/site-functions
	install -m 644 $(TOOLS:%=$(MANUAL)/zsh/_%) $(DESTDIR)$(PREFIX)/share/zsh/site-functions
	install -d $(DESTDIR)$(PREFIX)/share/fish/vendor_completions.d
	install -m 644 $(TOOLS:%=$(MANUAL)/fish/%.fish) $(DESTDIR)$(PREFIX)/share/fish/vendor_completions.d

VERSION := $(shell sed -n 's/^version = "\(.*\)"/\1/p' Cargo.toml | head -1)
RELEASE := symtet-$(VERSION)-$(shell uname -m)-$(shell uname -s | tr A-Z a-z)

# What README.md names, with the paths that it has there.
NAMED := README.md ARCHITECTURE.md CHANGELOG.md SECURITY.md LICENSE-APACHE LICENSE-MIT LICENSE-AGPL formats/tmesh/SPEC.md tests/fuzz/README.md \
	$(wildcard formats/tmesh/python/*.py examples/flows/* examples/benchmark/README.md examples/benchmark/results/*)
STAGE := $(TARGET)/dist/$(RELEASE)

dist: setup ## pack the tools, TetGen's library and what README.md names as an archive, into target/dist
	rm -rf $(STAGE)
	$(BUILD) -p body
	$(MAKE) --no-print-directory install PREFIX= DESTDIR=$(STAGE)
	install -m 755 $(TARGET)/release/body $(STAGE)/bin
	packaging/library $(STAGE)
	for file in $(NAMED); do install -D -m 644 $$file $(STAGE)/$$file; done
	tar --sort=name --owner=0 --group=0 --numeric-owner -C $(TARGET)/dist -czf $(STAGE).tar.gz $(RELEASE)
	@echo "$(STAGE).tar.gz"

deb: setup ## pack the tools as a Debian package that takes TetGen from Debian's, into target/dist
	rm -rf $(STAGE)-deb
	$(BUILD) -p body
	$(MAKE) --no-print-directory install PREFIX=/usr DESTDIR=$(STAGE)-deb
	install -m 755 -T $(TARGET)/release/body $(STAGE)-deb/usr/bin/symtet-body
	install -d $(STAGE)-deb/usr/share/doc/symtet
	for file in $(NAMED); do install -D -m 644 $$file $(STAGE)-deb/usr/share/doc/symtet/$$file; done
	install -m 644 packaging/copyright $(STAGE)-deb/usr/share/doc/symtet/copyright
	packaging/deb $(STAGE)-deb $(VERSION) $(TARGET)/dist/symtet_$(VERSION)_$$(dpkg --print-architecture).deb

wheel: setup ## pack the tools, TetGen's library and the Python reader for pip, into target/dist
	rm -rf $(STAGE)-wheel
	$(MAKE) --no-print-directory install PREFIX= DESTDIR=$(STAGE)-wheel
	packaging/library $(STAGE)-wheel
	install -m 644 README.md LICENSE-APACHE LICENSE-MIT LICENSE-AGPL $(STAGE)-wheel
	python3 packaging/wheel.py $(STAGE)-wheel $(VERSION) $(TARGET)/dist $(wildcard formats/tmesh/python/*.py)

clean: ## remove everything built
	$(CARGO) clean
