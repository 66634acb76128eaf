# Packs this build for Debian, and uses the package as it is installed: the library with each of COMPILERS, the command
# line with its manual page and completions. apt must find all that the package depends on.
cmake_minimum_required(VERSION 3.25)
include(${SOURCE_DIR}/tests/install/consume.cmake)
file(REMOVE_RECURSE ${WORK_DIR})
execute_process(COMMAND ${CPACK} --config ${BUILD_DIR}/CPackConfig.cmake -B ${WORK_DIR}
  OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
file(GLOB package ${WORK_DIR}/meshhood_${VERSION}_*.deb)
execute_process(COMMAND dpkg-deb --extract ${package} ${WORK_DIR}/root COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND dpkg-deb --field ${package} Depends
  OUTPUT_VARIABLE needed OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
if(NOT needed MATCHES "libc6.*libfmt.*libstdc")
  message(FATAL_ERROR "the package depends on ${needed}")
endif()
# The address of the maintainer is to be filled in before a release: packaging/RELEASE.md.
find_program(lintian lintian)
if(lintian)
  execute_process(COMMAND ${lintian} --allow-root --fail-on error --suppress-tags bogus-mail-host,bogus-mail-host-in-debian-changelog
    ${package}
    COMMAND_ERROR_IS_FATAL ANY)
elseif(ALL_PACKAGES)
  message(FATAL_ERROR "lintian is not installed (tools/setup packages)")
else()
  message("lintian is not installed: it has not checked the package (tools/setup packages)")
endif()
execute_process(COMMAND apt-get install --simulate --quiet=2 ${package} OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)

set(prefix ${WORK_DIR}/root/usr)
foreach(file man/man1/meshhood.1.gz bash-completion/completions/meshhood zsh/site-functions/_meshhood
    fish/vendor_completions.d/meshhood.fish doc/meshhood/copyright)
  if(NOT EXISTS ${prefix}/share/${file})
    message(FATAL_ERROR "no share/${file}")
  endif()
endforeach()
# All of NOTICE but the text of a license that Debian has.
file(READ ${prefix}/share/doc/meshhood/copyright copyright)
file(READ ${SOURCE_DIR}/NOTICE notice)
string(REGEX REPLACE "\n## Apache-2.0\n.*\n## LLVM-exception\n" ";" notice "${notice}")
foreach(text IN LISTS notice)
  string(FIND "${copyright}" "${text}" at)
  if(at EQUAL -1)
    message(FATAL_ERROR "share/doc/meshhood/copyright does not have: ${text}")
  endif()
endforeach()
execute_process(COMMAND ${prefix}/bin/meshhood --version
  OUTPUT_VARIABLE version OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
if(NOT version MATCHES "^meshhood ${VERSION}, kernels for ")
  message(FATAL_ERROR "the command line says ${version}")
endif()
foreach(COMPILER IN LISTS COMPILERS)
  cmake_path(GET COMPILER FILENAME name)
  consume(${prefix} ${WORK_DIR}/${name})
endforeach()
file(SIZE ${package} size)
cmake_path(GET package FILENAME name)
message("${name}: ${size} bytes, needs ${needed}")
