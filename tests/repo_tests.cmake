# Checks that are made once, in one plain build: the documents, the installed package, other compilers and processors,
# large meshes, seeded faults, instruction counts.
if(CMAKE_CXX_FLAGS MATCHES "-fsanitize|--coverage")
  return()
endif()

add_test(NAME repo.docs COMMAND ${PROJECT_SOURCE_DIR}/tools/check_docs.py $<$<TARGET_EXISTS:meshhood_cli>:$<TARGET_FILE:meshhood_cli>>)
add_test(NAME repo.includes COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/repo/includes.sh ${PROJECT_SOURCE_DIR})
add_test(NAME repo.borrowed COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/repo/borrowed.sh ${PROJECT_SOURCE_DIR})
add_test(NAME repo.drawings COMMAND python3 -B ${PROJECT_SOURCE_DIR}/tools/drawings --check)
add_test(NAME repo.packages COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/repo/packages_test.sh
  ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_BINARY_DIR}/repo_packages)
add_test(NAME repo.promises COMMAND python3 -B ${CMAKE_CURRENT_SOURCE_DIR}/repo/promises_test.py ${PROJECT_SOURCE_DIR})
add_test(NAME repo.reference COMMAND python3 -B ${CMAKE_CURRENT_SOURCE_DIR}/site/names_test.py ${PROJECT_SOURCE_DIR})
add_test(NAME repo.no_global_state COMMAND python3 -B ${CMAKE_CURRENT_SOURCE_DIR}/repo/no_global_state.py
  $<TARGET_FILE:meshhood> $<TARGET_FILE:meshhood_io>)
if(NOT MESHHOOD_LONG_TESTS)
  return()
endif()
set(with_programs ${CMAKE_CURRENT_SOURCE_DIR}/support/with_programs.sh)
add_subdirectory(integrations)
add_test(NAME repo.format COMMAND ${PROJECT_SOURCE_DIR}/tools/check format)
if(TARGET meshhood_cli)
  add_test(NAME repo.render
    COMMAND ${with_python} -B ${CMAKE_CURRENT_SOURCE_DIR}/repo/render_test.py $<TARGET_FILE:meshhood_cli>)
  set_tests_properties(repo.render PROPERTIES SKIP_RETURN_CODE 77)
  # JavaScript: the package, then the page that uses it.
  set(package ${PROJECT_SOURCE_DIR}/build/wasm/npm)
  add_subdirectory(wasm)
  add_subdirectory(viewer)
  add_subdirectory(site)
  add_subdirectory(packages)
endif()

add_test(NAME repo.same_bytes COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/repo/same_bytes.sh
  ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_BINARY_DIR}/same_bytes ${CMAKE_CXX_COMPILER})
set_tests_properties(repo.same_bytes PROPERTIES TIMEOUT 3600 COST 1000)
add_subdirectory(install)
add_subdirectory(refused)
add_subdirectory(portability)

# Compiled for a processor with fused multiply-add, the distance must not use it.
if(CMAKE_SYSTEM_PROCESSOR STREQUAL "x86_64" AND CMAKE_OBJDUMP)
  add_library(meshhood_haswell OBJECT ${core_sources})
  target_include_directories(meshhood_haswell PRIVATE ${PROJECT_SOURCE_DIR}/include ${PROJECT_SOURCE_DIR}/src)
  target_compile_features(meshhood_haswell PRIVATE cxx_std_20)
  meshhood_own_target(meshhood_haswell)
  meshhood_separate_kernels(meshhood_haswell)
  meshhood_compile_together(meshhood_haswell)
  target_compile_options(meshhood_haswell PRIVATE -march=haswell -O3)
  add_library(meshhood_fused_control OBJECT repo/fused_control.cpp)
  target_compile_options(meshhood_fused_control PRIVATE -march=haswell -O3 -ffp-contract=fast)
  add_test(NAME no_fma COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/repo/no_fma.sh
    $<TARGET_OBJECTS:meshhood_fused_control> $<TARGET_OBJECTS:meshhood_haswell> COMMAND_EXPAND_LISTS)
  add_test(NAME prefetch COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/repo/prefetch.sh
    $<TARGET_OBJECTS:meshhood_haswell> COMMAND_EXPAND_LISTS)
endif()

# No uninitialized byte reaches a file.
if(TARGET meshhood_cli)
  add_executable(uninitialized_control repo/uninitialized_control.cpp)
  target_include_directories(uninitialized_control PRIVATE ${PROJECT_SOURCE_DIR})
  target_link_libraries(uninitialized_control PRIVATE meshhood::io)
  add_test(NAME no_uninitialized_bytes COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/repo/no_uninitialized_bytes.sh
    $<TARGET_FILE:uninitialized_control> $<TARGET_FILE:meshhood_cli>)
  set_tests_properties(no_uninitialized_bytes PROPERTIES SKIP_REGULAR_EXPRESSION "skipped: no valgrind" TIMEOUT 300)
endif()

