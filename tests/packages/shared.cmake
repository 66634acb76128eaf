# Builds and installs the libraries as shared ones, which export the interface alone, and uses them with each of
# COMPILERS.
cmake_minimum_required(VERSION 3.25)
include(${SOURCE_DIR}/tests/install/consume.cmake)
set(prefix ${WORK_DIR}/installed)
file(REMOVE_RECURSE ${prefix})
execute_process(COMMAND ${CMAKE_COMMAND} -S ${SOURCE_DIR} -B ${WORK_DIR}/build -G ${GENERATOR} -DBUILD_SHARED_LIBS=ON
  -DMESHHOOD_BUILD_CLI=OFF OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} --build ${WORK_DIR}/build --parallel 2 OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} --install ${WORK_DIR}/build --prefix ${prefix}
  OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
foreach(COMPILER IN LISTS COMPILERS)
  cmake_path(GET COMPILER FILENAME name)
  consume(${prefix} ${WORK_DIR}/${name})
endforeach()
file(GLOB libraries ${prefix}/*/libmeshhood*.so.${VERSION})
list(LENGTH libraries count)
if(NOT count EQUAL 2)
  message(FATAL_ERROR "shared libraries with the version in their name: ${libraries}, expected two")
endif()
execute_process(COMMAND python3 -B ${SOURCE_DIR}/tests/repo/exported.py ${SOURCE_DIR} ${libraries}
  COMMAND_ERROR_IS_FATAL ANY)

file(GLOB packages ${prefix}/*/pkgconfig)
set(ENV{PKG_CONFIG_PATH} ${packages})
execute_process(COMMAND pkg-config --cflags --libs meshhood-io
  OUTPUT_VARIABLE flags OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
separate_arguments(flags UNIX_COMMAND "${flags}")
cmake_path(GET packages PARENT_PATH folder)
execute_process(COMMAND ${COMPILER} -std=c++20 -fvisibility=hidden ${SOURCE_DIR}/tests/install/consumer/main.cpp
  ${flags} -Wl,-rpath,${folder} -o ${WORK_DIR}/consumer COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${WORK_DIR}/consumer ${WORK_DIR} COMMAND_ERROR_IS_FATAL ANY)
