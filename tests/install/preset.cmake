# The commands of "On other systems" in docs/cpp.md take the fast way: few units, without warnings and tests. The preset
# for development has all of these.
cmake_minimum_required(VERSION 3.25)
function(configure preset result)
  set(build ${WORK_DIR}/${preset})
  execute_process(COMMAND ${CMAKE_COMMAND} --preset ${preset} -B ${build} --fresh -DCMAKE_CXX_COMPILER=${COMPILER}
    WORKING_DIRECTORY ${SOURCE_DIR} OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
  file(READ ${build}/compile_commands.json commands)
  set(${result} "${commands}" PARENT_SCOPE)
endfunction()
configure(release user)
configure(dev developer)
string(JSON count LENGTH "${user}")
string(JSON developers LENGTH "${developer}")
if(count GREATER 30 OR user MATCHES "-W(error|all)" OR NOT developer MATCHES "-Wall.*-Werror" OR developers LESS 300)
  message(FATAL_ERROR "a user compiles ${count} units, expected at most 30 without warnings; a developer ${developers}")
endif()
message("a user compiles ${count} units, a developer ${developers}")
