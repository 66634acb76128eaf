#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Makes the wheels of a target and tests each: what its name says, and, in an empty environment, its answers, its files
# and its choice of kernels. Exit code 77: a program is missing.
# Usage: wheel.sh REPOSITORY TARGET VERSION... [-- SUITE:VERSION...]
# TARGET and VERSION are as for tools/wheels. The wheel for 3.12 is also tested in QEMU, with the Python of a SUITE of
# Debian.
set -euo pipefail
cd "$1"
target=$2
shift 2
versions=() suites=()
while (($#)) && [[ $1 != -- ]]; do versions+=("$1"); shift; done
(($#)) && suites=("${@:2}")
machine=${target%%-*}
python=$PWD/build/venv/bin/python3 packages=$PWD/build/packages here=$PWD/tests/packages
pip=("$python" -m pip install --quiet --disable-pip-version-check)
export PYTHONDONTWRITEBYTECODE=1
# In an emulated processor, OpenBLAS must choose its own.
unset OPENBLAS_CORETYPE

needs() {
  command -v "$1" >/dev/null || { echo "skipped: no $1 ($2 installs it)"; exit 77; }
}
for version in "${versions[@]}"; do
  tools/find_python "$version" >/dev/null || { echo "skipped: no Python $version"; exit 77; }
done
needs "qemu-$machine-static" "tools/setup test-all"

# in_venv WHEEL VERSION: installs it with the latest NumPy, and tests it.
in_venv() {
  local folder=$packages/installed/$target-$2
  rm -rf "$folder"
  "$(tools/find_python "$2")" -m venv "$folder"
  "$folder/bin/python3" -m pip install --quiet --disable-pip-version-check "$1"
  "$folder/bin/python3" "$here/installed_wheel.py"
}

# in_qemu WHEEL SUITE VERSION: the same with the Python of a suite of Debian.
in_qemu() {
  local folder=$packages/installed/$target-$3 root=$packages/debian-$2-$machine
  local runner="qemu-$machine-static -cpu max -L $root" kernels=AVX2
  [[ $machine != aarch64 ]] || kernels=NEON
  needs mmdebstrap "tools/setup packages"
  if [[ ! -d $root/usr ]]; then
    # A mirror may be older than the time for which its list is valid.
    mmdebstrap --quiet --variant=extract --aptopt='Acquire::Check-Valid-Until "false"' \
      --architectures="$(sed 's/x86_64/amd64/; s/aarch64/arm64/' <<<"$machine")" \
      --include="base-files,python$3-minimal,libpython$3-stdlib,libstdc++6" \
      "$2" "$root" "$(tools/find_mirror)" 2>/dev/null
  fi
  rm -rf "$folder"
  "${pip[@]}" --target "$folder" --only-binary :all: --implementation cp --python-version "$3" \
    --platform "manylinux_2_28_$machine" --platform "manylinux_2_27_$machine" --platform "manylinux2014_$machine" \
    "$1" numpy
  PYTHONPATH=$folder PYTHONHOME=$root/usr MESHHOOD_PROGRAM="$runner $root/usr/bin/python$3 $folder/bin/meshhood" \
    $runner "$root/usr/bin/python$3" "$here/installed_wheel.py" $kernels
}

# on_older_processors VERSION: the environment of that version, as on processors with fewer instructions; on the
# oldest with a NumPy that still runs there.
on_older_processors() {
  local old=$packages/installed/numpy-1.26 interpreter=$packages/installed/$target-$1/bin/python3 processor runner
  [[ -d $old ]] || "${pip[@]}" --target "$old" --no-deps --only-binary :all: --python-version "$1" numpy==1.26.4
  for processor in Haswell:AVX2: Nehalem:SSE4: "core2duo:SCALAR:$old"; do
    IFS=: read -r processor kernels path <<<"$processor"
    runner="qemu-x86_64-static -cpu $processor"
    PYTHONPATH=$path MESHHOOD_PROGRAM="$runner $interpreter ${interpreter%/*}/meshhood" \
      $runner "$interpreter" "$here/installed_wheel.py" "$kernels" \
      2> >(grep --invert-match "TCG doesn't support requested feature" >&2)
  done
}

# in_musl WHEEL: the same with a Python that is made for this test, and loaded by the loader of musl.
in_musl() {
  local folder=$packages/installed/$target interpreter=$packages/python-musl/python zig
  zig=$("$python" -c 'import os, ziglang; print(os.path.dirname(ziglang.__file__) + "/zig")')
  "$here/musl_python.sh" "${interpreter%/*}" "$zig"
  rm -rf "$folder"
  "${pip[@]}" --target "$folder" --only-binary :all: --implementation cp --python-version 3.13 \
    --platform musllinux_1_2_x86_64 "$1" numpy
  PYTHONPATH=$folder MESHHOOD_PROGRAM="$interpreter $folder/bin/meshhood" "$interpreter" "$here/installed_wheel.py"
}

tools/wheels "$target" "${versions[@]}"
for version in "${versions[@]}"; do
  tag=cp${version/./}
  [[ $version == 3.12 ]] && tag=cp312-abi3
  wheel=$(ls "$packages"/meshhood-*-"$tag"-*"$(sed -n "s/^ *$target) .*platform=\([^ ]*\) .*/\1/p" tools/wheels)".whl)
  "$python" "$here/check_wheel.py" "$wheel"
  case $target in
    x86_64-linux-gnu) in_venv "$wheel" "$version" ;;
    x86_64-linux-musl) in_musl "$wheel" ;;
  esac
done
for suite in "${suites[@]}"; do in_qemu "$wheel" "${suite%:*}" "${suite#*:}"; done

[[ $target != x86_64-linux-gnu ]] || on_older_processors 3.12
if [[ $target == x86_64-linux-* ]]; then
  mapfile -d '' objects < <(find "$packages/$target" -name '*.o' -print0)
  "$python" "$here/baseline.py" "${objects[@]}"
fi
