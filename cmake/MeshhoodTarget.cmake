# What every target of ours is compiled with. Users of the library inherit none of it.
function(meshhood_own_target target)
  # One distance predicate on every path: no fused multiply-add, whatever the compiler's default.
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wconversion -Wshadow -ffp-contract=off)
  # g++ 12 sees overlapping copies in every "..." + std::string (GCC bug 105651).
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    target_compile_options(${target} PRIVATE -Wno-restrict)
  endif()
  # A newer compiler's new warning is our problem, not that of a project that contains us.
  set_target_properties(${target} PROPERTIES
    CXX_EXTENSIONS OFF COMPILE_WARNING_AS_ERROR ${meshhood_IS_TOP_LEVEL})
endfunction()

# For large programs that do nothing for long themselves: to optimise them costs more than it saves.
function(meshhood_compile_quickly target)
  if(CMAKE_CXX_FLAGS MATCHES "-fsanitize")
    target_compile_options(${target} PRIVATE -O0)
  else()
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  endif()
endfunction()

# One kernel for each kind of processor, all of the same names: never in one piece with each other.
set(meshhood_kernels "/simd/(joint_)?(portable|avx2|avx512)\\.cpp$")

# For sources that another target compiles one by one: here several at once, in a fraction of the time.
function(meshhood_compile_together target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 16)
  get_target_property(sources ${target} SOURCES)
  list(FILTER sources INCLUDE REGEX ${meshhood_kernels})
  set_source_files_properties(${sources} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()

# For what touches foreign bytes: a mistake of ours ends the program at once instead of being carried further.
function(meshhood_harden target)
  target_compile_options(${target} PRIVATE -fstack-protector-strong)
  target_compile_definitions(${target} PRIVATE _GLIBCXX_ASSERTIONS)
  # Sanitizers bring checks of their own that fortified functions would hide.
  if(NOT CMAKE_CXX_FLAGS MATCHES "-fsanitize")
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=2>)
  endif()
  target_link_options(${target} PRIVATE $<$<PLATFORM_ID:Linux>:LINKER:-z,relro,-z,now>)
endfunction()
