# Language, warnings, optimisation and sanitizers, as one interface target: floatframe_compiler.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
# Executables find build/lib relative to themselves, so that a build folder can be moved.
set(CMAKE_BUILD_RPATH_USE_ORIGIN ON)

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM AND NOT DEFINED CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE_PROGRAM})
endif()

add_library(floatframe_compiler INTERFACE)
target_compile_options(floatframe_compiler INTERFACE
  -Wall -Wextra -Wpedantic
  # Compiled together, files see the unnamed namespaces of others.
  $<IF:$<BOOL:${FLOATFRAME_UNITY}>,-Wshadow=local,-Wshadow>
  $<$<BOOL:${FLOATFRAME_WERROR}>:-Werror>
  # errno and floating-point traps are never looked at; results stay IEEE (no -ffast-math).
  -fno-math-errno -fno-trapping-math
  $<$<CONFIG:Release>:$<IF:$<BOOL:$<TARGET_PROPERTY:FLOATFRAME_OPTIMISATION>>,$<TARGET_PROPERTY:FLOATFRAME_OPTIMISATION>,-O3>>)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND NOT CMAKE_BUILD_TYPE STREQUAL "Debug")
  # These see through inlined Eigen expressions of dynamic size and inlined strings and report what cannot happen.
  target_compile_options(floatframe_compiler INTERFACE
    -Wno-maybe-uninitialized -Wno-restrict -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread)
endif()
if(FLOATFRAME_SANITIZE)
  target_compile_options(floatframe_compiler INTERFACE
    -fsanitize=${FLOATFRAME_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(floatframe_compiler INTERFACE -fsanitize=${FLOATFRAME_SANITIZE})
endif()
