# Configures, builds and runs a project that contains this one and sets nothing. The library is then optimized and
# compiled in few units, the code of the project is as it was, and only the project is installed.
cmake_minimum_required(VERSION 3.25)
set(build ${WORK_DIR}/add_subdirectory)
file(REMOVE_RECURSE ${build})
unset(ENV{CXXFLAGS})
execute_process(COMMAND ${CMAKE_COMMAND} -S ${SOURCE_DIR}/tests/install/consumer -B ${build} -G ${GENERATOR}
  -DCMAKE_CXX_COMPILER=${COMPILER} -DMESHHOOD_SOURCE=${SOURCE_DIR} -DCMAKE_EXPORT_COMPILE_COMMANDS=ON
  OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)

file(READ ${build}/compile_commands.json commands)
string(JSON count LENGTH ${commands})
math(EXPR last "${count} - 1")
foreach(i RANGE ${last})
  string(JSON command GET ${commands} ${i} command)
  string(JSON file GET ${commands} ${i} file)
  set(is_optimized FALSE)
  if(command MATCHES " -O[23] ")
    set(is_optimized TRUE)
  endif()
  set(is_ours TRUE)
  if(file MATCHES "tests/install/consumer/")
    set(is_ours FALSE)
  endif()
  if(NOT is_ours STREQUAL is_optimized)
    message(FATAL_ERROR "optimized: ${is_optimized}, expected ${is_ours}: ${command}")
  endif()
endforeach()
if(count GREATER 25)
  message(FATAL_ERROR "${count} compilations, expected a few units and the two programs")
endif()

foreach(target meshhood_cli meshhood_shapes meshhood_parts example_neighborhood)
  execute_process(COMMAND ${CMAKE_COMMAND} --build ${build} --target ${target}
    RESULT_VARIABLE result OUTPUT_QUIET ERROR_QUIET)
  if(result EQUAL 0)
    message(FATAL_ERROR "${target} is not expected here")
  endif()
endforeach()

execute_process(COMMAND ${CMAKE_COMMAND} --build ${build} --parallel 2 OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${build}/consumer ${build} COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} --install ${build} --prefix ${build}/prefix
  OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
file(GLOB_RECURSE installed RELATIVE ${build}/prefix ${build}/prefix/*)
if(NOT installed STREQUAL "bin/consumer")
  message(FATAL_ERROR "installed: ${installed}, expected bin/consumer alone")
endif()
message("${count} compilations")
