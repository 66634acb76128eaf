# The installed package: find_package(meshhood CONFIG) gives meshhood::meshhood and, where it was built, meshhood::io.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/meshhood)

install(DIRECTORY include/meshhood ${PROJECT_BINARY_DIR}/include/meshhood
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h" PATTERN "io" EXCLUDE)
install(TARGETS meshhood EXPORT meshhood)
install(EXPORT meshhood NAMESPACE meshhood:: FILE meshhoodTargets.cmake DESTINATION ${package_dir})

if(TARGET meshhood_io)
  install(FILES io/index_io.h io/mesh_io.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/meshhood/io)
  install(TARGETS meshhood_io EXPORT meshhood_io)
  install(EXPORT meshhood_io NAMESPACE meshhood:: FILE meshhoodIoTargets.cmake DESTINATION ${package_dir})
endif()
if(TARGET meshhood_cli)
  install(TARGETS meshhood_cli)
  meshhood_install_page(${CMAKE_INSTALL_DATADIR}/meshhood Unspecified)
endif()

configure_package_config_file(cmake/meshhoodConfig.cmake.in meshhoodConfig.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(meshhoodConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/meshhoodConfig.cmake ${PROJECT_BINARY_DIR}/meshhoodConfigVersion.cmake
  DESTINATION ${package_dir})
