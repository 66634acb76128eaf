# Installs this build, then configures, builds and runs the consumer against it.
cmake_minimum_required(VERSION 3.25)
set(WORK_DIR ${WORK_DIR}/find_package)
include(${CMAKE_CURRENT_LIST_DIR}/installed.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/consume.cmake)
set(build ${WORK_DIR}/build)
consume(${prefix} ${build})

# The CMake of the documents: each block is a project of a program `app`, or what one adds for the library.
code_blocks(blocks cmake)
foreach(block IN LISTS blocks)
  if(NOT block MATCHES "project\\(")
    string(PREPEND block "cmake_minimum_required(VERSION 3.25)\nproject(app LANGUAGES CXX)\nadd_executable(app app.cpp)\n")
  endif()
  file(WRITE ${WORK_DIR}/document/CMakeLists.txt "${block}")
  file(COPY_FILE ${SOURCE_DIR}/examples/neighborhood.cpp ${WORK_DIR}/document/app.cpp)
  execute_process(COMMAND ${CMAKE_COMMAND} -S ${WORK_DIR}/document -B ${WORK_DIR}/document/build -G ${GENERATOR} --fresh
    -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_PREFIX_PATH=${prefix} OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND ${CMAKE_COMMAND} --build ${WORK_DIR}/document/build OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
endforeach()

foreach(file man/man1/meshhood.1 bash-completion/completions/meshhood zsh/site-functions/_meshhood
    fish/vendor_completions.d/meshhood.fish)
  file(STRINGS ${prefix}/share/${file} lines REGEX "curvature")
  if(NOT lines)
    message(FATAL_ERROR "share/${file} lacks the command curvature")
  endif()
endforeach()

file(GLOB_RECURSE installed ${prefix}/*)
list(LENGTH installed count)
file(SIZE ${build}/small size)
message("${count} files installed; a program of ten lines has ${size} bytes")
set(limit 726000)  # a searcher has all metrics
if(size GREATER limit)
  message(FATAL_ERROR "expected at most ${limit}: the archive has parts that the program does not use in one object "
    "with those that it does (meshhood_separate_parts)")
endif()
