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
  set(output "${output}" PARENT_SCOPE)
endfunction()

run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)

# Nothing but the public headers is installed, and they include nothing but each other, Eigen and the standard library.
file(GLOB_RECURSE headers RELATIVE ${WORK}/prefix/include/floatframe ${WORK}/prefix/include/floatframe/*)
list(SORT headers)
set(public analysis body errors floatframe fmu history model part realtime simulation sweep types version)
list(TRANSFORM public APPEND .hpp)
if(NOT headers STREQUAL public)
  message(FATAL_ERROR "found the headers ${headers}, expected ${public}")
endif()
foreach(header IN LISTS headers)
  file(STRINGS ${WORK}/prefix/include/floatframe/${header} foreign
       REGEX "^ *# *include (\"|<([^E>][^>]*/|[^>]*\\.h>|Eigen/src))")
  list(FILTER foreign EXCLUDE REGEX "<floatframe/[a-z]+\\.hpp>|<time\\.h>")
  if(foreign)
    message(FATAL_ERROR "${header}: ${foreign}")
  endif()
  file(READ ${WORK}/prefix/include/floatframe/${header} text)
  # Comments send nobody to a header that is not there.
  string(REGEX MATCHALL "[a-z_]+\\.hpp" named "${text}")
  list(REMOVE_ITEM named ${public})
  if(named)
    message(FATAL_ERROR "${header} names ${named}, expected none but ${public}")
  endif()
  # No macros but those of the version.
  string(REGEX MATCHALL "#define [A-Z_]+" macros "${text}")
  if(NOT header STREQUAL "version.hpp")
    foreach(macro IN LISTS macros)
      string(REPLACE "#define" "#undef" undefined "${macro}")
      if(NOT text MATCHES "${undefined}\n")
        message(FATAL_ERROR "${header}: found '${macro}', expected an #undef after its uses")
      endif()
    endforeach()
  endif()
endforeach()

file(COPY ${SOURCE}/consumer/ DESTINATION ${WORK}/consumer)
run(${CMAKE_COMMAND} -S ${WORK}/consumer -B ${WORK}/build -DCMAKE_PREFIX_PATH=${WORK}/prefix
    -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS=${FLAGS} -DDECKS=${DECKS})
run(${CMAKE_COMMAND} --build ${WORK}/build --parallel 2)
run(${WORK}/build/consumer)
run(${WORK}/build/tools ${WORK}/prefix/share/floatframe/examples/active_damper/active_damper.yaml ${WORK}/kept)
if(NOT output MATCHES "mass .* kg\ncaught: ")
  message(FATAL_ERROR "the program with tools: ${output}")
endif()

# The interface for C beside the public headers, and a project in C alone.
file(GLOB headers RELATIVE ${WORK}/prefix/include ${WORK}/prefix/include/*)
if(NOT headers STREQUAL "floatframe;floatframe.h")
  message(FATAL_ERROR "found ${headers} in the folder of headers, expected floatframe and floatframe.h")
endif()
file(COPY ${SOURCE}/c_consumer/ DESTINATION ${WORK}/c_consumer)
run(${CMAKE_COMMAND} -S ${WORK}/c_consumer -B ${WORK}/c_build -DCMAKE_PREFIX_PATH=${WORK}/prefix -DCMAKE_C_FLAGS=${FLAGS})
run(${CMAKE_COMMAND} --build ${WORK}/c_build)
run(${WORK}/c_build/c_consumer ${WORK}/prefix/share/floatframe/examples/flexible_pendulum/flexible_pendulum.yaml)
if(NOT output MATCHES "flexible_pendulum .*: 0\\.001 s")
  message(FATAL_ERROR "the program in C: ${output}")
endif()

# The examples, as somebody would build them, and what they print.
run(${CMAKE_COMMAND} -S ${WORK}/prefix/share/floatframe/examples/cpp -B ${WORK}/examples -DCMAKE_PREFIX_PATH=${WORK}/prefix
    -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_CXX_FLAGS=${FLAGS} "-DCMAKE_CXX_FLAGS_RELEASE=-O1 -Wall -Wextra -Wpedantic -Werror")
run(${CMAKE_COMMAND} --build ${WORK}/examples --parallel 2)
set(models ${WORK}/prefix/share/floatframe/examples)
function(example name arguments)
  execute_process(COMMAND ${WORK}/examples/${name} ${arguments} WORKING_DIRECTORY ${WORK}
                  RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE output)
  foreach(expected IN LISTS ARGN)
    if(NOT code EQUAL 0 OR NOT output MATCHES "${expected}")
      message(FATAL_ERROR "example ${name}: exit code ${code}, expected '${expected}' in\n${output}")
    endif()
  endforeach()
endfunction()
example(pendulum "" "period 1\\.6420[0-9] s, expected 1\\.64205 s"
        "small swings of joint .hinge.: 1\\.63795 s")
example(control ${models}/active_damper/active_damper.yaml
        "passive 1\\.05[0-9] m/s2, active 0\\.73[0-9] m/s2" "from the saved state: the same bits")
example(reduce_part ${models}/iltis_solid/front_arm.msh.gz "6725 nodes, 10 modes, mass 6\\.4920 kg" "normal 1 +753\\.[0-9] Hz"
        "preprocessing and projection: agree")
example(formulations ${models}/flexible_pendulum/flexible_pendulum.yaml "relative preprocessing tip\\.x -0\\.0905"
        "absolute projection +tip\\.x -0\\.0905")
example(sweep_threads ${models}/active_damper/active_damper.yaml "gain     0 N s/m: 1\\.12[0-9] m/s2"
        "gain  8000 N s/m: 0\\.48[0-9] m/s2" "four threads and one: the same bits")
# What only steps a model is linked with the library alone, and loads no other of the project.
run(ldd ${WORK}/examples/control)
if(NOT output MATCHES "libfloatframe\\.so" OR output MATCHES "libfloatframe_tools")
  message(FATAL_ERROR "examples/control: expected libfloatframe.so without libfloatframe_tools.so:\n${output}")
endif()
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
