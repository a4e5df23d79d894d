# Installation, so that find_package(dymsum) gives a foreign project the target dymsum::dymsum.
include(CMakePackageConfigHelpers)

set(DYMSUM_CMAKE_DIR "${CMAKE_INSTALL_LIBDIR}/cmake/dymsum")

install(TARGETS dymsum EXPORT dymsumTargets
  ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}")
install(DIRECTORY "${PROJECT_SOURCE_DIR}/include/dymsum" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}"
  FILES_MATCHING PATTERN "*.h")
install(FILES "${PROJECT_SOURCE_DIR}/cmake/FindLibzip.cmake" DESTINATION "${DYMSUM_CMAKE_DIR}")
install(EXPORT dymsumTargets NAMESPACE dymsum:: DESTINATION "${DYMSUM_CMAKE_DIR}")
if(DYMSUM_BUILD_CLI)
  install(TARGETS dymsum_cli RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
  # The viewer, where `./run web` has built it; the program finds it as ../share/dymsum/viewer.html.
  install(FILES "${PROJECT_SOURCE_DIR}/web/viewer/dist/index.html" DESTINATION "${CMAKE_INSTALL_DATADIR}/dymsum"
    RENAME viewer.html OPTIONAL)
endif()
if(DYMSUM_BUILD_OMPL)
  install(DIRECTORY "${PROJECT_SOURCE_DIR}/adapters/ompl/dymsum" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}"
    FILES_MATCHING PATTERN "*.h")
endif()
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${CMAKE_INSTALL_DOCDIR}")

# Programs that link the static library need what it uses as well.
get_target_property(DYMSUM_TYPE dymsum TYPE)
set(DYMSUM_PC_PACKAGES "pugixml tbb libzip zlib")
if(DYMSUM_GEOPACKAGE)
  string(APPEND DYMSUM_PC_PACKAGES " sqlite3")
endif()
if(DYMSUM_TYPE STREQUAL "STATIC_LIBRARY")
  set(DYMSUM_PC_REQUIRES "Requires: ${DYMSUM_PC_PACKAGES}")
else()
  set(DYMSUM_PC_REQUIRES "Requires.private: ${DYMSUM_PC_PACKAGES}")
endif()
# The prefix as seen from the file: an installation may be moved, and installed with another --prefix.
file(RELATIVE_PATH DYMSUM_PC_PREFIX "${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig" "${CMAKE_INSTALL_PREFIX}")
configure_file("${CMAKE_CURRENT_LIST_DIR}/dymsum.pc.in" "${PROJECT_BINARY_DIR}/dymsum.pc" @ONLY)
install(FILES "${PROJECT_BINARY_DIR}/dymsum.pc" DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig")

configure_package_config_file("${CMAKE_CURRENT_LIST_DIR}/dymsumConfig.cmake.in"
  "${PROJECT_BINARY_DIR}/dymsumConfig.cmake" INSTALL_DESTINATION "${DYMSUM_CMAKE_DIR}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/dymsumConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/dymsumConfig.cmake" "${PROJECT_BINARY_DIR}/dymsumConfigVersion.cmake"
  DESTINATION "${DYMSUM_CMAKE_DIR}")
