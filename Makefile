# The commands for a fresh Debian machine. Their steps are in tools/; daily work uses the presets.
#
#   make build                installs the packages it needs and builds build/release/meshhood
#   make install PREFIX=dir   installs what make build builds, and the page of make view if there is one; /usr/local by default
#   make demo [MESH=file]     compares all methods on a mesh where they differ, or on your own, and draws a picture
#   make view [MESH=file]     shows the same in an interactive page, build/demo/view.html
#   make site                 builds the site of these documents, with its gallery and references, into build/site
#   make serve                builds it and shows it at http://localhost:8000; PORT=n for another port
#   make test                 runs the short tests; about ten minutes
#   make packages             makes and tests what a release publishes, in build/packages/release; half an hour
#   make test-platforms       tests the core as other compilers and machines have it, in QEMU and Wine too; takes long
#   make test-all             runs also the long tests, the sanitizers, the fuzzers, the mutants and tools/verify, and then
#                             make test-platforms; hours
#
# These measure the tables of docs/benchmarks again. They write them and print how long each part took. They need a quiet
# machine; otherwise a table says that it was busy.
#
#   make reproduce            the paper's tables and pictures, accuracy, growth; about 20 minutes
#   make peers                other libraries on the same queries; about 15 minutes
#   make benchmarks           both
.PHONY: build install test test-all test-platforms packages demo view site serve reproduce peers benchmarks

PREFIX ?= /usr/local

# The demo reads these from the environment, so that a name may contain blanks.
export MESH VERTEX RADIUS

build:
	@tools/setup build
	@tools/build release

install: build
	@cmake --install build/release --prefix "$(PREFIX)"

test:
	@tools/setup test
	@tools/test --short release
	@echo "These were the short tests. make test-all also runs the long ones, the sanitizers, the fuzzers and the mutants."

test-all:
	@tools/setup test-all
	@tools/test release asan tsan:shared/helper_threads tsan:exact/threads tsan:patch/packet_patches
	@$(MAKE) --no-print-directory test-platforms

test-platforms:
	@tools/setup platforms
	@tools/platforms

packages:
	@tools/setup packages
	@tools/packages

demo:
	@tools/setup build
	@tools/build demo-program
	@tools/setup demo
	@tools/demo
	@echo "== make view shows the same in an interactive page, to turn the mesh and to choose vertex and radius"

view: build
	@tools/setup web
	@tools/build_viewer
	@tools/view

site:
	@tools/setup site
	@tools/build_site

PORT ?= 8000
serve: site
	@echo "== http://localhost:$(PORT)"
	@python3 -m http.server --bind 127.0.0.1 --directory build/site "$(PORT)"

bench = build/bench-venv/bin/python3 -B -m bench

reproduce:
	@bench/setup
	@$(bench) tables exact pictures accuracy scaling report

peers:
	@bench/setup peers
	@$(bench) peers report

benchmarks: reproduce peers
