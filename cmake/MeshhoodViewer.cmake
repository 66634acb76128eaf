# Installs the page of `meshhood view` and `meshhood.view`, if there is one; otherwise says so. No build here makes it,
# because that needs node, npm and clang for WebAssembly, and takes as long as the library: `make view` does, and a source
# package contains it.
function(meshhood_install_page destination component)
  set(page ${PROJECT_SOURCE_DIR}/build/viewer/viewer.html)
  install(FILES ${page} DESTINATION ${destination} COMPONENT ${component} OPTIONAL)
  install(CODE "if(NOT EXISTS \"${page}\")
    message(STATUS \"Not installed: the page of meshhood view. 'make view' builds it, and the next installation takes it\")
  endif()" COMPONENT ${component})
endfunction()
