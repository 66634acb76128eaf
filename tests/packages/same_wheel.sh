#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Makes the wheel for this machine once more, in another folder and from nothing, as one who checks a release does. It
# has the same bytes. Exit code 77: there is no wheel to compare with.
# Usage: same_wheel.sh REPOSITORY
set -euo pipefail
cd "$1"
name=$(basename build/packages/meshhood-*-cp312-abi3-manylinux_2_28_x86_64.whl)
if [[ ! -f build/packages/$name ]]; then
  echo "skipped: no build/packages/$name"
  exit 77
fi
again=$PWD/build/packages/again
rm -rf "$again"
mkdir -p "$again/build"
git ls-files -z | tar --null --files-from=- --create | tar --extract --directory="$again"
ln -s "$PWD/build/venv" "$again/build/venv"
GIT_DIR=$(git rev-parse --absolute-git-dir) # of the time that the files get
export GIT_DIR CCACHE_DISABLE=1 ZIG_GLOBAL_CACHE_DIR=$again/build/zig
"$again/tools/wheels" x86_64-linux-gnu 3.12
cmp {"$PWD","$again"}/build/packages/"$name"
(cd "$again/build/packages" && sha256sum "$name")
rm -rf "$again"
