#!/usr/bin/env bash
# The same sources give the same bytes, wherever and whenever they are built: libraries, command line and the package for
# Debian, made in two folders one after the other, are compared. Usage: same_bytes.sh ROOT WORK COMPILER
set -euo pipefail
export CCACHE_DISABLE=1 # it would give the second build what the first one made
export SOURCE_DATE_EPOCH=1 # of the files of a package
rm -rf "$2"
build() { # FOLDER
  mkdir -p "$1"
  tar -C "$root" -cf - CMakeLists.txt LICENSE NOTICE cmake include src io parts shapes measure cli viewer | tar -C "$1" -xf -
  cmake -S "$1" -B "$1/build" -G Ninja -DCMAKE_CXX_COMPILER="$compiler" --log-level=WARNING >/dev/null
  cmake --build "$1/build" --target meshhood meshhood_io meshhood_cli meshhood_manual >/dev/null
  (cd "$1/build" && cpack --config CPackConfig.cmake -B deb >/dev/null && mv deb/meshhood_*.deb meshhood.deb)
}
root=$1 compiler=$3
build "$2/one"
build "$2/another place"
for file in libmeshhood.a io/libmeshhood_io.a meshhood meshhood.deb; do
  cmp "$2/one/build/$file" "$2/another place/build/$file"
  echo "$file: $(stat -c %s "$2/one/build/$file") bytes, the same"
done
