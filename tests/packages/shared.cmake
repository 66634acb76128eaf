# Builds and installs the libraries as shared ones, and uses them with each of COMPILERS.
cmake_minimum_required(VERSION 3.25)
include(${SOURCE_DIR}/tests/install/consume.cmake)
set(prefix ${WORK_DIR}/installed)
file(REMOVE_RECURSE ${prefix})
execute_process(COMMAND ${CMAKE_COMMAND} -S ${SOURCE_DIR} -B ${WORK_DIR}/build -G ${GENERATOR} -DBUILD_SHARED_LIBS=ON
  -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=0 -DMESHHOOD_BUILD_CLI=OFF -DMESHHOOD_BUILD_TESTS=OFF
  -DMESHHOOD_BUILD_BENCH=OFF -DMESHHOOD_BUILD_EXAMPLES=OFF OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
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
