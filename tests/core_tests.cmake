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

foreach(stem adjacency mesh distance sphere reference error arguments robustness differential metamorphic parallel batch)
  meshhood_test(${stem} meshhood_families)
endforeach()
add_subdirectory(paper)
add_subdirectory(golden)
foreach(stem index_structure serialize serialize_paper index_damage index_rules search_families search_differential search_rare search_simd threads)
  meshhood_test(${stem} meshhood_families)
endforeach()
meshhood_test(index_threads meshhood_families meshhood_test_support)
meshhood_test(reorder meshhood_families meshhood_test_support)
meshhood_test(search_meshes meshhood_test_support meshhood_shapes)

meshhood_test(allocation meshhood_families)
target_sources(allocation_test PRIVATE support/failing_allocations.cpp)

# On real meshes.
meshhood_test(paper_meshes meshhood_test_support)
meshhood_test(all_meshes meshhood_test_support)

# Beside CGAL, which no part of the library needs.
find_package(CGAL QUIET)
if(CGAL_FOUND)
  meshhood_test(sphere_cgal meshhood_families meshhood_test_support CGAL::CGAL)
else()
  add_test(NAME sphere_cgal COMMAND ${CMAKE_COMMAND} -E echo "skipped: no CGAL (libcgal-dev)")
  set_tests_properties(sphere_cgal PROPERTIES SKIP_REGULAR_EXPRESSION "skipped")
endif()

# The sources of the core, to be compiled in other ways than the library is.
get_target_property(core_sources meshhood SOURCES)
list(TRANSFORM core_sources PREPEND ${PROJECT_SOURCE_DIR}/)

# Ids of 16 bits, so that small meshes reach every limit.
add_subdirectory(narrow_ids)

# Flushed denormals are set in a register of x86.
if(CMAKE_SYSTEM_PROCESSOR STREQUAL "x86_64")
  meshhood_test(float_modes meshhood_families)
endif()
