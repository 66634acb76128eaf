# Configures, builds and runs the consumer in ${build} with ${COMPILER}, against what is installed in ${prefix}. Further
# arguments are for CMake.
function(consume prefix build)
  file(REMOVE_RECURSE ${build})
  execute_process(COMMAND ${CMAKE_COMMAND} -S ${SOURCE_DIR}/tests/install/consumer -B ${build} -G ${GENERATOR}
    -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH=${prefix} -DVERSION=${VERSION} ${ARGN}
    OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND ${CMAKE_COMMAND} --build ${build} OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND ${build}/consumer ${build} COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND ${build}/small COMMAND_ERROR_IS_FATAL ANY)
endfunction()
