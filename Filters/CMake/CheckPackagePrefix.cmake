# Refuses to pack what was built for another prefix, below which alone it works. Read by cpack.
if (CPACK_GENERATOR STREQUAL "DEB" AND NOT CPACK_INSTALL_PREFIX STREQUAL "/usr")
  message(FATAL_ERROR "The build is for ${CPACK_INSTALL_PREFIX}, but Debian packages are installed below /usr: "
    "configure with -DCMAKE_INSTALL_PREFIX=/usr, and build again")
endif ()
