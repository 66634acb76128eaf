# MESHHOOD_SOURCE is a checkout. In the registry of vcpkg, vcpkg_from_github gives the source of the release instead:
# packaging/RELEASE.md.
set(SOURCE_PATH $ENV{MESHHOOD_SOURCE})
vcpkg_check_features(OUT_FEATURE_OPTIONS features FEATURES io MESHHOOD_BUILD_IO)
vcpkg_cmake_configure(SOURCE_PATH ${SOURCE_PATH} OPTIONS ${features} -DMESHHOOD_BUILD_CLI=OFF)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(CONFIG_PATH lib/cmake/meshhood)
vcpkg_fixup_pkgconfig()
file(REMOVE_RECURSE ${CURRENT_PACKAGES_DIR}/debug/include ${CURRENT_PACKAGES_DIR}/debug/share)
vcpkg_install_copyright(FILE_LIST ${SOURCE_PATH}/LICENSE ${SOURCE_PATH}/NOTICE)
