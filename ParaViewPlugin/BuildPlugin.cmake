# The ParaView plugin over the module. Included by the top level, since paraview_plugin_build()
# enters CMakeLists.txt of this folder by itself.

paraview_plugin_scan(
  PLUGIN_FILES "${CMAKE_CURRENT_LIST_DIR}/paraview.plugin"
  PROVIDES_PLUGINS plugins
  ENABLE_BY_DEFAULT ON
  HIDE_PLUGINS_FROM_CACHE ON)
paraview_plugin_build(
  PLUGINS ${plugins}
  AUTOLOAD ${plugins}
  LIBRARY_SUBDIRECTORY "${PARAVIEW_PLUGIN_SUBDIR}"
  PLUGINS_FILE_NAME "DirectionalMultigrid.plugins.xml")

# It finds the module's library below any prefix.
file(RELATIVE_PATH to_libraries "/${PARAVIEW_PLUGIN_SUBDIR}/DirectionalMultigrid" "/")
set_target_properties(DirectionalMultigrid PROPERTIES INSTALL_RPATH "$ORIGIN/${to_libraries}")

# Where /bin is a link to /usr/bin, CMake may find ParaView below /.
file(REAL_PATH "${ParaView_PREFIX_PATH}/bin" paraview_prefix)
get_filename_component(paraview_prefix "${paraview_prefix}" DIRECTORY)
get_filename_component(paraview_conf # names ParaView's plugins, where it brings the file
  "${paraview_prefix}/${CMAKE_INSTALL_LIBDIR}/${PARAVIEW_PLUGIN_SUBDIR}/../paraview.conf" ABSOLUTE)
configure_file("${CMAKE_CURRENT_LIST_DIR}/RegisterPlugin.cmake.in"
  "${PROJECT_BINARY_DIR}/RegisterPlugin.cmake" @ONLY)
install(SCRIPT "${PROJECT_BINARY_DIR}/RegisterPlugin.cmake" COMPONENT paraview_plugins)
