# cmake -DHOW=installed|subdirectory|configured -DSOURCE=... -DBINARY=... -DWORK=... -P check.cmake
# Builds the examples in a project of their own, against an installed facet or against its sources,
# and runs one. "configured" only configures against the sources.
file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})

function(run)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${WORK} RESULT_VARIABLE code OUTPUT_VARIABLE out
    ERROR_VARIABLE out)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "${ARGN}:\n${out}")
  endif()
endfunction()

if(HOW STREQUAL "installed")
  run(${CMAKE_COMMAND} --install ${BINARY} --prefix ${WORK}/prefix)
  file(GLOB_RECURSE headers RELATIVE ${WORK}/prefix/include ${WORK}/prefix/include/*)
  list(FILTER headers EXCLUDE REGEX "^facet/[a-z]+\\.h$")
  if(headers)
    message(FATAL_ERROR "installed beside the public headers: ${headers}")
  endif()
  run(${CMAKE_COMMAND} -G Ninja -S ${SOURCE}/examples -B build -DCMAKE_BUILD_TYPE=Release
    -DCMAKE_PREFIX_PATH=${WORK}/prefix)
else()
  run(${CMAKE_COMMAND} -G Ninja -S ${SOURCE}/tests/package -B build -DCMAKE_BUILD_TYPE=Release
    -DFACET_SOURCE=${SOURCE})
endif()
if(HOW STREQUAL "configured")
  return()
endif()
run(${CMAKE_COMMAND} --build build)
file(GLOB_RECURSE program ${WORK}/build/scene_in_memory)
run(${program} pyramid.png)
if(NOT EXISTS ${WORK}/pyramid.png)
  message(FATAL_ERROR "the example wrote nothing")
endif()
file(REMOVE_RECURSE ${WORK})
