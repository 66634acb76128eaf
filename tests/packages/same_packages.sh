#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Makes the wheel for this machine, the source package and that for npm once more, in another folder and from nothing, as
# one who checks a release does. They have the same bytes. Exit code 77: one of them is not there to compare with.
# Usage: same_packages.sh REPOSITORY
set -euo pipefail
cd "$1"
python=$PWD/build/venv/bin/python3 packages=build/packages again=$PWD/build/packages/again
files=("$packages"/meshhood-*-cp312-abi3-manylinux_2_28_x86_64.whl "$packages"/meshhood-*.tar.gz build/wasm/npm/meshhood.wasm)
for file in "${files[@]}"; do
  if [[ ! -f $file ]]; then
    echo "skipped: no $file"
    exit 77
  fi
done
rm -rf "$again"
mkdir -p "$again/build"
git ls-files -z | tar --null --files-from=- --create | tar --extract --directory="$again"
ln -s "$PWD/build/venv" "$again/build/venv"
GIT_DIR=$(git rev-parse --absolute-git-dir) # of the time that the files get
export GIT_DIR CCACHE_DISABLE=1 ZIG_GLOBAL_CACHE_DIR=$again/build/zig
"$again/tools/wheels" x86_64-linux-gnu 3.12
(cd "$again" && "$python" -m build --sdist --outdir "$packages" . >/dev/null)
for folder in "$PWD" "$again"; do
  npm pack --silent --pack-destination "$folder/$packages" "$folder/build/wasm/npm" >/dev/null
done
for file in "$again/$packages"/meshhood-*; do
  cmp "$file" "$packages/${file##*/}"
  sha256sum "$file"
done
rm -rf "$again"
