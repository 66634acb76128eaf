# What need be checked only once, in a plain build: the package, other compilers' targets, the state of the tree.
if(CMAKE_CXX_FLAGS MATCHES "-fsanitize|--coverage")
  return()
endif()

add_subdirectory(install)
add_subdirectory(portability)

add_test(NAME house.format COMMAND ${PROJECT_SOURCE_DIR}/tools/check format)
add_test(NAME house.docs COMMAND ${PROJECT_SOURCE_DIR}/tools/check_docs.py $<$<TARGET_EXISTS:meshhood_cli>:$<TARGET_FILE:meshhood_cli>>)
