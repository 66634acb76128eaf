#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# tools/packages publishes all packages or none, none of an earlier run, and no version that has something left to fill
# in. In a repository of its own, where programs that only make empty files take the place of those that build.
# Usage: packages_test.sh ROOT WORK
set -euo pipefail
repository=$2/repository programs=$2/programs
rm -rf "$2"
mkdir -p "$repository/build/packages" "$repository/build/venv/bin" "$programs"
cd "$1"
cp --recursive --parents tools/packages include/meshhood/version.h cmake/MeshhoodPackage.cmake README.md SECURITY.md \
  CHANGELOG.md docs/index.md packaging "$repository"
cd "$repository"
PATH=$programs:$PATH
program() { printf '#!/bin/sh\n%s\n' "$2" >"$1" && chmod +x "$1"; }
program "$programs/cmake" ''
program "$programs/ctest" ''
program "$programs/npm" 'touch "$4/meshhood.tgz"'
program build/venv/bin/python3 'for file; do :; done; touch "$file"'
program tools/build_viewer ''
commit() { git add . && git -c user.name=test -c user.email=test -c commit.gpgsign=false commit --quiet --message=test; }
git init --quiet
echo build >.gitignore
commit

says() { # TEXT...: of a run that fails
  if tools/packages >"$programs/said.txt" 2>&1; then echo "expected an error: $*" && exit 1; fi
  for text in "$@"; do
    if ! grep --quiet --fixed-strings "$text" "$programs/said.txt"; then
      cat "$programs/said.txt" && echo "did not say $text" && exit 1
    fi
  done
}

version=$(sed -n 's/#define MESHHOOD_VERSION_.* //p' include/meshhood/version.h | paste -sd.)
touch "build/packages/meshhood-$version-cp312-abi3-manylinux_2_28_x86_64.whl" # of an earlier run
says "these were not made" cp39-cp39 cp312-abi3-manylinux_2_28_x86_64.whl tar.gz amd64.deb
[[ ! -e build/packages/release ]]
mapfile -t files < <(grep ^build "$programs/said.txt")

sed -i 's/## \[.*/## [Unreleased]/' CHANGELOG.md
echo 'Nothing is published yet | now | to be filled @invalid will have:' |
  tee -a README.md docs/index.md SECURITY.md >>cmake/MeshhoodPackage.cmake
commit
git tag "v$version"
touch new.txt
says "v$version is not ready" new.txt README.md: index.md: SECURITY.md: MeshhoodPackage.cmake: CHANGELOG.md:
sed -i '/Nothing is published yet\|| now |\|to be filled\|@invalid\|will have:/d; s/## \[Unreleased\]/## [0.0.0]/' \
  README.md SECURITY.md CHANGELOG.md docs/index.md cmake/MeshhoodPackage.cmake
commit
git tag --force "v$version" >/dev/null
says "these were not made"

program "$programs/ctest" "mkdir -p build/packages/deb && touch ${files[*]}"
tools/packages >/dev/null
echo "$(wc -l <build/packages/release/SHA256SUMS) files to publish, ${#files[@]} of them made by tests"
[[ $(wc -l <build/packages/release/SHA256SUMS) == 15 ]]
