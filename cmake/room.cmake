# One target a room; a room links what it may use and nothing else (README, "Rooms").
# facet_room(NAME SOURCES ... USES rooms... LIBRARIES ... PRIVATE_LIBRARIES ...)
function(facet_room name)
  cmake_parse_arguments(ROOM "" "" "SOURCES;USES;LIBRARIES;PRIVATE_LIBRARIES" ${ARGN})
  add_library(facet_${name} OBJECT ${ROOM_SOURCES})
  target_include_directories(facet_${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/host>
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> PRIVATE ${PROJECT_BINARY_DIR}/generated)
  target_link_libraries(facet_${name} PUBLIC ${ROOM_LIBRARIES}
    PRIVATE facet_warnings ${ROOM_PRIVATE_LIBRARIES})
  facet_unite(facet_${name})
  foreach(used IN LISTS ROOM_USES)
    target_link_libraries(facet_${name} PUBLIC facet_${used})
  endforeach()
endfunction()

# Compiles the target's files sixteen at a time: a third of the processor's time, most of which goes into
# headers. FACET_UNITY=OFF, as in the presets for development, compiles them one by one.
option(FACET_UNITY "Compile many files at a time" ON)
function(facet_unite target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${FACET_UNITY} UNITY_BUILD_BATCH_SIZE 16)
endfunction()
