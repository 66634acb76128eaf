# Builds and installs the libraries as shared ones by each of COMPILERS: they export the interface alone, and programs of
# each compiler use them.
cmake_minimum_required(VERSION 3.25)
include(${SOURCE_DIR}/tests/install/consume.cmake)
set(exported python3 -B ${SOURCE_DIR}/tests/repo/exported.py ${SOURCE_DIR})
foreach(maker IN LISTS COMPILERS)
  cmake_path(GET maker FILENAME name)
  set(build ${WORK_DIR}/${name}/build)
  set(prefix ${WORK_DIR}/${name}/installed)
  file(REMOVE_RECURSE ${prefix})
  execute_process(COMMAND ${CMAKE_COMMAND} -S ${SOURCE_DIR} -B ${build} -G ${GENERATOR} -DBUILD_SHARED_LIBS=ON
    -DMESHHOOD_BUILD_CLI=OFF -DCMAKE_CXX_COMPILER=${maker} OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND ${CMAKE_COMMAND} --build ${build} --parallel 2 OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND ${CMAKE_COMMAND} --install ${build} --prefix ${prefix}
    OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
  file(GLOB libraries ${prefix}/*/libmeshhood*.so.${VERSION})
  list(LENGTH libraries count)
  if(NOT count EQUAL 2)
    message(FATAL_ERROR "shared libraries with the version in their name: ${libraries}, expected two")
  endif()
  execute_process(COMMAND ${exported} ${libraries} COMMAND_ERROR_IS_FATAL ANY)
  foreach(COMPILER IN LISTS COMPILERS)
    cmake_path(GET COMPILER FILENAME user)
    consume(${prefix} ${WORK_DIR}/${name}/${user})
  endforeach()
endforeach()

# What follows is about those of the first compiler.
list(GET COMPILERS 0 COMPILER)
cmake_path(GET COMPILER FILENAME name)
set(build ${WORK_DIR}/${name}/build)
set(prefix ${WORK_DIR}/${name}/installed)
file(GLOB libraries ${prefix}/*/libmeshhood*.so.${VERSION})
list(APPEND exported ${libraries})

# Programs of a release with the same soname still link. A symbol that is gone is noticed.
string(REGEX MATCH "^[0-9]+\\.[0-9]+" soname ${VERSION})
file(GLOB released ${SOURCE_DIR}/tests/packages/released/${soname}.*)
list(TRANSFORM released PREPEND --released=)
execute_process(COMMAND ${exported} ${released} COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${exported} --list OUTPUT_FILE ${WORK_DIR}/0.0.9 COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${exported} --released=${WORK_DIR}/0.0.9 OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
file(APPEND ${WORK_DIR}/0.0.9 "_ZN8meshhood4v0_14goneEv\n")
execute_process(COMMAND ${exported} --released=${WORK_DIR}/0.0.9 OUTPUT_VARIABLE said RESULT_VARIABLE result)
if(result EQUAL 0 OR NOT said MATCHES "0.0.9 had _ZN8meshhood4v0_14goneEv, which is gone")
  message(FATAL_ERROR "a symbol that is gone was not noticed: ${said}")
endif()

file(GLOB packages ${prefix}/*/pkgconfig)
set(ENV{PKG_CONFIG_PATH} ${packages})
execute_process(COMMAND pkg-config --cflags --libs meshhood-io
  OUTPUT_VARIABLE flags OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
separate_arguments(flags UNIX_COMMAND "${flags}")
cmake_path(GET packages PARENT_PATH folder)
execute_process(COMMAND ${COMPILER} -std=c++20 -fvisibility=hidden ${SOURCE_DIR}/tests/install/consumer/main.cpp
  ${flags} -Wl,-rpath,${folder} -o ${WORK_DIR}/consumer COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${WORK_DIR}/consumer ${WORK_DIR} COMMAND_ERROR_IS_FATAL ANY)

# Two minor versions can be in one process, and an object of the headers of one does not link to the library of another.
execute_process(COMMAND nm -D ${WORK_DIR}/consumer OUTPUT_VARIABLE used COMMAND_ERROR_IS_FATAL ANY)
if(NOT used MATCHES " U _ZN8meshhood[^\n]*@libmeshhood[.]so[.]${soname}")
  message(FATAL_ERROR "the symbols of the library have no version: ${used}")
endif()
file(GLOB headers RELATIVE ${SOURCE_DIR}/include ${SOURCE_DIR}/include/meshhood/*.h)
foreach(header IN LISTS headers)
  file(READ ${SOURCE_DIR}/include/${header} text)
  string(REGEX REPLACE "v[0-9]+_[0-9]+" "v0_99" text "${text}")
  file(WRITE ${WORK_DIR}/next/${header} "${text}")
endforeach()
execute_process(COMMAND ${COMPILER} -std=c++20 -I${WORK_DIR}/next ${SOURCE_DIR}/tests/install/consumer/small.cpp
  ${flags} -o ${WORK_DIR}/small ERROR_VARIABLE said RESULT_VARIABLE result)
if(result EQUAL 0 OR NOT said MATCHES "undefined reference to `meshhood::v0_99::")
  message(FATAL_ERROR "headers of another version link: ${said}")
endif()

# With the command line, which uses more of io than programs may.
execute_process(COMMAND ${CMAKE_COMMAND} -DMESHHOOD_BUILD_CLI=ON ${build}
  OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} --build ${build} --parallel 2 OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${build}/meshhood --version COMMAND_ERROR_IS_FATAL ANY)
