# The Python package around the wrapped module: its functions, and the metadata that tell PyVista of its accessor.

set(package_folder "${DMG_PYTHON_DESTINATION}/directionalmultigrid")
set(metadata_folder "${DMG_PYTHON_DESTINATION}/directionalmultigrid-${PROJECT_VERSION}.dist-info")
set(package_sources "${PROJECT_SOURCE_DIR}/Filters/Python")

foreach (file IN ITEMS __init__.py distances.py drawing.py export.py fields.py flows.py geodesics.py meshes.py py.typed pyvista_accessor.py scales.py)
  configure_file("${package_sources}/${file}" "${PROJECT_BINARY_DIR}/${package_folder}/${file}" COPYONLY)
  install(FILES "${package_sources}/${file}" DESTINATION "${package_folder}" COMPONENT python)
endforeach ()

file(GLOB old_metadata "${PROJECT_BINARY_DIR}/${DMG_PYTHON_DESTINATION}/directionalmultigrid-*.dist-info")
if (old_metadata)
  file(REMOVE_RECURSE ${old_metadata})
endif ()
configure_file("${package_sources}/METADATA.in" "${PROJECT_BINARY_DIR}/${metadata_folder}/METADATA" @ONLY)
configure_file("${package_sources}/entry_points.txt" "${PROJECT_BINARY_DIR}/${metadata_folder}/entry_points.txt" COPYONLY)
install(DIRECTORY "${PROJECT_BINARY_DIR}/${metadata_folder}" DESTINATION "${DMG_PYTHON_DESTINATION}" COMPONENT metadata)

# Stubs tell editors and type checkers what the filters have, where VTK has its generator along.
execute_process(
  COMMAND "${Python3_EXECUTABLE}" -c "import vtkmodules.generate_pyi"
  RESULT_VARIABLE generator_is_missing OUTPUT_QUIET ERROR_QUIET)
if (NOT generator_is_missing)
  set(stubs "${PROJECT_BINARY_DIR}/${package_folder}/vtkFiltersDirectionalFields.pyi")
  add_custom_command(
    OUTPUT "${stubs}"
    COMMAND "${Python3_EXECUTABLE}" -B -m vtkmodules.generate_pyi -p directionalmultigrid
      -o "${PROJECT_BINARY_DIR}/${package_folder}" vtkFiltersDirectionalFields
    WORKING_DIRECTORY "${PROJECT_BINARY_DIR}/${DMG_PYTHON_DESTINATION}"
    DEPENDS vtkFiltersDirectionalFieldsPython
    COMMENT "Writing the stubs of the filters")
  add_custom_target(PythonStubs ALL DEPENDS "${stubs}")
  install(FILES "${stubs}" DESTINATION "${package_folder}" COMPONENT python)
endif ()
