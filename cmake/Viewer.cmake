# The page that shows runs (viewer/) is built by Node into one HTML template, which the library holds. Without Node it is the
# one that a release archive brings, viewer/page.html (`make archive`); where there is neither, or its packages cannot be
# fetched, the program says that it writes no pages.
option(FLOATFRAME_VIEWER "Build the page that shows runs, if there is Node 18 or later with npm" ON)

set(viewer_source ${PROJECT_SOURCE_DIR}/viewer)
set(FLOATFRAME_VIEWER_TEMPLATE ${PROJECT_BINARY_DIR}/viewer/template.html)
set(viewer_found OFF)
if(FLOATFRAME_VIEWER AND EXISTS ${viewer_source}/package-lock.json)
  find_program(FLOATFRAME_NODE node)
  find_program(FLOATFRAME_NPM npm)
  if(FLOATFRAME_NODE AND FLOATFRAME_NPM)
    execute_process(COMMAND ${FLOATFRAME_NODE} --version OUTPUT_VARIABLE version RESULT_VARIABLE failed
                    OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    string(REGEX REPLACE "^v" "" version "${version}")
    if(failed EQUAL 0 AND version VERSION_GREATER_EQUAL 18)
      set(viewer_found ON)
    endif()
  endif()
  if(NOT viewer_found)
    if(EXISTS ${viewer_source}/page.html)
      message(STATUS "Node 18 or later with npm was not found: the page is that of the release archive")
    else()
      message(STATUS "Node 18 or later with npm was not found: there will be no pages of runs")
    endif()
  endif()
endif()

if(viewer_found)
  file(GLOB_RECURSE viewer_files CONFIGURE_DEPENDS ${viewer_source}/src/*)
  list(APPEND viewer_files ${viewer_source}/package.json ${viewer_source}/package-lock.json
       ${viewer_source}/template.html ${viewer_source}/tsconfig.json ${viewer_source}/vite.config.ts)
  # An empty template is what a failure has left: tried again at the next configuration.
  if(EXISTS ${FLOATFRAME_VIEWER_TEMPLATE})
    file(SIZE ${FLOATFRAME_VIEWER_TEMPLATE} size)
    if(size EQUAL 0)
      file(REMOVE ${FLOATFRAME_VIEWER_TEMPLATE})
    endif()
  endif()
  add_custom_command(OUTPUT ${FLOATFRAME_VIEWER_TEMPLATE}
    COMMAND ${CMAKE_COMMAND} -DSOURCE=${viewer_source} -DFOLDER=${PROJECT_BINARY_DIR}/viewer
            -DNPM=${FLOATFRAME_NPM} -P ${PROJECT_SOURCE_DIR}/cmake/BuildViewer.cmake
    DEPENDS ${viewer_files} ${PROJECT_SOURCE_DIR}/cmake/BuildViewer.cmake
    COMMENT "Building the page that shows runs" VERBATIM)
elseif(FLOATFRAME_VIEWER AND EXISTS ${viewer_source}/page.html)
  set(FLOATFRAME_VIEWER_TEMPLATE ${viewer_source}/page.html)
else()
  file(WRITE ${PROJECT_BINARY_DIR}/viewer/none.html "")
  set(FLOATFRAME_VIEWER_TEMPLATE ${PROJECT_BINARY_DIR}/viewer/none.html)
endif()
