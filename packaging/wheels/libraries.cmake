# The libraries that a wheel contains, as targets of the names that find_package would give. CMake includes this file
# after project(): CMAKE_PROJECT_meshhood_INCLUDE.

# Those of headers only are copied, as their folder also has the headers of the C library of this machine.
find_path(header_folder fmt/format.h PATHS /usr/include REQUIRED)
set(headers ${CMAKE_BINARY_DIR}/headers)
file(GLOB xxhash ${header_folder}/xxh*.h)
file(COPY ${xxhash} DESTINATION ${headers})
foreach(library CLI fast_float fmt hwy nlohmann)
  file(COPY ${header_folder}/${library} DESTINATION ${headers})
endforeach()
set(MESHHOOD_XXHASH_INCLUDE_DIR ${headers} CACHE PATH "The headers of xxHash")
set(MESHHOOD_HIGHWAY_INCLUDE_DIR ${headers} CACHE PATH "The headers of Highway")
foreach(library CLI11::CLI11 FastFloat::fast_float fmt::fmt nlohmann_json::nlohmann_json)
  add_library(${library} INTERFACE IMPORTED GLOBAL)
  target_include_directories(${library} INTERFACE ${headers})
endforeach()
target_compile_definitions(fmt::fmt INTERFACE FMT_HEADER_ONLY)

# The linker of zig makes no bundles, but Python loads shared libraries as well; and it does not read the file in which
# nanobind names what Python provides at run time.
if(APPLE)
  foreach(language C CXX)
    set(CMAKE_SHARED_MODULE_CREATE_${language}_FLAGS "-shared -Wl,-undefined,dynamic_lookup")
  endforeach()
  function(meshhood_link_by_zig)
    get_target_property(options meshhood_python LINK_OPTIONS)
    list(FILTER options EXCLUDE REGEX "^-Wl,@")
    set_target_properties(meshhood_python PROPERTIES LINK_OPTIONS "${options}")
  endfunction()
  cmake_language(DEFER CALL meshhood_link_by_zig)
endif()
