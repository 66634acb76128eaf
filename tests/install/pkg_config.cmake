# Installs this build, then compiles and runs the consumer with the flags of pkg-config. They name the headers as those
# of the project itself, so that each warning of them shows.
cmake_minimum_required(VERSION 3.25)
set(WORK_DIR ${WORK_DIR}/pkg_config)
include(${CMAKE_CURRENT_LIST_DIR}/installed.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/consume.cmake)
file(GLOB_RECURSE files ${prefix}/*/meshhood.pc)
cmake_path(GET files PARENT_PATH folder)
set(ENV{PKG_CONFIG_PATH} ${folder})

# Further arguments are flags.
function(compile program package)
  execute_process(COMMAND pkg-config --cflags --libs ${package}
    OUTPUT_VARIABLE flags OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  separate_arguments(flags UNIX_COMMAND "${flags}")
  execute_process(COMMAND ${COMPILER} -std=c++20 -O1 -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror
    ${ARGN} ${SOURCE_DIR}/tests/install/consumer/${program}.cpp ${flags}
    -o ${WORK_DIR}/${program} COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND ${WORK_DIR}/${program} ${WORK_DIR} COMMAND_ERROR_IS_FATAL ANY)
endfunction()
compile(small meshhood)
compile(small meshhood -fno-rtti -fno-exceptions)
compile(main meshhood-io)

# The commands of the documents that need an installed library, in a folder with the first program of docs/cpp.md. They do
# not quote the library's folder, which has a blank.
cmake_path(RELATIVE_PATH folder BASE_DIRECTORY ${prefix})
set(link ${WORK_DIR}/installed)
file(CREATE_LINK ${prefix} ${link} SYMBOLIC)
set(ENV{PKG_CONFIG_PATH} ${link}/${folder})
set(ENV{CMAKE_PREFIX_PATH} ${link})
set(ENV{PATH} "${link}/bin:$ENV{PATH}")
set(ENV{CXX} ${COMPILER})
file(REMOVE_RECURSE ${WORK_DIR}/build)
file(COPY_FILE ${SOURCE_DIR}/examples/neighborhood.cpp ${WORK_DIR}/app.cpp)
code_blocks(projects cmake)
list(FILTER projects INCLUDE REGEX "project\\(")
list(GET projects 0 project)
file(WRITE ${WORK_DIR}/CMakeLists.txt "${project}")
code_blocks(blocks sh installed)
foreach(block IN LISTS blocks)
  execute_process(COMMAND bash -euo pipefail -c "${block}" WORKING_DIRECTORY ${WORK_DIR} COMMAND_ERROR_IS_FATAL ANY)
endforeach()

execute_process(COMMAND pkg-config --modversion meshhood-io
  OUTPUT_VARIABLE version OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
if(NOT version STREQUAL VERSION)
  message(FATAL_ERROR "meshhood-io has version ${version}, expected ${VERSION}")
endif()
