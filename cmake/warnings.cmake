# Warnings are errors, for everything that is ours.
add_library(facet_warnings INTERFACE)
target_compile_options(facet_warnings INTERFACE
  -Wall -Wextra -Wconversion -Wshadow -Wnon-virtual-dtor -Werror)
# GCC 12 warns about the standard library's own code at -O2 (GCC bug 105651 and its like).
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(facet_warnings INTERFACE
    -Wno-restrict -Wno-array-bounds -Wno-stringop-overflow -Wno-maybe-uninitialized)
endif()
