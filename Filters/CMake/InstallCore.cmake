# The CMake package DirectionalMultigrid with its component Core: the archive, its headers and what it links to. Where DMG_PETSC is
# on, it has the component Pieces, too.
# Included by the top level where the core is built alone; BuildModule.cmake makes the package of the VTK module.

# dmg_with_included_headers(<folder> <variable> <header>...): sets the variable to the headers, and to those of the folder that they
# include, and so on.
function (dmg_with_included_headers folder variable)
  set(known ${ARGN})
  set(unread ${ARGN})
  while (unread)
    list(POP_FRONT unread header)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${folder}/${header}")
    file(STRINGS "${folder}/${header}" lines REGEX "^#include \"[^\"]+\"")
    foreach (line IN LISTS lines)
      string(REGEX REPLACE "^#include \"([^\"]+)\".*" "\\1" included "${line}")
      if (EXISTS "${folder}/${included}" AND NOT included IN_LIST known)
        list(APPEND known "${included}")
        list(APPEND unread "${included}")
      endif ()
    endforeach ()
  endwhile ()
  set(${variable} ${known} PARENT_SCOPE)
endfunction ()

set(package_destination "${CMAKE_INSTALL_LIBDIR}/cmake/DirectionalMultigrid")
set(headers_destination "${CMAKE_INSTALL_INCLUDEDIR}/DirectionalMultigrid/Core")
target_include_directories(dmgCore INTERFACE "$<INSTALL_INTERFACE:${headers_destination}>")

install(TARGETS dmgCore EXPORT DirectionalMultigridCore
  ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT development)
# What a program includes: all that the filters compute, by a call of each.
set(entrances
  Directions/FieldTopology.h Directions/PrincipalDirections.h Drawing/ContourLines.h Drawing/EvenlySpacedLines.h Drawing/FieldGlyphs.h
  Drawing/GlyphPlaces.h FieldSolver.h Flows/FlowOperators.h Flows/HodgeDecomposition.h Geodesics/ParallelTransport.h
  Geodesics/SurfaceDistance.h
  Preparation/PolygonSurface.h Preparation/PreparedSurface.h Quads/QuadMesh.h Quads/SurfaceQuads.h Scales/FlowScales.h Scales/ScaleFilter.h
  Scales/Spectrum.h Singularities/PrescribedSingularities.h StructurePreserving/SurfaceHierarchy.h)
if (DMG_PETSC)
  list(APPEND entrances Pieces/FieldSolverInPieces.h)
  install(TARGETS dmgPieces EXPORT DirectionalMultigridPieces
    ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT development)
  install(EXPORT DirectionalMultigridPieces NAMESPACE DirectionalMultigrid::
    FILE DirectionalMultigridPieces-targets.cmake DESTINATION "${package_destination}" COMPONENT development)
  install(FILES "${CMAKE_CURRENT_LIST_DIR}/FindComplexPETSc.cmake"
    DESTINATION "${package_destination}" COMPONENT development)
endif ()
dmg_with_included_headers("${PROJECT_SOURCE_DIR}/Filters/Core" headers ${entrances})
foreach (header IN LISTS headers)
  get_filename_component(room "${header}" DIRECTORY)
  install(FILES "${PROJECT_SOURCE_DIR}/Filters/Core/${header}"
    DESTINATION "${headers_destination}/${room}" COMPONENT development)
endforeach ()
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
