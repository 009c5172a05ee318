# PETSc with real numbers, which installs no CMake package.
# Defines PETSc_FOUND and the target PETSc::PETSc. Its headers need MPI.
find_path(PETSc_INCLUDE_DIR petscksp.h
  HINTS "$ENV{PETSC_DIR}/include" "/usr/lib/petscdir/petsc-real/include" PATH_SUFFIXES petsc)
find_library(PETSc_LIBRARY NAMES petsc_real petsc HINTS "$ENV{PETSC_DIR}/lib")
mark_as_advanced(PETSc_INCLUDE_DIR PETSc_LIBRARY)

# One for complex numbers has the same headers but for this definition.
set(PETSc_IS_REAL ON)
if (PETSc_INCLUDE_DIR AND EXISTS "${PETSc_INCLUDE_DIR}/petscconf.h")
  file(STRINGS "${PETSc_INCLUDE_DIR}/petscconf.h" complex REGEX "define PETSC_USE_COMPLEX 1")
  if (complex)
    set(PETSc_IS_REAL OFF)
  endif ()
endif ()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(PETSc REQUIRED_VARS PETSc_LIBRARY PETSc_INCLUDE_DIR PETSc_IS_REAL)

if (PETSc_FOUND AND NOT TARGET PETSc::PETSc)
  add_library(PETSc::PETSc UNKNOWN IMPORTED)
  set_target_properties(PETSc::PETSc PROPERTIES
    IMPORTED_LOCATION "${PETSc_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${PETSc_INCLUDE_DIR}")
endif ()
