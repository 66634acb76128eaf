# MESHHOOD_VERSION, as 0.1.0: the three numbers of include/meshhood/version.h, which a change of them configures again.
set(header ${CMAKE_CURRENT_LIST_DIR}/../include/meshhood/version.h)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${header})
file(STRINGS ${header} lines REGEX "define MESHHOOD_VERSION_")
string(REGEX MATCHALL "[0-9]+" numbers "${lines}")
list(JOIN numbers . MESHHOOD_VERSION)
