# Wheels by the compiler of ziglang from PyPI, for any of its targets: tools/wheels. It has the headers and the stubs of
# each C library, and links its own C++ library into the module.
set(MESHHOOD_ZIG "" CACHE FILEPATH "The program zig")
set(MESHHOOD_ZIG_TARGET "" CACHE STRING "Its target, as in x86_64-linux-gnu.2.28")
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES MESHHOOD_ZIG MESHHOOD_ZIG_TARGET)

string(REGEX MATCH "^([a-z0-9_]+)-([a-z]+)" _ ${MESHHOOD_ZIG_TARGET})
set(CMAKE_SYSTEM_PROCESSOR ${CMAKE_MATCH_1})
set(CMAKE_SYSTEM_NAME Linux)
if(CMAKE_MATCH_2 STREQUAL "macos")
  set(CMAKE_SYSTEM_NAME Darwin)
endif()

# By default, zig compiles for the processor of this machine, and for a run-time library that is not linked.
set(options -target ${MESHHOOD_ZIG_TARGET} -mcpu=baseline -fno-sanitize=undefined)
set(CMAKE_C_COMPILER ${MESHHOOD_ZIG} cc ${options})
set(CMAKE_CXX_COMPILER ${MESHHOOD_ZIG} c++ ${options})
foreach(language C CXX)
  set(CMAKE_${language}_ARCHIVE_CREATE "${MESHHOOD_ZIG} ar qc <TARGET> <OBJECTS>")
  set(CMAKE_${language}_ARCHIVE_APPEND "${MESHHOOD_ZIG} ar q <TARGET> <OBJECTS>")
  set(CMAKE_${language}_ARCHIVE_FINISH "${MESHHOOD_ZIG} ranlib <TARGET>")
endforeach()
# Functions have sections of their own, so that the linker leaves out what is not called.
set(CMAKE_C_FLAGS_INIT "-ffunction-sections -fdata-sections")
set(CMAKE_CXX_FLAGS_INIT "-ffunction-sections -fdata-sections")
# The strip of this machine does not know other processors; the linker leaves out the symbols. A program is independent
# of its position, as the module is, so that zig compiles its C++ library only once.
set(CMAKE_STRIP "")
set(unused "-Wl,--gc-sections")
if(CMAKE_SYSTEM_NAME STREQUAL "Darwin")
  set(unused "-Wl,-dead_strip")
  # CMake demands it for the library of C. It is not here, and a module of static libraries does not need it.
  set(CMAKE_INSTALL_NAME_TOOL install_name_tool)
endif()
set(CMAKE_EXE_LINKER_FLAGS_INIT "-s -pie ${unused}")
set(CMAKE_MODULE_LINKER_FLAGS_INIT "${unused}")
# Programs of other systems do not run here.
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
