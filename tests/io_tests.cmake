# The tests of mesh and index files.
set(stems file ply obj off stl vtk freesurfer float_keeps blocks text index_progress weld unplaced)
if(WIN32) # the others use POSIX, in part only to set up
  foreach(stem IN LISTS stems)
    meshhood_test(io/${stem} meshhood::io meshhood_families fmt::fmt)
  endforeach()
  return()
endif()
foreach(stem IN LISTS stems ITEMS special_file shared_meshes progress index write)
  meshhood_test(io/${stem} meshhood_test_support meshhood_families)
endforeach()
meshhood_test(io/zip ALONE meshhood_test_support meshhood_npz)

# A file system in memory that can be filled.
add_library(meshhood_small_disk STATIC support/small_disk.cpp)
target_include_directories(meshhood_small_disk PUBLIC ${CMAKE_CURRENT_SOURCE_DIR})
meshhood_own_target(meshhood_small_disk)

# Saves that fail, are killed or meet a full disk, for every function that writes a file.
add_library(meshhood_save_trial STATIC support/save_trial.cpp support/savers.cpp)
target_include_directories(meshhood_save_trial PUBLIC ${CMAKE_CURRENT_SOURCE_DIR} ${PROJECT_SOURCE_DIR})
target_link_libraries(meshhood_save_trial PUBLIC
  meshhood_small_disk meshhood_npz meshhood::io meshhood_shapes GTest::gtest)
meshhood_own_target(meshhood_save_trial)
meshhood_compile_quickly(meshhood_save_trial)
function(meshhood_watch_system_calls stem)
  meshhood_test(io/save_${stem} ALONE meshhood_save_trial)
  target_sources(io_save_${stem}_test PRIVATE support/system_calls.cpp)
  foreach(call open write lseek stat fchown fchmod fsync close rename unlink)
    target_link_options(io_save_${stem}_test PRIVATE LINKER:--wrap=${call})
  endforeach()
endfunction()
meshhood_watch_system_calls(calls)

if(NOT MESHHOOD_LONG_TESTS)
  return()
endif()

meshhood_watch_system_calls(power)
target_sources(io_save_power_test PRIVATE support/disk_model.cpp)
foreach(stem full race)
  meshhood_test(io/save_${stem} ALONE meshhood_save_trial)
endforeach()

meshhood_test(io/allocation ALONE meshhood_save_trial)
target_sources(io_allocation_test PRIVATE support/failing_allocations.cpp)
target_compile_definitions(io_allocation_test PRIVATE MESHHOOD_CORPUS="${PROJECT_BINARY_DIR}/fuzz/corpus")

# The process whose peak memory `io/memory` measures.
meshhood_test(io/memory ALONE meshhood_test_support)
add_executable(read_peak support/read_peak.cpp)
target_link_libraries(read_peak PRIVATE meshhood::io)
meshhood_own_target(read_peak)
target_compile_definitions(io_memory_test PRIVATE MESHHOOD_READ_PEAK="$<TARGET_FILE:read_peak>")
add_dependencies(io_memory_test read_peak)
if(NOT CMAKE_CXX_FLAGS MATCHES "-fsanitize")
  find_package(Python3 REQUIRED COMPONENTS Interpreter)
  add_test(NAME io.growth
    COMMAND Python3::Interpreter -B ${CMAKE_CURRENT_SOURCE_DIR}/io/run_growth.py $<TARGET_FILE:read_peak>)
  set_tests_properties(io.growth PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 600)
endif()

meshhood_test(whole/soak ALONE meshhood_test_support meshhood_families)
add_subdirectory(interop)

# With 16-bit ids, so that small files reach the limit.
find_package(fmt REQUIRED)
find_package(FastFloat REQUIRED)
get_target_property(io_sources meshhood_io SOURCES)
list(TRANSFORM io_sources PREPEND ${PROJECT_SOURCE_DIR}/io/)
add_executable(io_limits_test io/limits_test.cpp ${io_sources})
target_include_directories(io_limits_test PRIVATE
  ${CMAKE_CURRENT_SOURCE_DIR} ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/src)
target_link_libraries(io_limits_test PRIVATE
  meshhood_narrow fmt::fmt FastFloat::fast_float GTest::gmock GTest::gtest_main)
meshhood_own_target(io_limits_test)
meshhood_compile_quickly(io_limits_test)
meshhood_compile_together(io_limits_test)
gtest_discover_tests(io_limits_test TEST_PREFIX io.limits. DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 600)
