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

# By hand, without the package: what is compiled with other settings of Eigen must not link, also where the linker
# drops unused sections; with the settings of the package it links.
file(GLOB library ${WORK}/prefix/lib*/libfloatframe.so ${WORK}/prefix/lib/*/libfloatframe.so)
separate_arguments(hand_flags NATIVE_COMMAND "${FLAGS}")
set(by_hand ${COMPILER} ${hand_flags} -std=c++20 -O2 -I${WORK}/prefix/include -I${EIGEN}
    ${SOURCE}/without_package/main.cpp ${library} -o ${WORK}/by_hand)
foreach(flags "" "-ffunction-sections;-fdata-sections;-Wl,--gc-sections")
  execute_process(COMMAND ${by_hand} ${flags} RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(code EQUAL 0 OR NOT output MATCHES "compile_with_the_settings_of_the_CMake_package<16, 16, 131072")
    message(FATAL_ERROR "without the settings of the package (${flags}): exit code ${code}\n${output}")
  endif()
endforeach()
set(settings -DEIGEN_MAX_ALIGN_BYTES=32 -DEIGEN_MAX_STATIC_ALIGN_BYTES=32 -DEIGEN_STACK_ALLOCATION_LIMIT=1048576)
run(${by_hand} ${settings})
# The settings of the package and one more that the layout of matrices depends on.
foreach(other EIGEN_DEFAULT_DENSE_INDEX_TYPE=int EIGEN_DEFAULT_TO_ROW_MAJOR EIGEN_MALLOC_ALREADY_ALIGNED=1)
  execute_process(COMMAND ${by_hand} ${settings} -D${other}
                  RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(code EQUAL 0 OR NOT output MATCHES "compile_with_the_settings_of_the_CMake_package<32, 32, 1048576")
    message(FATAL_ERROR "with ${other} beside the settings of the package: exit code ${code}\n${output}")
  endif()
endforeach()
