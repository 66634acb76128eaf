# The tests of the core: its rooms one by one, then all of it against the oracle.
add_library(meshhood_families STATIC
  families.cpp
  families_extremes.cpp
  families_surfaces.cpp
  families_traps.cpp
  oracle.cpp)
target_include_directories(meshhood_families PUBLIC ${CMAKE_CURRENT_SOURCE_DIR})
target_link_libraries(meshhood_families PUBLIC meshhood::meshhood)
meshhood_own_target(meshhood_families)

foreach(stem adjacency mesh distance sphere reference error robustness differential metamorphic)
  meshhood_test(${stem} meshhood_families)
endforeach()
add_subdirectory(paper)
