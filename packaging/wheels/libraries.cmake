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
set(XXHASH_INCLUDE_DIR ${headers} CACHE PATH "The headers of xxHash")
set(HIGHWAY_INCLUDE_DIR ${headers} CACHE PATH "The headers of Highway")
foreach(library CLI11::CLI11 FastFloat::fast_float fmt::fmt nlohmann_json::nlohmann_json)
  add_library(${library} INTERFACE IMPORTED GLOBAL)
  target_include_directories(${library} INTERFACE ${headers})
endforeach()
target_compile_definitions(fmt::fmt INTERFACE FMT_HEADER_ONLY)

# minizip with zlib, from sources.
set(MESHHOOD_SOURCES "" CACHE PATH "The folder of the sources of minizip and zlib")
enable_language(C)
add_library(minizip STATIC EXCLUDE_FROM_ALL)
foreach(source minizip/ioapi minizip/unzip minizip/zip zlib/adler32 zlib/crc32 zlib/deflate zlib/inffast zlib/inflate
    zlib/inftrees zlib/trees zlib/zutil)
  target_sources(minizip PRIVATE ${MESHHOOD_SOURCES}/${source}.c)
endforeach()
target_include_directories(minizip SYSTEM PUBLIC ${MESHHOOD_SOURCES} ${MESHHOOD_SOURCES}/zlib)
# The module contains it. By default, zig compiles for programs of fixed position where the C library is musl.
set_target_properties(minizip PROPERTIES UNITY_BUILD OFF POSITION_INDEPENDENT_CODE ON)
target_compile_definitions(minizip PRIVATE NOCRYPT NOUNCRYPT HAVE_UNISTD_H)
if(APPLE) # whose functions for files have 64 bits under their plain names; this zlib takes it for a system without fdopen
  target_compile_definitions(minizip PRIVATE USE_FILE32API fdopen=fdopen)
endif()
add_library(PkgConfig::MINIZIP ALIAS minizip)

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
