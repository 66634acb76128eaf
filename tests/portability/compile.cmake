# Compiles SOURCES one by one with COMPILER and FLAGS, and stops at the first that fails; or, given REFUSED_WITH, demands
# that the first fails with those words.
cmake_minimum_required(VERSION 3.25)

list(TRANSFORM INCLUDE_DIRS PREPEND -I)
if(SYSTEM_INCLUDE_DIR)
  set(system -isystem ${SYSTEM_INCLUDE_DIR})
endif()
set(command ${COMPILER} -std=c++20 -O0 -Wall -Wextra -Werror -Wfatal-errors ${INCLUDE_DIRS} ${system} ${FLAGS} -c -o /dev/null)

set(probe ${CMAKE_CURRENT_LIST_DIR}/probe.cpp)
execute_process(COMMAND ${command} ${probe} RESULT_VARIABLE result OUTPUT_QUIET ERROR_QUIET)
if(NOT result EQUAL 0)
  list(JOIN FLAGS " " flags)
  message("SKIPPED: ${COMPILER} ${flags} does not work on this machine")
  return()
endif()

foreach(source IN LISTS SOURCES)
  execute_process(COMMAND ${command} ${source} RESULT_VARIABLE result ERROR_VARIABLE errors)
  if(DEFINED REFUSED_WITH AND errors MATCHES "${REFUSED_WITH}")
    message("refused: ${REFUSED_WITH}")
    return()
  endif()
  if(DEFINED REFUSED_WITH OR NOT result EQUAL 0)
    message(FATAL_ERROR "${source}\n${errors}")
  endif()
endforeach()
message("compiled")
