# Builds the viewer in a folder of the build; what goes wrong is a note, and the template is then that of the release archive
# (viewer/page.html) or empty.
#   cmake -DSOURCE=viewer -DFOLDER=build/viewer -DNPM=npm -P BuildViewer.cmake
file(MAKE_DIRECTORY ${FOLDER})
file(GLOB files ${SOURCE}/*.json ${SOURCE}/*.ts ${SOURCE}/*.html ${SOURCE}/.npmrc)
file(COPY ${files} ${SOURCE}/src DESTINATION ${FOLDER}/work)
foreach(command "ci;--no-audit;--no-fund;--fetch-retries=1;--fetch-timeout=60000" "run;build")
  execute_process(COMMAND ${NPM} ${command} WORKING_DIRECTORY ${FOLDER}/work RESULT_VARIABLE failed
                  OUTPUT_VARIABLE said ERROR_VARIABLE said)
  if(NOT failed EQUAL 0)
    string(STRIP "${said}" said)
    string(SUBSTRING "${said}" 0 1000 said)
    list(JOIN command " " words)
    if(EXISTS ${SOURCE}/page.html)
      file(COPY_FILE ${SOURCE}/page.html ${FOLDER}/template.html)
      message("note: `npm ${words}` failed, so the page is that of the release archive.\n${said}")
    else()
      message("note: `npm ${words}` failed, so there will be no pages of runs; `make build` tries again.\n${said}")
      file(WRITE ${FOLDER}/template.html "")
    endif()
    return()
  endif()
endforeach()
file(COPY_FILE ${FOLDER}/work/dist/template.html ${FOLDER}/template.html)
