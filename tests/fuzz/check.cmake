# Builds the fuzz targets in a folder of their own, and runs each for a minute;
# exits with the text SKIPPED where there is no clang:
# cmake -DSOURCE=... -DWORK=... -P check.cmake
find_program(clang clang++)
if(NOT clang)
  message("SKIPPED: no clang++, whose libFuzzer the targets need")
  return()
endif()
function(run)
  execute_process(COMMAND ${ARGV} WORKING_DIRECTORY ${SOURCE} RESULT_VARIABLE code)
  if(code)
    message(FATAL_ERROR "failed: ${ARGV}")
  endif()
endfunction()
run(${CMAKE_COMMAND} --preset fuzz -B ${WORK})
run(${CMAKE_COMMAND} --build ${WORK} --target fuzzers)
run(${CMAKE_CTEST_COMMAND} --test-dir ${WORK} --output-on-failure -L fuzz -j 2)
