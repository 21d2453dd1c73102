# How long compiling takes is what a newcomer waits for. Three means against it:
#
# - files are compiled sixteen at a time, and the standard library's headers are read once for all
#   (FACET_UNITY=OFF, as in the presets for development, does neither: what a file needs, it
#   includes);
# - code is optimised as it deserves: what a render spends its time in is `hot` (-O3), what runs
#   once a command is `cold` (-O1), all else is `warm` (-O2);
# - nothing is instantiated in many places that could be in one.
option(FACET_UNITY "Compile many files at a time, with precompiled headers" ON)
if(CMAKE_CXX_FLAGS_RELEASE STREQUAL "-O3 -DNDEBUG")
  set(CMAKE_CXX_FLAGS_RELEASE "-O2 -DNDEBUG")
endif()
set(facet_optimisation_hot $<$<CONFIG:Release>:-O3>)
set(facet_optimisation_warm "")
set(facet_optimisation_cold $<$<CONFIG:Release>:-O1>)

# Headers are precompiled for each way of compiling by a target that is nothing else.
if(FACET_UNITY)
  file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/generated/precompiled.cpp CONTENT "// Empty.\n")
  foreach(speed warm cold)
    add_library(facet_headers_${speed} OBJECT ${PROJECT_BINARY_DIR}/generated/precompiled.cpp)
    target_link_libraries(facet_headers_${speed} PRIVATE facet_warnings fmt::fmt glm::glm)
    target_compile_options(facet_headers_${speed} PRIVATE ${facet_optimisation_${speed}})
    target_precompile_headers(facet_headers_${speed} PRIVATE
      <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <map> <memory> <optional>
      <string> <string_view> <variant> <vector> <fmt/format.h> <glm/glm.hpp>)
  endforeach()
endif()

# facet_compile(TARGET hot|warm|cold)
function(facet_compile target speed)
  target_compile_options(${target} PRIVATE ${facet_optimisation_${speed}})
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${FACET_UNITY} UNITY_BUILD_BATCH_SIZE 16)
  # Precompiled headers serve whoever has the very same options: executables are compiled otherwise
  # where position-independent code is asked for.
  get_target_property(type ${target} TYPE)
  if(CMAKE_POSITION_INDEPENDENT_CODE AND type STREQUAL "EXECUTABLE")
    return()
  endif()
  if(FACET_UNITY AND NOT speed STREQUAL "hot")
    target_precompile_headers(${target} REUSE_FROM facet_headers_${speed})
    target_link_libraries(${target} PRIVATE fmt::fmt glm::glm)
  endif()
endfunction()
