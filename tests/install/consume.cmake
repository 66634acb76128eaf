# The code blocks of all documents in a language and with a mark, one after the other.
function(code_blocks result)
  execute_process(COMMAND python3 -B ${SOURCE_DIR}/tools/code_blocks.py ${ARGN}
    OUTPUT_VARIABLE blocks COMMAND_ERROR_IS_FATAL ANY)
  string(JSON count LENGTH ${blocks})
  if(count EQUAL 0)
    message(FATAL_ERROR "no document has code of ${ARGN}")
  endif()
  math(EXPR last "${count} - 1")
  set(codes)
  foreach(i RANGE ${last})
    string(JSON code GET ${blocks} ${i} code)
    list(APPEND codes "${code}")
  endforeach()
  message("${count} code blocks: ${ARGN}")
  set(${result} ${codes} PARENT_SCOPE)
endfunction()

# Runs what the consumer in ${build} has built. A plugin that contains an archive exports none of it.
function(run_consumer build)
  execute_process(COMMAND ${build}/consumer ${build} COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND ${build}/small COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND ${build}/load ${build}/plugin.so COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND nm -DC --defined-only ${build}/plugin.so
    OUTPUT_VARIABLE exported COMMAND_ERROR_IS_FATAL ANY)
  if(NOT exported MATCHES "T count_in_square" OR exported MATCHES "T (meshhood::[^\n]*)")
    message(FATAL_ERROR "the plugin exports ${CMAKE_MATCH_1}")
  endif()
endfunction()

# Configures, builds and runs the consumer in ${build} with ${COMPILER}, against what is installed in ${prefix}, without
# the libraries that meshhood itself is built with. Further arguments are for CMake.
function(consume prefix build)
  file(REMOVE_RECURSE ${build})
  execute_process(COMMAND ${CMAKE_COMMAND} -S ${SOURCE_DIR}/tests/install/consumer -B ${build} -G ${GENERATOR}
    -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH=${prefix} -DVERSION=${VERSION}
    -DCMAKE_DISABLE_FIND_PACKAGE_fmt=ON -DCMAKE_DISABLE_FIND_PACKAGE_FastFloat=ON --no-warn-unused-cli ${ARGN}
    OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND ${CMAKE_COMMAND} --build ${build} OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
  run_consumer(${build})
endfunction()
