# The tests of meshes in parts.
meshhood_find(fmt fmt::fmt REQUIRED)
foreach(stem partition chunked_mesh cut_tree folder)
  meshhood_test(parts/${stem} meshhood_parts meshhood_families fmt::fmt)
endforeach()
if(WIN32)
  return()
endif()
meshhood_test(parts/stopped_folder meshhood_parts meshhood_families meshhood_small_disk)
if(NOT MESHHOOD_LONG_TESTS)
  return()
endif()

meshhood_test(parts/allocation ALONE meshhood_parts meshhood_families)
target_sources(parts_allocation_test PRIVATE support/failing_allocations.cpp)

meshhood_test(parts/memory ALONE meshhood_parts meshhood_shapes)
# The process whose peak memory `parts/memory` measures.
add_executable(partition_peak support/partition_peak.cpp)
target_link_libraries(partition_peak PRIVATE meshhood_parts)
meshhood_own_target(partition_peak)
target_compile_definitions(parts_memory_test PRIVATE MESHHOOD_PARTITION_PEAK="$<TARGET_FILE:partition_peak>")
add_dependencies(parts_memory_test partition_peak)
