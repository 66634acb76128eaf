# The three commands of a fresh Debian machine. What they do, step by step, is in tools/; presets are for daily work.
#
#   make build                    installs what it needs, builds build/release/meshhood
#   make test                     the same, then builds and runs all tests, and each fuzzer for a moment
#   make demo [MESH=some.ply]     every method on a mesh with a trap, or on your own
#
# And for who would see for himself what docs/benchmarks.md says; both end by writing it, say how long each part took, and
# want a quiet machine, or the page says that it was busy:
#
#   make reproduce                the paper's tables and pictures, accuracy, growth; about 20 minutes
#   make peers                    other products on the same queries; about a quarter of an hour
#   make benchmarks               both
.PHONY: build test demo reproduce peers benchmarks

# The demo reads these from the environment, so that a name may hold blanks.
export MESH VERTEX RADIUS

build:
	@tools/setup build
	@tools/build release -DMESHHOOD_BUILD_TESTS=OFF -DMESHHOOD_BUILD_BENCH=OFF

test:
	@tools/setup test
	@tools/test release asan tsan:exact/threads

demo: build
	@tools/demo

bench = build/bench-venv/bin/python3 -B -m bench

reproduce:
	@bench/setup
	@$(bench) tables exact pictures accuracy scaling report

peers:
	@bench/setup peers
	@$(bench) peers report

benchmarks: reproduce peers
