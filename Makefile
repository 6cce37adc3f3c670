# The users' door. Everything else is CMake's: see CMakeLists.txt and cmake/cases.cmake.
#   make           the solver, build/capsule
#   make figures   every case computed, every figure and table drawn: figures/, tables/
#   make atlas     every study of validation/ computed and drawn
#   make test      unit tests and every case against its published values
#   make help      all targets
SHELL := /bin/bash

.DEFAULT_GOAL := build
.PHONY: help setup setup-all configure build figures tables report atlas sweep sweep-case test bench paper-numerics lint sanitize fuzz coverage clean

help:
	@echo 'make [build]         build the solver, build/capsule'
	@echo 'make setup           install the Debian packages of apt.txt that are missing'
	@echo 'make setup-all       install those of apt-all.txt, too, without which some tests are skipped'
	@echo 'make figures         compute every case, draw every figure and write every table'
	@echo 'make tables          compute every case and write every table'
	@echo 'make report          figures and tables, and report.html: all of it on one page, with a player'
	@echo 'make atlas           compute every study of validation/ and draw its figures, also those of studies that fail'
	@echo 'make sweep CASE=cases/... [JOBS=n] [SSH=one,two,:]   share the runs of a case out to processes and machines'
	@echo 'make test            run all tests'
	@echo 'make lint            clang-format and clang-tidy over all sources, where they are installed'
	@echo 'make sanitize        unit tests with the address and undefined-behaviour sanitizers'
	@echo 'make fuzz [SECONDS=600]   random case files, --set arguments, tables and checkpoints, with the sanitizers (needs clang)'
	@echo 'make coverage        lines of solver/ that unit tests and quick tests of the program run'
	@echo 'make bench           time kernels and steps; chart speed against accuracy (on a quiet machine)'
	@echo 'make paper-numerics  compute Tables 1 and 3 again with the numerics of the paper: an hour or more'
	@echo 'make clean           remove what was built, computed and drawn'

setup: PACKAGES = apt.txt
setup-all: PACKAGES = apt.txt apt-all.txt
setup setup-all:
	@missing=(); \
	for package in $$(sed 's/#.*//' $(PACKAGES)); do \
	  dpkg -s $$package 2>/dev/null | grep -q '^Status: install ok installed' || missing+=($$package); \
	done; \
	if (( $${#missing[@]} )); then \
	  root=; [ $$(id -u) = 0 ] || root=sudo; \
	  $$root apt-get update && \
	  $$root env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "$${missing[@]}"; \
	fi

configure: setup
	@cmake/configure.sh default build

build: configure
	@cmake --build build --target capsule

figures: build
	@cmake --build build --target figures

tables: build
	@cmake --build build --target tables

report: build
	@cmake --build build --target report

atlas: build
	@cmake --build build --target atlas -- -k 0

# As they are typed, in the environment: neither make nor a shell reads them again.
override export CASE := $(value CASE)
override export JOBS := $(value JOBS)
override export SSH := $(value SSH)
sweep: sweep-case build
	@sweep/parallel.sh "$$CASE" "$${JOBS:-100%}" $${SSH:+"$$SSH"}
sweep-case:
	@[ -e "$$CASE" ] || { printf "error: CASE='%s' is no case, try CASE=cases/...\n" "$$CASE"; exit 2; }

test: configure
	@cmake --build build
	@ctest --test-dir build --output-on-failure -j2; code=$$?; cmake/skipped.sh build; exit $$code

# The results become data of the case, with their provenance; what ParaView reads stays in results/.
PAPER := table1-mesh/paper-numerics fig10-viscosity-ellipsoid/paper-numerics fig10-viscosity-ellipsoid/paper-mesh
paper-numerics: build
	@for case in $(PAPER); do \
	  build/capsule show cases/$$case.toml | tail -n 1; \
	  build/capsule run cases/$$case.toml; (( $$? == 0 || $$? == 3 )) || exit; \
	  for run in results/$${case/\//-}/*/; do \
	    install -m 644 -D -t "cases/$$case/$$(basename "$$run")" "$$run"/{summary,run}.json "$$run"/{series.csv,resolved.toml}; \
	  done; \
	done

# On a quiet machine: kernels and steps, then the chart of speed against accuracy.
bench: build
	@cmake --build build --target benchmarks
	@mkdir -p results/benchmark
	@for program in build/bench_*; do \
	  $$program --benchmark_out=results/benchmark/$${program##*/}.csv --benchmark_out_format=csv; \
	done
	@cmake --build build --target study-speed-accuracy

lint: setup
	@cmake/configure.sh lint build-lint && cmake/lint.sh build-lint

sanitize: setup
	@cmake/configure.sh sanitize build-sanitize && cmake --build --preset sanitize && ctest --preset sanitize

# A share of the time for each; what was found on the way stays in build-fuzz/ for the next time.
SECONDS ?= 600
fuzz: setup
	@cmake/configure.sh fuzz build-fuzz && cmake --build --preset fuzz
	@cmake/fuzz.sh "$(SECONDS)"

coverage: setup
	@cmake/configure.sh coverage build-coverage && cmake --build --preset coverage
	@cmake/coverage.sh

clean:
	@cmake/clean.sh
