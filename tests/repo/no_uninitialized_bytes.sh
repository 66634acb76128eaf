#!/bin/sh
# SPDX-License-Identifier: MIT
# No uninitialized byte reaches a file, and no branch depends on one (row F12 of the catalogue): such a byte may hold
# private data and differs from run to run. The control writes such a byte, to show that valgrind finds it.
# Usage: no_uninitialized_bytes.sh CONTROL MESHHOOD
set -eu

control=$1
meshhood=$2
if ! command -v valgrind >/dev/null; then
  echo "skipped: no valgrind"
  exit 0
fi
folder=$(mktemp --directory)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

watched() { valgrind --quiet --error-exitcode=99 --leak-check=no "$@"; }

if watched "$control" control.bin 2>control.log || ! grep -q 'points to uninitialised byte' control.log; then
  cat control.log
  echo "no uninitialized byte found in the file of $control: this check does not work" >&2
  exit 1
fi

watched "$meshhood" generate folds --vertices 1500 -o mesh.ply
watched "$meshhood" build mesh.ply -o exact.mhi
watched "$meshhood" build mesh.ply --index paper -o paper.mhi
watched "$meshhood" query exact.mhi -v 7 -r 8 --unit edge --distances -o part.ply >/dev/null
watched "$meshhood" compare mesh.ply -v 7 -r 8 --unit edge -o compared.ply
watched "$meshhood" batch exact.mhi -r 3 --unit edge --distances --threads 2 -o rows.npz
watched "$meshhood" batch paper.mhi -r 3 --method paper --count -o counts.npz
echo "$(ls mesh.ply part.ply compared.ply exact.mhi paper.mhi rows.npz counts.npz | wc -l) files," \
  "$(cat ./*.ply ./*.mhi ./*.npz | wc -c) bytes, none uninitialized"
