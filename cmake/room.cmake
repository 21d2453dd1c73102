# One target a room; a room links what it may use and nothing else (README, "Rooms").
# facet_room(NAME SOURCES ... USES rooms... LIBRARIES ... PRIVATE_LIBRARIES ...)
function(facet_room name)
  cmake_parse_arguments(ROOM "" "" "SOURCES;USES;LIBRARIES;PRIVATE_LIBRARIES" ${ARGN})
  add_library(facet_${name} OBJECT ${ROOM_SOURCES})
  target_include_directories(facet_${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/host>
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> PRIVATE ${PROJECT_BINARY_DIR}/generated)
  target_link_libraries(facet_${name} PUBLIC ${ROOM_LIBRARIES}
    PRIVATE facet_warnings ${ROOM_PRIVATE_LIBRARIES})
  foreach(used IN LISTS ROOM_USES)
    target_link_libraries(facet_${name} PUBLIC facet_${used})
  endforeach()
endfunction()
