# `cmake --install`: program, both copies of the library, the tools, public headers, examples and the package for find_package(Floatframe).
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/Floatframe)

install(TARGETS floatframe floatframe_tools EXPORT FloatframeTargets LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
if(TARGET floatframe_v3)
  install(TARGETS floatframe_v3
          LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/glibc-hwcaps/x86-64-v3 NAMELINK_SKIP)
endif()
if(TARGET floatframe_decks)
  install(TARGETS floatframe_decks EXPORT FloatframeDecksTargets LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(EXPORT FloatframeDecksTargets NAMESPACE Floatframe:: DESTINATION ${package_dir})
endif()
if(TARGET floatframe_mpi)
  install(TARGETS floatframe_mpi LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
endif()
if(TARGET floatframe_mumps)
  install(TARGETS floatframe_mumps LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
endif()
if(TARGET floatframe_program)
  file(RELATIVE_PATH library_from_program
       ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR})
  # One RPATH for the build tree and the installation: otherwise CMake pads the shorter one with empty entries, which
  # mean the current folder.
  set_target_properties(floatframe_program PROPERTIES
                        BUILD_WITH_INSTALL_RPATH ON
                        INSTALL_RPATH "$ORIGIN/lib:$ORIGIN/${library_from_program}")
  install(TARGETS floatframe_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()

# The public headers, each as one file.
install(CODE "execute_process(COMMAND \"${CMAKE_COMMAND}\" \"-DSOURCE=${PROJECT_SOURCE_DIR}/src\"
  \"-DGENERATED=${PROJECT_BINARY_DIR}/generated\" \"-DOUTPUT=${PROJECT_BINARY_DIR}/public_headers\"
  -P \"${CMAKE_CURRENT_LIST_DIR}/public_headers.cmake\" COMMAND_ERROR_IS_FATAL ANY)")
install(DIRECTORY ${PROJECT_BINARY_DIR}/public_headers/floatframe
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.hpp")
install(FILES ${PROJECT_SOURCE_DIR}/src/floatframe/c_interface/floatframe.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/examples DESTINATION ${CMAKE_INSTALL_DATADIR}/floatframe
        PATTERN "__pycache__" EXCLUDE PATTERN ".floatframe-cache" EXCLUDE)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR}
        FILES_MATCHING PATTERN "*.md" PATTERN "*.png" PATTERN "*.svg" PATTERN "*.webp")
install(DIRECTORY ${PROJECT_SOURCE_DIR}/python/notebooks DESTINATION ${CMAKE_INSTALL_DATADIR}/floatframe FILES_MATCHING PATTERN "*.py")
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/NOTICE
        DESTINATION ${CMAKE_INSTALL_DOCDIR})

install(EXPORT FloatframeTargets NAMESPACE Floatframe:: DESTINATION ${package_dir})
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/FloatframeConfig.cmake.in
  ${PROJECT_BINARY_DIR}/FloatframeConfig.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/FloatframeConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/FloatframeConfig.cmake
              ${PROJECT_BINARY_DIR}/FloatframeConfigVersion.cmake DESTINATION ${package_dir})
