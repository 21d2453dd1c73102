# cmake --install: the program with scenes, manual and completion, and the library with its header
# and a CMake package. cpack makes two Debian packages of them.
include(CMakePackageConfigHelpers)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/facet)

# The program.
install(TARGETS facet EXPORT facet-targets COMPONENT program)
install(DIRECTORY scenes/ DESTINATION ${CMAKE_INSTALL_DATADIR}/facet/scenes COMPONENT program
  PATTERN "generate" EXCLUDE PATTERN ".*" EXCLUDE)
install(PROGRAMS farm/slurm/submit.sh farm/slurm/part.sbatch farm/slurm/merge.sbatch
  DESTINATION ${CMAKE_INSTALL_DATADIR}/facet/farm/slurm COMPONENT program)

# What the program says of itself.
set(manual ${PROJECT_BINARY_DIR}/manual)
find_program(FACET_GZIP gzip REQUIRED)
add_custom_command(OUTPUT ${manual}/facet.1.gz ${manual}/facet
  COMMAND ${CMAKE_COMMAND} -E make_directory ${manual}
  COMMAND facet manual --form man > ${manual}/facet.1
  COMMAND ${FACET_GZIP} -9nf ${manual}/facet.1
  COMMAND facet manual --form bash > ${manual}/facet
  DEPENDS facet COMMENT "Printing the manual" VERBATIM)
add_custom_target(facet_manual ALL DEPENDS ${manual}/facet.1.gz ${manual}/facet)
install(FILES ${manual}/facet.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
install(FILES ${manual}/facet DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
  COMPONENT program)

# The library.
install(TARGETS facet_library EXPORT facet-targets COMPONENT development)
install(EXPORT facet-targets NAMESPACE facet:: DESTINATION ${package_folder} COMPONENT development)
install(DIRECTORY include/facet DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development)
configure_package_config_file(cmake/facet-config.cmake.in ${PROJECT_BINARY_DIR}/facet-config.cmake
  INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/facet-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/facet-config.cmake ${PROJECT_BINARY_DIR}/facet-config-version.cmake
  DESTINATION ${package_folder} COMPONENT development)

# Who embeds facet makes no packages of it.
if(PROJECT_IS_TOP_LEVEL)
  include(cmake/packages.cmake)
endif()
