#!/bin/sh
# Includes point one way: public headers include no internal ones, and of src the parts outside the core see src/shared
# alone. Public headers define no macro but MESHHOOD_ ones. Usage: includes.sh ROOT
cd "$1" || exit 1
internal=$(cd src && ls -d -- */ | tr -d / | grep -v '^shared$' | paste -sd'|')
public=$(grep -rnE "#include \"($internal|shared)/" include --include=*.h)
outside=$(grep -rnE "#include \"($internal)/" io parts shapes measure cli bindings --include=*.h --include=*.cpp)
macros=$(grep -nE '^ *# *define ' -r include io/index_io.h io/mesh_io.h io/weld.h | grep -vE 'define MESHHOOD_')
if [ -n "$macros" ]; then
  printf '%s\n' "$macros" | sed 's/$/   a macro without MESHHOOD_/'
  exit 1
fi
if [ -n "$public$outside" ]; then
  printf '%s\n' "$public" "$outside" | grep . | sed 's/$/   an internal header/'
  exit 1
fi
echo "src/{$internal} are internal; $(grep -rlE '#include "shared/' io parts | wc -l) sources of io and parts include src/shared"
