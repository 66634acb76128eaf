# The tests of the core: each folder by itself, then the whole against the oracle.
add_library(meshhood_families STATIC
  support/families.cpp
  support/families_extremes.cpp
  support/families_surfaces.cpp
  support/families_traps.cpp
  support/oracle.cpp)
target_include_directories(meshhood_families PUBLIC ${CMAKE_CURRENT_SOURCE_DIR})
target_link_libraries(meshhood_families PUBLIC meshhood::meshhood)
meshhood_own_target(meshhood_families)
target_compile_options(meshhood_families PRIVATE $<$<CONFIG:Release>:-O1>)

set(parts
  base/adjacency base/frame base/mesh base/triangulate shared/coarse_float shared/disjoint_sets shared/distance shared/row_order base/sphere base/reference base/error shared/helper_threads shared/parallel shared/raw_vector
  base/cut_edges base/epoch_array base/number_set base/packed_positions base/face_graph
  aggregate/aggregate aggregate/listed_sums aggregate/smoothing
  batch/batch batch/packets batch/path_rows batch/position_sort batch/kept_packets batch/k_nearest batch/unconnected
  exact/build_threads exact/masked exact/link_points
  exact/nearest_packet exact/path_packet exact/quality exact/refit exact/check exact/damage exact/file exact/index exact/verify
  exact/search_order exact/search_rare exact/search_traps exact/threads
  exact/query/any_center exact/query/nearest exact/query/path_order exact/query/path_search exact/query/single_queries
  exact/search/component exact/search/vertex_bfs
  paper/create paper/select paper/fusion paper/link paper/build paper/check paper/query paper/file
  patch/clip patch/packet_patches patch/patch surface/box_tree surface/closest_point surface/first_hit surface/normal_cones surface/submesh surface/surface surface/surface_paths surface/thickness
  curvature/bits curvature/corrected curvature/curvatures curvature/features curvature/filter curvature/moments curvature/packet_moments curvature/quadric curvature/sure_leaves
  simd/kernels simd/patch_kernels
  whole/arguments whole/metrics whole/outlives whole/robustness whole/same_bits whole/differential)
if(WIN32)
  list(REMOVE_ITEM parts base/packed_positions shared/parallel) # mmap and fork
endif()
foreach(part IN LISTS parts)
  meshhood_test(${part} meshhood_families)
endforeach()
add_subdirectory(golden)

if(NOT WIN32) # aligned_alloc
  foreach(part allocation allocation_calls)
    meshhood_test(whole/${part} ALONE meshhood_families)
    target_sources(whole_${part}_test PRIVATE support/failing_allocations.cpp)
  endforeach()
endif()

if(TARGET meshhood_test_support)
  meshhood_test(exact/reorder meshhood_families meshhood_test_support)
  meshhood_test(exact/index_meshes meshhood_test_support)
  meshhood_test(surface/submesh_meshes meshhood_families meshhood_test_support)
  meshhood_test(whole/all_meshes meshhood_test_support)
endif()

# The sources of the core, to be compiled in other ways than the library is.
get_target_property(core_sources meshhood SOURCES)
list(TRANSFORM core_sources PREPEND ${PROJECT_SOURCE_DIR}/)

if(NOT MESHHOOD_LONG_TESTS)
  return()
endif()

# A test that cannot run here.
function(meshhood_skip_test name reason)
  add_test(NAME ${name} COMMAND ${CMAKE_COMMAND} -E echo "skipped: ${reason}")
  set_tests_properties(${name} PROPERTIES SKIP_REGULAR_EXPRESSION "skipped")
endfunction()

find_package(Eigen3 QUIET NO_MODULE)
# Compared with CGAL, which no part of the library needs.
find_package(CGAL QUIET)
if(CGAL_FOUND)
  meshhood_test(base/sphere_cgal ALONE meshhood_families meshhood_test_support CGAL::CGAL)
else()
  meshhood_skip_test(base.sphere_cgal "no CGAL (libcgal-dev)")
endif()

if(CGAL_FOUND AND TARGET Eigen3::Eigen)
  meshhood_test(curvature/jet_cgal ALONE meshhood_families CGAL::CGAL Eigen3::Eigen)
  target_compile_definitions(curvature_jet_cgal_test PRIVATE CGAL_EIGEN3_ENABLED)
else()
  meshhood_skip_test(curvature.jet_cgal "no CGAL and Eigen (libcgal-dev, libeigen3-dev)")
endif()

# Meshes of other libraries, where these are found.
if(CGAL_FOUND)
  # Surface_mesh.h of CGAL 5.5 is an error for clang 19.
  include(CheckCXXSourceCompiles)
  set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
  set(CMAKE_REQUIRED_INCLUDES ${CGAL_INCLUDE_DIRS})
  check_cxx_source_compiles("#include <CGAL/Surface_mesh.h>" MESHHOOD_CGAL_COMPILES)
  unset(CMAKE_REQUIRED_INCLUDES)
  unset(CMAKE_TRY_COMPILE_TARGET_TYPE)
endif()
if(MESHHOOD_CGAL_COMPILES)
  meshhood_test(adapters/cgal ALONE CGAL::CGAL)
else()
  meshhood_skip_test(adapters.cgal "no CGAL (libcgal-dev), or it does not compile with this compiler")
endif()
find_package(OpenMesh CONFIG QUIET)  # CGAL has a module of this name
if(OpenMesh_FOUND)
  meshhood_test(adapters/openmesh ALONE OpenMeshCore)
else()
  meshhood_skip_test(adapters.openmesh "no OpenMesh (libopenmesh-dev)")
endif()
# Debian has no package: give CMAKE_PREFIX_PATH.
find_path(MESHHOOD_GEOMETRY_CENTRAL_INCLUDE geometrycentral/surface/surface_mesh.h)
find_library(MESHHOOD_GEOMETRY_CENTRAL_LIBRARY geometry-central)
if(MESHHOOD_GEOMETRY_CENTRAL_INCLUDE AND MESHHOOD_GEOMETRY_CENTRAL_LIBRARY AND Eigen3_FOUND)
  meshhood_test(adapters/geometry_central ALONE ${MESHHOOD_GEOMETRY_CENTRAL_LIBRARY} Eigen3::Eigen)
  target_include_directories(adapters_geometry_central_test SYSTEM PRIVATE ${MESHHOOD_GEOMETRY_CENTRAL_INCLUDE})
else()
  meshhood_skip_test(adapters.geometry_central "no geometry-central")
endif()

# Ids of 16 bits, so that small meshes reach every limit.
add_subdirectory(narrow_ids)

# Flushing of denormals is a flag of an x86 register.
if(CMAKE_SYSTEM_PROCESSOR STREQUAL "x86_64")
  meshhood_test(whole/float_modes ALONE meshhood_families)
endif()

meshhood_test(base/searcher ALONE meshhood_families)
# Views of matrices of Eigen are tested where it is found.
meshhood_test(base/views ALONE meshhood_families meshhood::io)
if(TARGET Eigen3::Eigen)
  target_link_libraries(base_views_test PRIVATE Eigen3::Eigen)
endif()
