# The packages of cpack: a Debian package of the installation, whose dependencies dpkg-shlibdeps finds, and a tarball of the sources.
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" # where Debian's policy wants it
  DESTINATION "${CMAKE_INSTALL_DATAROOTDIR}/doc/directionalmultigrid" RENAME "copyright" COMPONENT metadata)

# A maintainer with an address is compulsory. There is no public one yet; the domain is one that never exists (RFC 2606).
set(CPACK_PACKAGE_CONTACT "The DirectionalMultigrid authors <maintainers@directionalmultigrid.invalid>")
set(CPACK_PACKAGE_NAME "directionalmultigrid")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_RESOURCE_FILE_LICENSE "${PROJECT_SOURCE_DIR}/LICENSE")

set(CPACK_GENERATOR "DEB")
set(CPACK_PROJECT_CONFIG_FILE "${PROJECT_SOURCE_DIR}/Filters/CMake/CheckPackagePrefix.cmake")
set(CPACK_SET_DESTDIR ON) # the plugin is registered for /usr, not for the folder that is packed
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME "DEB-DEFAULT")
set(CPACK_DEBIAN_PACKAGE_SECTION "science")
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
if (DMG_WRAP_PYTHON AND DMG_HOST STREQUAL "ParaView")
  set(CPACK_DEBIAN_PACKAGE_DEPENDS "python3-paraview") # the modules that ours imports
elseif (DMG_WRAP_PYTHON AND DMG_HOST STREQUAL "VTK")
  set(CPACK_DEBIAN_PACKAGE_DEPENDS "python3-vtk9")
endif ()

# Where ParaView's package brings the file that names its plugins, ours adds a line to it, also when that package is installed
# anew, and takes it away at the end.
if (DMG_HOST STREQUAL "ParaView" AND EXISTS "${paraview_conf}")
  foreach (script IN ITEMS postinst prerm triggers)
    configure_file("${CMAKE_CURRENT_LIST_DIR}/Debian/${script}.in" "${PROJECT_BINARY_DIR}/debian/${script}" @ONLY)
    list(APPEND CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA "${PROJECT_BINARY_DIR}/debian/${script}")
  endforeach ()
  set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
endif ()

set(CPACK_SOURCE_GENERATOR "TGZ")
set(CPACK_SOURCE_PACKAGE_FILE_NAME "directionalmultigrid-${PROJECT_VERSION}")
set(CPACK_SOURCE_IGNORE_FILES "^${PROJECT_SOURCE_DIR}/build/" "/[.]git(/|$)" "__pycache__" "CMakeUserPresets.json"
  "^${PROJECT_SOURCE_DIR}/demo[.](png|pvsm|vtp)$" "[.]csv$")
include(CPack)
