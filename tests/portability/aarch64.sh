#!/bin/sh
# SPDX-License-Identifier: MIT
# Compiles the core and some of its tests for AArch64, and runs them in QEMU: the golden files, the kernels, whole calls
# with each target, and a sample of queries compared with the oracle. So answers and files have the same bits on
# processors with NEON.
# Usage: aarch64.sh FOLDER HEADERS TESTS CORE KERNELS..., where FOLDER is for what it makes, HEADERS holds the headers of
# libraries, TESTS is tests/ of the repository, CORE includes all sources but KERNELS
set -eu
folder=$1 headers=$2 tests=$3 core=$4
shift 4
googletest=/usr/src/googletest

for program in aarch64-linux-gnu-g++ qemu-aarch64-static; do
  command -v "$program" >/dev/null || { echo "SKIPPED: no $program (g++-aarch64-linux-gnu, qemu-user-static)"; exit 0; }
done
[ -d "$googletest" ] || { echo "SKIPPED: no $googletest (googletest)"; exit 0; }

rm -rf "$folder" && mkdir -p "$folder"
root=$(dirname "$tests")
compile() {
  printf '%s\0' "-c $1 -o $folder/$(basename "$1").o $2"
}
golden="-DMESHHOOD_GOLDEN_DIR=\"$tests/golden\""
{
  compile "$core" -O1
  for source in "$@"; do compile "$source" -O2; done
  compile "$tests/golden/golden_test.cpp" -O0
  for name in differential same_bits; do compile "$tests/whole/${name}_test.cpp" -O0; done
  for source in "$tests"/simd/*.cpp; do compile "$source" -O0; done
  for source in "$tests"/support/families*.cpp "$tests/support/oracle.cpp"; do compile "$source" -O1; done
  for name in googletest/src/gtest-all.cc googlemock/src/gmock-all.cc googlemock/src/gmock_main.cc; do
    compile "$googletest/$name" -O0
  done
} | xargs -0 -P 2 -I{} sh -c 'exec aarch64-linux-gnu-g++ -std=c++20 -ffp-contract=off -w "$1" -isystem "$2" \
  -I"$3/include" -I"$3/src" -I"$4" -I"$5/googletest" -I"$5/googlemock" $6' \
  sh "$golden" "$headers" "$root" "$tests" "$googletest" {}
aarch64-linux-gnu-g++ -static "$folder"/*.o -o "$folder/tests"

export MESHHOOD_TEST_SCALE=0.02
qemu-aarch64-static "$folder/tests" --gtest_brief=1