# Exact answers compared with breadth-first search on large meshes: a part of `tools/verify --full`.
if(TARGET exact_verify)
  foreach(part shared shapes)
    add_test(NAME verify.${part} COMMAND ${PROJECT_SOURCE_DIR}/tools/verify ${part})
    set_tests_properties(verify.${part} PROPERTIES
      ENVIRONMENT "MESHHOOD_VERIFY=$<TARGET_FILE:exact_verify>"
      SKIP_REGULAR_EXPRESSION "skipped: no meshes" TIMEOUT 3000 COST 1000)
  endforeach()
endif()

# Every seeded fault must be detected by a test. The library and these tests are compiled once more, file by file, so
# that a faulty file can take the place of one, when the mutants are run and not before.
add_test(NAME mutants.list COMMAND python3 -B ${CMAKE_CURRENT_SOURCE_DIR}/mutants/run)
if(CMAKE_BUILD_TYPE STREQUAL "Release")
  execute_process(COMMAND python3 -B ${CMAKE_CURRENT_SOURCE_DIR}/mutants/run --tests
    OUTPUT_VARIABLE mutant_tests OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  string(REPLACE "\n" ";" mutant_tests "${mutant_tests}")
  list(TRANSFORM mutant_tests APPEND _test.cpp)
  add_library(mutant_tests OBJECT EXCLUDE_FROM_ALL ${mutant_tests})
  get_target_property(mutant_sources meshhood_parts SOURCES)
  list(TRANSFORM mutant_sources PREPEND ${PROJECT_SOURCE_DIR}/parts/)
  get_target_property(mutant_readers meshhood_io SOURCES)
  get_target_property(mutant_writers meshhood_npz SOURCES)
  list(APPEND mutant_readers ${mutant_writers})
  list(TRANSFORM mutant_readers PREPEND ${PROJECT_SOURCE_DIR}/io/)
  find_package(fmt REQUIRED)
  find_package(nlohmann_json REQUIRED)
  add_library(mutant_library STATIC EXCLUDE_FROM_ALL ${core_sources} ${mutant_sources} ${mutant_readers} support/small_disk.cpp)
  target_link_libraries(mutant_library PRIVATE nlohmann_json::nlohmann_json)
  add_dependencies(mutant_library meshhood_families meshhood_io meshhood_test_support)
  target_compile_definitions(mutant_tests PRIVATE MESHHOOD_GOLDEN_DIR="${CMAKE_CURRENT_SOURCE_DIR}/golden")
  foreach(target mutant_tests mutant_library)
    target_include_directories(${target} PRIVATE
      $<TARGET_PROPERTY:meshhood,INCLUDE_DIRECTORIES> ${CMAKE_CURRENT_SOURCE_DIR} ${PROJECT_SOURCE_DIR})
    target_link_libraries(${target} PRIVATE GTest::gmock fmt::fmt)
    target_compile_features(${target} PRIVATE cxx_std_20)
    meshhood_own_target(${target})
    meshhood_compile_quickly(${target})
    set_target_properties(${target} PROPERTIES UNITY_BUILD OFF)
  endforeach()
  file(GENERATE OUTPUT ${PROJECT_BINARY_DIR}/mutants/link.txt CONTENT "${CMAKE_CXX_COMPILER}
-Wl,--start-group $<TARGET_FILE:meshhood_families> $<TARGET_FILE:meshhood_test_support> $<TARGET_FILE:mutant_library>
$<TARGET_FILE:meshhood_io> -Wl,--end-group $<TARGET_FILE:fmt::fmt> ${ZSTD_LINK_LIBRARIES}
$<TARGET_FILE:GTest::gmock> $<TARGET_FILE:GTest::gtest_main> $<TARGET_FILE:GTest::gtest>
")
  add_test(NAME mutants.build COMMAND ${CMAKE_COMMAND} --build ${PROJECT_BINARY_DIR}
    --target mutant_tests mutant_library)
  set_tests_properties(mutants.build PROPERTIES FIXTURES_SETUP mutants TIMEOUT 1800 COST 1001)
  add_test(NAME mutants.run COMMAND python3 -B ${CMAKE_CURRENT_SOURCE_DIR}/mutants/run ${PROJECT_BINARY_DIR})
  set_tests_properties(mutants.run PROPERTIES FIXTURES_REQUIRED mutants TIMEOUT 3600 COST 1000)
endif()

# The instruction counts of fixed queries and builds, compared with the committed baseline.
if(CMAKE_BUILD_TYPE STREQUAL "Release" AND TARGET guard)
  add_test(NAME bench.guard COMMAND python3 -B ${PROJECT_SOURCE_DIR}/bench/guard/guard.py $<TARGET_FILE:guard>)
  set_tests_properties(bench.guard PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 600)
endif()

# The harness on a small shape, and the places of its tables in the documents.
if(TARGET race AND TARGET meshhood_cli)
  add_test(NAME bench.harness COMMAND python3 -B ${CMAKE_CURRENT_SOURCE_DIR}/repo/bench_test.py $<TARGET_FILE_DIR:race>)
endif()
