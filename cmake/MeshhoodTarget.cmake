include(CheckCXXCompilerFlag)

# Finds a package, unless a project that contains this one has its target already.
macro(meshhood_find package target)
  if(NOT TARGET ${target})
    find_package(${package} ${ARGN})
  endif()
endmacro()

# The options of every target of this project. Users of the library inherit none of them.
function(meshhood_own_target target)
  # The same distance predicate on every path: no fused multiply-add, whatever the default of the compiler.
  target_compile_options(${target} PRIVATE -ffp-contract=off)
  # And no excess precision: by default, x86 of 32 bits computes in 80.
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "^i[3-6]86$")
    target_compile_options(${target} PRIVATE -msse2 -mfpmath=sse)
  endif()
  # At -O0 and -Og, it calls the square root of its C library, which rounds twice: 238 of a million are another number.
  if(MINGW)
    target_compile_options(${target} PRIVATE $<$<CONFIG:Debug>:-O1>)
  endif()
  # On x86, g++ copies and clears a few hundred bytes by string instructions. Calls of memcpy and memset are faster.
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    check_cxx_compiler_flag(-mstringop-strategy=libcall MESHHOOD_HAS_STRING_INSTRUCTIONS)
    if(MESHHOOD_HAS_STRING_INSTRUCTIONS)
      target_compile_options(${target} PRIVATE -mstringop-strategy=libcall)
    endif()
  endif()
  # Not in the build of a user: a new warning of a newer compiler must not stop it, and to look for them takes time.
  if(MESHHOOD_WARNINGS)
    target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wconversion -Wshadow)
  endif()
  # g++ 12 warns of overlapping copies in every "..." + std::string (GCC bug 105651).
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    target_compile_options(${target} PRIVATE -Wno-restrict)
  endif()
  # g++ takes a source inside a unity build for a header, where a type with a member from this file would be a fault.
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(${target} PRIVATE -Wno-subobject-linkage)
    # With its default limit, the garbage collector of g++ takes a tenth of the time to compile a unit build.
    target_compile_options(${target} PRIVATE --param=ggc-min-heapsize=1048576)
  endif()
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF COMPILE_WARNING_AS_ERROR ${MESHHOOD_WARNINGS})
endfunction()

# The names of a shared library: while the first number of the version is 0, a change of the second breaks programs. Each
# symbol has the name of its library for version, so that a process can have two of them.
function(meshhood_version_library target)
  set_target_properties(${target} PROPERTIES
    VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
  include(CheckLinkerFlag)
  check_linker_flag(CXX -Wl,--default-symver MESHHOOD_VERSIONS_SYMBOLS)
  if(BUILD_SHARED_LIBS AND MESHHOOD_VERSIONS_SYMBOLS)
    target_link_options(${target} PRIVATE -Wl,--default-symver)
  endif()
endfunction()

# For large programs that spend little time in their own code: optimizing them takes longer than it saves. -Og compiles
# in three quarters of the time of -O1, and the tests run as fast.
function(meshhood_compile_quickly target)
  if(CMAKE_CXX_FLAGS MATCHES "-fsanitize")
    target_compile_options(${target} PRIVATE -O0)
  elseif(MINGW)
    target_compile_options(${target} PRIVATE -O1)
  else()
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:$<IF:$<BOOL:${MESHHOOD_SMALL}>,-Os,-Og>>)
    target_compile_definitions(${target} PRIVATE XXH_NO_INLINE_HINTS=1)  # xxHash demands inlining that -Og does not do
  endif()
endfunction()

# Compiles several sources at once, in a fraction of the time. Another target must compile them one by one.
function(meshhood_compile_together target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 0)
endfunction()

# In a unity build of the core, each part is a unit of its own, so that a linker takes from the archive only those that a
# program uses. What every program uses is one part: the index, its construction, and searches around a vertex. What
# rarely runs is another, and compiled with -O2. The Python module has them all: there the rest is one unit, which takes
# less time to compile.
function(meshhood_separate_parts target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD_MODE GROUP)
  get_target_property(sources ${target} SOURCES)
  foreach(source IN LISTS sources)
    if(source MATCHES "src/(exact/joint|exact/query|[a-z]+)/")
      set(part ${CMAKE_MATCH_1})
      if(source MATCHES "/(base/(ball_searcher|cut_edges|face_graph|fingerprint|triangulate)|shared/checksum|format/[a-z_]+|\
exact/(check|extract_graph|file|link_points|masked|quality|refit|reorder|verify[a-z_]*))\\.cpp$")
        set(part others)
      elseif(part MATCHES "^(base|shared|simd)$")
        set(part exact)
      endif()
      if(MESHHOOD_BUILD_PYTHON AND part MATCHES "^(others|paper)$")
        set(part others)
      elseif(MESHHOOD_BUILD_PYTHON AND NOT part STREQUAL "exact")
        set(part queries)
      endif()
      string(MAKE_C_IDENTIFIER ${part} part)
      set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${part})
    endif()
  endforeach()
  set_source_files_properties(${PROJECT_BINARY_DIR}/CMakeFiles/${target}.dir/Unity/unity_others_cxx.cxx PROPERTIES
    COMPILE_OPTIONS $<$<CONFIG:Release>:-O2>)
endfunction()

# In a unity build of the core, each source of kernels is a unit of its own.
function(meshhood_separate_kernels target)
  get_target_property(kernels ${target} SOURCES)
  list(FILTER kernels INCLUDE REGEX "/simd/[a-z]+_kernels\\.cpp$")
  set_source_files_properties(${kernels} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  # g++ would replace the stores of `clear_words` by a call of memset, which takes longer.
  set_source_files_properties(${kernels} PROPERTIES
    COMPILE_OPTIONS $<$<CXX_COMPILER_ID:GNU>:-fno-tree-loop-distribute-patterns>)
endfunction()

# For code that reads untrusted bytes: an error ends the program at once.
function(meshhood_harden target)
  target_compile_options(${target} PRIVATE -fstack-protector-strong)
  target_compile_definitions(${target} PRIVATE _GLIBCXX_ASSERTIONS)
  # Fortified functions would hide errors from the sanitizers.
  if(NOT CMAKE_CXX_FLAGS MATCHES "-fsanitize")
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=2>)
  endif()
  target_link_options(${target} PRIVATE $<$<PLATFORM_ID:Linux>:LINKER:-z,relro,-z,now>)
  if(MINGW)
    target_link_libraries(${target} PRIVATE ssp) # what the protected stack and fortified functions call
  endif()
endfunction()
