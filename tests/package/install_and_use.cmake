# Installs the build into a fresh prefix, then configures, builds and runs a stand-alone project against it.
#   cmake -DBUILD=<build folder> -DSOURCE=<this folder> -DWORK=<scratch folder> -DCOMPILER=<c++> -P install_and_use.cmake
file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "failed: ${ARGV}\n${output}")
  endif()
  message(STATUS "${output}")
endfunction()

run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)

# The consumer includes every public header, so that none needs a file that is not installed. Headers that need a
# library of their own (YAML, command line) are internal to their room and left out.
file(GLOB_RECURSE headers RELATIVE ${WORK}/prefix/include ${WORK}/prefix/include/floatframe/*.hpp)
set(text "#pragma once\n")
foreach(header IN LISTS headers)
  file(STRINGS ${WORK}/prefix/include/${header} foreign
       REGEX "#include <(yaml-cpp|fmt|CLI|nlohmann)/")
  if(NOT foreign)
    string(APPEND text "#include \"${header}\"\n")
  endif()
endforeach()
file(COPY ${SOURCE}/consumer/ DESTINATION ${WORK}/consumer)
file(WRITE ${WORK}/consumer/all_headers.hpp "${text}")

run(${CMAKE_COMMAND} -S ${WORK}/consumer -B ${WORK}/build -DCMAKE_PREFIX_PATH=${WORK}/prefix
    -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS=${FLAGS})
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${WORK}/build/consumer)
if(EXISTS ${WORK}/prefix/bin/floatframe)
  run(${WORK}/prefix/bin/floatframe --version)
endif()
