# The installed package: find_package(meshhood CONFIG) gives meshhood::meshhood and, where it was built, meshhood::io.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/meshhood)

install(DIRECTORY include/meshhood DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h")
install(TARGETS meshhood EXPORT meshhood)
install(EXPORT meshhood NAMESPACE meshhood:: FILE meshhoodTargets.cmake DESTINATION ${package_dir})

if(TARGET meshhood_io)
  install(FILES io/index_io.h io/mesh_io.h io/weld.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/meshhood/io)
  install(TARGETS meshhood_io EXPORT meshhood_io)
  install(EXPORT meshhood_io NAMESPACE meshhood:: FILE meshhoodIoTargets.cmake DESTINATION ${package_dir})
endif()
if(TARGET meshhood_cli)
  install(TARGETS meshhood_cli)
  if(TARGET meshhood_manual)
    set(manual ${PROJECT_BINARY_DIR}/manual)
    install(FILES ${manual}/man/meshhood.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
    install(FILES ${manual}/bash/meshhood DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
    install(FILES ${manual}/zsh/_meshhood DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions)
    install(FILES ${manual}/fish/meshhood.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
  endif()
  meshhood_install_page(${CMAKE_INSTALL_DATADIR}/meshhood Unspecified)
endif()

configure_package_config_file(cmake/meshhoodConfig.cmake.in meshhoodConfig.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(meshhoodConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/meshhoodConfig.cmake ${PROJECT_BINARY_DIR}/meshhoodConfigVersion.cmake
  DESTINATION ${package_dir})

# The same for pkg-config, from wherever the files lie. The core is meshhood.pc, the readers meshhood-io.pc.
file(RELATIVE_PATH prefix_from_pc /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
function(meshhood_install_pc name)
  configure_file(cmake/${name}.pc.in ${name}.pc @ONLY)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/${name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endfunction()
meshhood_install_pc(meshhood)
if(TARGET meshhood_io)
  meshhood_install_pc(meshhood-io)
endif()
