# What a package for Debian has beside what `cmake --install` installs: run by CPack, in the folder that it packs.
if(NOT CPACK_GENERATOR STREQUAL "DEB")
  return()
endif()
set(root ${CPACK_TEMPORARY_INSTALL_DIRECTORY}${CPACK_PACKAGING_INSTALL_PREFIX})
set(share ${root}/share)
set(documents ${share}/doc/${CPACK_PACKAGE_NAME})

file(READ ${documents}/LICENSE license)
file(READ ${documents}/NOTICE notice)
file(REMOVE ${documents}/LICENSE ${documents}/NOTICE)
string(REGEX REPLACE "\n## Apache-2.0\n.*(\n## LLVM-exception\n)"
  "\n## Apache-2.0\n\nOn Debian systems, the text is in /usr/share/common-licenses/Apache-2.0.\n\\1" notice "${notice}")
file(WRITE ${documents}/copyright "${license}\n${notice}")

string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
file(WRITE ${documents}/changelog "${CPACK_PACKAGE_NAME} (${CPACK_PACKAGE_VERSION}) unstable; urgency=medium

  * CHANGELOG.md of the sources says what is new.

 -- ${CPACK_PACKAGE_CONTACT}  ${date}
")
file(GLOB texts ${documents}/changelog ${share}/man/man1/*.1)
execute_process(COMMAND gzip --best --no-name --force ${texts} COMMAND_ERROR_IS_FATAL ANY)
