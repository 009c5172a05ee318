# Read by cpack: what is built for another prefix works below that one only.
if (CPACK_GENERATOR STREQUAL "DEB" AND NOT CPACK_INSTALL_PREFIX STREQUAL "/usr")
  message(FATAL_ERROR "The build is for ${CPACK_INSTALL_PREFIX}, but Debian packages are installed below /usr: "
    "configure with -DCMAKE_INSTALL_PREFIX=/usr, and build again")
endif ()
