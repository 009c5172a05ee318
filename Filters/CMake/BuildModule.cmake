# The VTK module, its Python wrapping and the CMake package DirectionalMultigrid.
# Included by the top level, since vtk_module_build() enters ../CMakeLists.txt by itself.

vtk_module_scan(
  MODULE_FILES "${PROJECT_SOURCE_DIR}/Filters/vtk.module"
  PROVIDES_MODULES modules
  WANT_BY_DEFAULT ON
  ENABLE_TESTS OFF) # the tests stand in Testing, not below the module

set(package_destination "${CMAKE_INSTALL_LIBDIR}/cmake/DirectionalMultigrid")
vtk_module_build(
  MODULES ${modules}
  PACKAGE DirectionalMultigrid
  VERSION "${PROJECT_VERSION}"
  SOVERSION "${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}" # "0" alone is false to CMake
  INSTALL_EXPORT DirectionalMultigrid
  CMAKE_DESTINATION "${package_destination}"
  HEADERS_DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/DirectionalMultigrid"
  TEST_DIRECTORY_NAME "NONE")

include(CMakePackageConfigHelpers)
if (DMG_HOST STREQUAL "ParaView")
  set(host_dependency
    "ParaView ${ParaView_VERSION_MAJOR}.${ParaView_VERSION_MINOR} COMPONENTS RemotingCore")
else ()
  set(host_dependency
    "VTK ${VTK_VERSION} COMPONENTS CommonCore CommonDataModel CommonExecutionModel FiltersCore")
endif ()
configure_package_config_file(
  "${CMAKE_CURRENT_LIST_DIR}/DirectionalMultigridConfig.cmake.in"
  "${PROJECT_BINARY_DIR}/${package_destination}/DirectionalMultigridConfig.cmake"
  INSTALL_DESTINATION "${package_destination}")
write_basic_package_version_file(
  "${PROJECT_BINARY_DIR}/${package_destination}/DirectionalMultigridConfigVersion.cmake"
  COMPATIBILITY SameMinorVersion)
install(
  FILES
    "${CMAKE_CURRENT_LIST_DIR}/TaggedPythonModules.cmake"
    "${PROJECT_BINARY_DIR}/${package_destination}/DirectionalMultigridConfig.cmake"
    "${PROJECT_BINARY_DIR}/${package_destination}/DirectionalMultigridConfigVersion.cmake"
  DESTINATION "${package_destination}"
  COMPONENT development)

if (DMG_WRAP_PYTHON)
  # Where the Python of this system looks below an installation prefix.
  if (EXISTS "/etc/debian_version")
    set(default_python_destination "lib/python3/dist-packages")
  else ()
    vtk_module_python_default_destination(default_python_destination)
  endif ()
  set(DMG_PYTHON_DESTINATION "${default_python_destination}" CACHE STRING
    "Where the package directionalmultigrid goes, below the installation prefix")
  vtk_module_wrap_python(
    MODULES ${modules}
    PYTHON_PACKAGE "directionalmultigrid"
    MODULE_DESTINATION "${DMG_PYTHON_DESTINATION}"
    CMAKE_DESTINATION "${package_destination}"
    INSTALL_HEADERS OFF)
  # It finds the module's library below any prefix.
  file(RELATIVE_PATH to_libraries
    "/${DMG_PYTHON_DESTINATION}/directionalmultigrid" "/${CMAKE_INSTALL_LIBDIR}")
  set_target_properties(vtkFiltersDirectionalFieldsPython PROPERTIES
    INSTALL_RPATH "$ORIGIN/${to_libraries}")
  include("${CMAKE_CURRENT_LIST_DIR}/BuildPythonPackage.cmake")
endif ()
