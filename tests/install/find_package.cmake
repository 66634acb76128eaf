# Installs this build into an empty folder, then configures, builds and runs the consumer against it.
cmake_minimum_required(VERSION 3.25)
set(prefix "${WORK_DIR}/installed tree")
set(build ${WORK_DIR}/consumer)
file(REMOVE_RECURSE ${prefix} ${build})

execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${prefix}
  OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} -S ${SOURCE_DIR}/tests/install/consumer -B ${build} -G ${GENERATOR}
  -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH=${prefix} -DVERSION=${VERSION}
  OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} --build ${build} OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${build}/consumer ${build} COMMAND_ERROR_IS_FATAL ANY)

foreach(file man/man1/meshhood.1 bash-completion/completions/meshhood zsh/site-functions/_meshhood
    fish/vendor_completions.d/meshhood.fish)
  file(STRINGS ${prefix}/share/${file} lines REGEX "curvature")
  if(NOT lines)
    message(FATAL_ERROR "share/${file} lacks the command curvature")
  endif()
endforeach()

file(GLOB_RECURSE installed ${prefix}/*)
list(LENGTH installed count)
message("${count} files installed")
