# The CMake package DirectionalMultigrid with its component Core: the archive, its headers and what it links to. Where DMG_PETSC is
# on, it has the component Pieces, too.
# Included by the top level where the core is built alone; BuildModule.cmake makes the package of the VTK module.
set(package_destination "${CMAKE_INSTALL_LIBDIR}/cmake/DirectionalMultigrid")
set(headers_destination "${CMAKE_INSTALL_INCLUDEDIR}/DirectionalMultigrid/Core")
target_include_directories(dmgCore INTERFACE "$<INSTALL_INTERFACE:${headers_destination}>")

install(TARGETS dmgCore EXPORT DirectionalMultigridCore
  ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT development)
set(without_pieces PATTERN "Pieces" EXCLUDE)
if (DMG_PETSC)
  set(without_pieces "")
  install(TARGETS dmgPieces EXPORT DirectionalMultigridPieces
    ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT development)
  install(EXPORT DirectionalMultigridPieces NAMESPACE DirectionalMultigrid::
    FILE DirectionalMultigridPieces-targets.cmake DESTINATION "${package_destination}" COMPONENT development)
  install(FILES "${CMAKE_CURRENT_LIST_DIR}/FindComplexPETSc.cmake"
    DESTINATION "${package_destination}" COMPONENT development)
endif ()
install(DIRECTORY "${PROJECT_SOURCE_DIR}/Filters/Core/" DESTINATION "${headers_destination}" COMPONENT development
  FILES_MATCHING PATTERN "*.h" ${without_pieces})
install(EXPORT DirectionalMultigridCore NAMESPACE DirectionalMultigrid:: FILE DirectionalMultigridCore-targets.cmake
  DESTINATION "${package_destination}" COMPONENT development)

include(CMakePackageConfigHelpers)
configure_package_config_file(
  "${CMAKE_CURRENT_LIST_DIR}/DirectionalMultigridCoreConfig.cmake.in"
  "${PROJECT_BINARY_DIR}/${package_destination}/DirectionalMultigridConfig.cmake"
  INSTALL_DESTINATION "${package_destination}")
write_basic_package_version_file(
  "${PROJECT_BINARY_DIR}/${package_destination}/DirectionalMultigridConfigVersion.cmake"
  COMPATIBILITY SameMinorVersion)
install(
  FILES
    "${CMAKE_CURRENT_LIST_DIR}/FindCHOLMOD.cmake"
    "${CMAKE_CURRENT_LIST_DIR}/FindExactKernel.cmake"
    "${PROJECT_BINARY_DIR}/${package_destination}/DirectionalMultigridConfig.cmake"
    "${PROJECT_BINARY_DIR}/${package_destination}/DirectionalMultigridConfigVersion.cmake"
  DESTINATION "${package_destination}"
  COMPONENT development)
