# WebAssembly by Debian's clang 22: the packages of `web` in tools/setup.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR wasm32)
set(CMAKE_CXX_COMPILER clang++-22)
# Debian's libraries have the old name of this target, which clang 22 calls wasm32-wasip1.
set(CMAKE_CXX_COMPILER_TARGET wasm32-wasi)
set(CMAKE_CXX_FLAGS_INIT "-Wno-deprecated -fno-exceptions -fno-rtti")
set(MESHHOOD_WASM_SIMD ON CACHE BOOL "Vectors of 128 bits, which all browsers have had since 2023")
if(MESHHOOD_WASM_SIMD)
  string(APPEND CMAKE_CXX_FLAGS_INIT " -msimd128")
endif()
set(CMAKE_EXE_LINKER_FLAGS_INIT "-mexec-model=reactor")
# Programs have no main function.
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)

# Libraries that are headers only. They are copied, as their folder also has the headers of the C library of this machine.
find_path(xxhash_folder xxhash.h PATHS /usr/include REQUIRED)
file(GLOB portable_headers ${xxhash_folder}/xxh*.h ${xxhash_folder}/fmt ${xxhash_folder}/fast_float ${xxhash_folder}/hwy)
file(COPY ${portable_headers} DESTINATION ${CMAKE_BINARY_DIR}/headers)
set(MESHHOOD_XXHASH_INCLUDE_DIR ${CMAKE_BINARY_DIR}/headers CACHE PATH "The headers of xxHash")
set(MESHHOOD_HIGHWAY_INCLUDE_DIR ${CMAKE_BINARY_DIR}/headers CACHE PATH "The headers of Highway")
