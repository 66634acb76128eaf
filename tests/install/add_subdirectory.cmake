# Configures a project that contains this one: it gets the core and nothing else.
cmake_minimum_required(VERSION 3.25)
set(build ${WORK_DIR}/container)
file(REMOVE_RECURSE ${build})
execute_process(COMMAND ${CMAKE_COMMAND} -S ${SOURCE_DIR}/tests/install/container -B ${build} -G ${GENERATOR}
  -DCMAKE_CXX_COMPILER=${COMPILER} -DMESHHOOD_SOURCE=${SOURCE_DIR} OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
