# The page of `meshhood view` and `meshhood.view`. It is not part of `all`, because it needs node, npm and clang for
# WebAssembly. `make install` and `pip install` build it where these are installed.
add_custom_target(meshhood_viewer
  COMMAND ${PROJECT_SOURCE_DIR}/tools/build_viewer --if-possible USES_TERMINAL VERBATIM)

# Installs the page, if there is one; otherwise says so.
function(meshhood_install_page destination component)
  set(page ${PROJECT_SOURCE_DIR}/build/viewer/viewer.html)
  install(FILES ${page} DESTINATION ${destination} COMPONENT ${component} OPTIONAL)
  install(CODE "if(NOT EXISTS \"${page}\")
    message(STATUS \"Not installed: the page of meshhood view, which 'make view' builds\")
  endif()" COMPONENT ${component})
endfunction()
