# cpack: facet_*.deb and libfacet-dev_*.deb. cmake/release.sh calls it with what makes them the same
# bytes whoever builds them.
# The project has no address of its own yet; the domain is one that RFC 2606 keeps for nobody.
set(maintainer "The facet authors <authors@facet.example.org>")
# A revision of 0: Debian itself has no such package.
set(debian_revision 0facet1)
set(debian_version ${PROJECT_VERSION}-${debian_revision})

# Debian's policy: each package brings its licence and its changes, dated by the last commit.
string(TIMESTAMP change_date "%a, %d %b %Y %H:%M:%S +0000" UTC)
file(READ ${PROJECT_SOURCE_DIR}/LICENSE licence)
string(REGEX REPLACE "\n\n" "\n.\n" licence "${licence}")
string(REGEX REPLACE "\n([^\n])" "\n \\1" licence "${licence}")
string(REGEX REPLACE "^MIT License\n ?\\.?\n?[^\n]*\n ?\\.?\n?" "" licence "${licence}")
foreach(package facet libfacet-dev)
  set(folder ${PROJECT_BINARY_DIR}/debian/${package})
  file(CONFIGURE OUTPUT ${folder}/changelog CONTENT
"facet (${debian_version}) unstable; urgency=medium

  * Version ${PROJECT_VERSION}; CHANGELOG.md of the sources tells what is new.

 -- ${maintainer}  ${change_date}
")
  execute_process(COMMAND ${FACET_GZIP} -9nc ${folder}/changelog
    OUTPUT_FILE ${folder}/changelog.Debian.gz)
  file(CONFIGURE OUTPUT ${folder}/copyright CONTENT
"Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: facet

Files: *
Copyright: 2026 The facet authors
License: Expat
${licence}")
  if(package STREQUAL "facet")
    set(component program)
  else()
    set(component development)
  endif()
  install(FILES ${folder}/changelog.Debian.gz ${folder}/copyright
    DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package} COMPONENT ${component})
endforeach()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME facet)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_CONTACT "${maintainer}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_COMPONENTS_ALL program development)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE ${debian_revision})
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME facet)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
# The Vulkan loader is opened while the program runs; any driver will do.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS "libvulkan1, mesa-vulkan-drivers | vulkan-icd")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY
  "path tracer in Vulkan compute shaders that proves its images right")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION
"facet renders scenes in Nori's language on any Vulkan device, Mesa's software
driver included, compares images, and checks kernels against a CPU reference,
sample by sample.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libfacet-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
# What facet-config.cmake asks for, and the program that the exported targets name.
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
  "facet (= ${debian_version}), libfmt-dev, libpugixml-dev, libopenexr-dev, libpng-dev, libjpeg-dev, zlib1g-dev, libtinyobjloader-dev")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION
"This is the library of the program facet, with one header and a CMake package:
scenes from files or memory, renders on Vulkan devices or by the CPU reference,
images and their comparison.")
include(CPack)
