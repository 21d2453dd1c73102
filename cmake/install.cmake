# cmake --install: the program, the library with its header, a CMake package, and the scenes.
include(CMakePackageConfigHelpers)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/facet)
install(TARGETS facet facet_library EXPORT facet-targets)
install(EXPORT facet-targets NAMESPACE facet:: DESTINATION ${package_folder})
install(DIRECTORY include/facet DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(DIRECTORY scenes/ DESTINATION ${CMAKE_INSTALL_DATADIR}/facet/scenes
  PATTERN "generate" EXCLUDE PATTERN ".gitignore" EXCLUDE)
install(FILES farm/slurm/submit.sh farm/slurm/part.sbatch farm/slurm/merge.sbatch
  DESTINATION ${CMAKE_INSTALL_DATADIR}/facet/farm/slurm)
configure_package_config_file(cmake/facet-config.cmake.in ${PROJECT_BINARY_DIR}/facet-config.cmake
  INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/facet-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/facet-config.cmake ${PROJECT_BINARY_DIR}/facet-config-version.cmake
  DESTINATION ${package_folder})
