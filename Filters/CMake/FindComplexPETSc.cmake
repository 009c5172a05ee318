# PETSc with complex numbers, which installs no CMake package.
# Defines ComplexPETSc_FOUND and the target ComplexPETSc::ComplexPETSc. Its headers need MPI.
find_path(ComplexPETSc_INCLUDE_DIR petscksp.h
  HINTS "$ENV{PETSC_DIR}/$ENV{PETSC_ARCH}/include" "/usr/lib/petscdir/petsc-complex/include" NO_DEFAULT_PATH)
find_library(ComplexPETSc_LIBRARY NAMES petsc_complex petsc
  HINTS "${ComplexPETSc_INCLUDE_DIR}/../lib" NO_DEFAULT_PATH)
mark_as_advanced(ComplexPETSc_INCLUDE_DIR ComplexPETSc_LIBRARY)

# One for real numbers has the same headers but for this definition.
if (ComplexPETSc_INCLUDE_DIR AND EXISTS "${ComplexPETSc_INCLUDE_DIR}/petscconf.h")
  file(STRINGS "${ComplexPETSc_INCLUDE_DIR}/petscconf.h" ComplexPETSc_IS_COMPLEX REGEX "define PETSC_USE_COMPLEX 1")
endif ()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(ComplexPETSc REQUIRED_VARS
  ComplexPETSc_LIBRARY ComplexPETSc_INCLUDE_DIR ComplexPETSc_IS_COMPLEX)

if (ComplexPETSc_FOUND AND NOT TARGET ComplexPETSc::ComplexPETSc)
  add_library(ComplexPETSc::ComplexPETSc UNKNOWN IMPORTED)
  set_target_properties(ComplexPETSc::ComplexPETSc PROPERTIES
    IMPORTED_LOCATION "${ComplexPETSc_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${ComplexPETSc_INCLUDE_DIR}")
endif ()
