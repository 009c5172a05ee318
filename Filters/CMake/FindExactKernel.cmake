# CGAL's geometry with GMP's rational numbers, of which only headers and two libraries are needed.
# (The target CGAL::CGAL would put -frounding-math on everything that links to it; rational numbers
# do not round.)
# Defines ExactKernel_FOUND and the target ExactKernel::ExactKernel.
find_path(ExactKernel_INCLUDE_DIR CGAL/Gmpq.h)
find_library(ExactKernel_GMP_LIBRARY gmp)
find_library(ExactKernel_MPFR_LIBRARY mpfr)
mark_as_advanced(ExactKernel_INCLUDE_DIR ExactKernel_GMP_LIBRARY ExactKernel_MPFR_LIBRARY)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(ExactKernel
  REQUIRED_VARS ExactKernel_INCLUDE_DIR ExactKernel_GMP_LIBRARY ExactKernel_MPFR_LIBRARY
  REASON_FAILURE_MESSAGE "install CGAL with GMP and MPFR (Debian: libcgal-dev)")

if (ExactKernel_FOUND AND NOT TARGET ExactKernel::ExactKernel)
  add_library(ExactKernel::ExactKernel INTERFACE IMPORTED)
  set_target_properties(ExactKernel::ExactKernel PROPERTIES
    INTERFACE_INCLUDE_DIRECTORIES "${ExactKernel_INCLUDE_DIR}"
    INTERFACE_LINK_LIBRARIES "${ExactKernel_GMP_LIBRARY};${ExactKernel_MPFR_LIBRARY}")
endif ()
