# `make docs`: a Doxygen reference of the public headers, warnings as errors.
configure_file(${PROJECT_SOURCE_DIR}/docs/Doxyfile.in ${PROJECT_BINARY_DIR}/docs/Doxyfile @ONLY)
add_custom_target(docs
  COMMAND ${CMAKE_COMMAND} -DSOURCE=${PROJECT_SOURCE_DIR}/src -DGENERATED=${PROJECT_BINARY_DIR}/generated
          -DOUTPUT=${PROJECT_BINARY_DIR}/docs/include -DREFERENCE=ON -P ${CMAKE_CURRENT_LIST_DIR}/public_headers.cmake
  COMMAND doxygen ${PROJECT_BINARY_DIR}/docs/Doxyfile
  VERBATIM)
