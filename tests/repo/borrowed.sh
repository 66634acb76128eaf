#!/usr/bin/env bash
# A field of a public struct that borrows an array has a type that takes no temporary: Borrowed<T>, ValuesView and the
# like, not std::span<const T>. Usage: borrowed.sh FOLDER
set -euo pipefail
cd "$1"
# Private members stand behind constructors. The row of a batch is made by the library, and valid during a call.
allowed='_;|  ids;|  distances;|> (ids|distances);'
found=$(grep -nE '^ +std::(optional<std::)?span<const [^()]*;' include/meshhood/*.h io/*_io.h io/weld.h | grep -vE "$allowed" || true)
[[ -z $found ]] || { echo "borrows by std::span, expected Borrowed:"; echo "$found"; exit 1; }
echo "$(grep -cE 'Borrowed<|ValuesView |IndicesView ' include/meshhood/*.h io/*_io.h | awk -F: '{ n += $2 } END { print n }') lines of public headers borrow by a view that takes no temporary"
