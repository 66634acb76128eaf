# `cpack --config build/release/CPackConfig.cmake` packs what `cmake --install` installs for Debian.
if(NOT PROJECT_IS_TOP_LEVEL)
  return()
endif()
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME meshhood)
set(CPACK_PACKAGE_CONTACT "The meshhood authors <meshhood@invalid>")
set(CPACK_PACKAGE_DESCRIPTION "meshhood returns the connected component of a polygonal mesh inside a ball around a \
vertex, exact and indexed: a C++20 library, with its headers, and the command meshhood.")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# What a program that uses meshhood::io must find.
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "libfmt-dev, libfast-float-dev")
include(CPack)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright)
