# Warnings are errors, for everything that is ours, by the compilers that all changes are checked
# with. Another one may warn of something else, or by mistake, and whoever has it wants to render.
add_library(facet_warnings INTERFACE)
target_compile_options(facet_warnings INTERFACE
  -Wall -Wextra -Wconversion -Wshadow -Wnon-virtual-dtor)
string(REGEX MATCH "^[0-9]+" compiler "${CMAKE_CXX_COMPILER_VERSION}")
if("${CMAKE_CXX_COMPILER_ID} ${compiler}" MATCHES "^(GNU 12|Clang 14)$")
  target_compile_options(facet_warnings INTERFACE -Werror)
endif()
# GCC warns about the standard library's own code at -O2 (GCC bug 105651 and its like).
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(facet_warnings INTERFACE
    -Wno-restrict -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread
    -Wno-maybe-uninitialized)
endif()
