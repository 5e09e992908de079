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
# Python with meshio, vtk and gmsh: reads meshes independently of this project, in tests only.
REFEREE := $(TARGET)/referee

.PHONY: help setup build demo test check fmt lint install clean

help: ## list the targets
	@sed -n 's/^\([a-z]*\):.*## \(.*\)/  make \1\t\2/p' Makefile | expand -t 20

setup: ## install what is missing: TetGen, a C++ compiler
	@.ci/setup

build: setup ## build the tools, release profile, into target/release
	$(CARGO) build --release --bins

demo: build ## mesh a through-silicon via of three materials, stage by stage, and report its quality
	$(CARGO) build --release --example body
	mkdir -p $(TARGET)/demo
	$(MAKE) --no-print-directory -C $(TARGET)/demo -f $(CURDIR)/examples/flows/tsv.mk --always-make BIN=$(TARGET)/release/
	@echo "The mesh is in $(TARGET)/demo/tsv.vtk, the stages beside it."

test: setup ## run every test
	@.ci/referee $(REFEREE)
	$(CARGO) build --workspace --bins --examples
	REFEREE=$(REFEREE) $(CARGO) test --workspace

fmt: ## check the formatting
	$(CARGO) fmt --all --check

lint: setup ## run clippy, warnings are errors
	$(CARGO) clippy --workspace --all-targets -- -D warnings

check: fmt lint test ## what CI runs: formatting, lints, every test

install: build ## install the tools under PREFIX (default /usr/local)
	install -d $(DESTDIR)$(PREFIX)/bin
	install -m 755 $(TOOLS:%=$(TARGET)/release/%) $(DESTDIR)$(PREFIX)/bin

clean: ## remove everything built
	$(CARGO) clean
