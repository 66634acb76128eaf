# The tests of the shapes and of the command line.
meshhood_test(whole/shapes meshhood_shapes)

if(MESHHOOD_BUILD_CLI)
  find_package(Python3 REQUIRED COMPONENTS Interpreter)
  set(transcripts aggregate batch build check closest compare connect curvature errors features generate help holes index info names paper partition patch precision query region shell streams tables unconnected values view weld)
  if(MESHHOOD_LONG_TESTS AND NOT CMAKE_CXX_FLAGS MATCHES "-fsanitize")
    list(APPEND transcripts limits)
  endif()
  foreach(name ${transcripts})
    add_test(NAME cli.${name}
      COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/cli/run_transcript.py
        ${CMAKE_CURRENT_SOURCE_DIR}/cli/${name}.txt ${CMAKE_CROSSCOMPILING_EMULATOR} $<TARGET_FILE:meshhood_cli>)
  endforeach()
  if(WIN32)
    return()
  endif()
  add_test(NAME cli.interrupt
    COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/cli/run_interrupt.py $<TARGET_FILE:meshhood_cli>)
  add_test(NAME cli.blocking
    COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/cli/run_blocking.py $<TARGET_FILE:meshhood_cli>)
  set_tests_properties(cli.blocking PROPERTIES TIMEOUT 900)
  add_test(NAME cli.terminal
    COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/cli/run_terminal.py $<TARGET_FILE:meshhood_cli>)
  add_test(NAME cli.manual
    COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/cli/run_manual.py $<TARGET_FILE:meshhood_cli>)
  if(MESHHOOD_LONG_TESTS AND NOT CMAKE_CXX_FLAGS MATCHES "-fsanitize")
    add_test(NAME cli.pairs
      COMMAND ${with_python} -B ${CMAKE_CURRENT_SOURCE_DIR}/cli/run_pairs.py
        $<TARGET_FILE:meshhood_cli> ${PROJECT_SOURCE_DIR}/../shared)
    set_tests_properties(cli.pairs PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 1800)
  endif()
endif()
