# FACET_SANITIZE: comma-separated, as for -fsanitize (address,undefined).
set(FACET_SANITIZE "" CACHE STRING "Sanitizers to build with, as for -fsanitize")
if(FACET_SANITIZE)
  add_compile_options(-fsanitize=${FACET_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${FACET_SANITIZE})
endif()
# Fuzz targets instead of tests; needs clang.
option(FACET_FUZZ "Build the fuzz targets, and nothing else of the tests" OFF)
if(FACET_FUZZ)
  add_compile_options(-fsanitize=fuzzer-no-link)
endif()
