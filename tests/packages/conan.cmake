# pylint of the recipe, and `conan create` of it, static and shared, with each of COMPILERS, in a cache of its own. Headers
# of this machine are its requirements.
cmake_minimum_required(VERSION 3.25)
cmake_path(GET PYTHON PARENT_PATH programs)
set(ENV{CONAN_HOME} ${WORK_DIR})
file(REMOVE_RECURSE ${WORK_DIR})
# Without the plugin of ConanCenter, pylint does not know the members of settings.
execute_process(COMMAND ${programs}/pylint --disable=missing-docstring,line-too-long,no-member
  ${SOURCE_DIR}/packaging/conan/conanfile.py ${SOURCE_DIR}/packaging/conan/test_package/conanfile.py
  COMMAND_ERROR_IS_FATAL ANY)
function(conan)
  execute_process(COMMAND ${programs}/conan ${ARGN} OUTPUT_FILE ${WORK_DIR}/log.txt ERROR_FILE ${WORK_DIR}/log.txt
    RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    file(READ ${WORK_DIR}/log.txt log)
    message(FATAL_ERROR "conan ${ARGN}: ${log}")
  endif()
endfunction()
file(MAKE_DIRECTORY ${WORK_DIR})
conan(profile detect)
foreach(library fast_float/3.4.0 fmt/9.1.0 highway/1.0.3 xxhash/0.8.1)
  string(REPLACE "/" ";" library ${library})
  list(GET library 0 name)
  list(GET library 1 version)
  conan(create ${SOURCE_DIR}/tests/packages/system_library --name=${name} --version=${version})
endforeach()
# For Windows, the recipe accepts meshhood::io with MinGW alone, and says so before anything is built.
foreach(compiler "gcc;-s;compiler.version=12;-s;compiler.libcxx=libstdc++11"
    "msvc;-s;compiler.version=193;-s;compiler.runtime=dynamic")
  execute_process(COMMAND ${programs}/conan graph info ${SOURCE_DIR}/packaging/conan -s os=Windows
    -s compiler=${compiler} -s compiler.cppstd=20 --no-remote --format=json OUTPUT_VARIABLE graph ERROR_QUIET)
  string(FIND "${graph}" "with Visual C++: set with_io=False" refused)
  if((compiler MATCHES msvc AND refused EQUAL -1) OR (compiler MATCHES gcc AND NOT refused EQUAL -1) OR NOT graph)
    message(FATAL_ERROR "meshhood::io for Windows, ${compiler}: ${graph}")
  endif()
endforeach()
# The test package is built outside of the sources, and leaves no presets there.
foreach(COMPILER IN LISTS COMPILERS)
  set(compiler)
  if(COMPILER MATCHES "clang\\+\\+-([0-9]+)$")
    string(REPLACE "clang++" "clang" c_compiler ${COMPILER})
    set(compiler -s compiler=clang -s compiler.version=${CMAKE_MATCH_1} -s compiler.libcxx=libstdc++11
      -c "tools.build:compiler_executables={'c': '${c_compiler}', 'cpp': '${COMPILER}'}")
  endif()
  foreach(shared False True)
    conan(create ${SOURCE_DIR}/packaging/conan ${compiler} -s compiler.cppstd=20 -o meshhood/*:shared=${shared}
      -c tools.build:jobs=2 -c tools.cmake.cmake_layout:test_folder=${WORK_DIR}/test
      -c tools.cmake.cmaketoolchain:user_presets= --no-remote)
  endforeach()
endforeach()
