# Installation, so that find_package(dymsum) gives a foreign project the target dymsum::dymsum.
include(CMakePackageConfigHelpers)

set(DYMSUM_CMAKE_DIR "${CMAKE_INSTALL_LIBDIR}/cmake/dymsum")

install(TARGETS dymsum EXPORT dymsumTargets
  ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}")
install(DIRECTORY "${PROJECT_SOURCE_DIR}/include/dymsum" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}"
  FILES_MATCHING PATTERN "*.h")
install(EXPORT dymsumTargets NAMESPACE dymsum:: DESTINATION "${DYMSUM_CMAKE_DIR}")
if(DYMSUM_BUILD_CLI)
  install(TARGETS dymsum_cli RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
endif()
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${CMAKE_INSTALL_DOCDIR}")

configure_package_config_file("${CMAKE_CURRENT_LIST_DIR}/dymsumConfig.cmake.in"
  "${PROJECT_BINARY_DIR}/dymsumConfig.cmake" INSTALL_DESTINATION "${DYMSUM_CMAKE_DIR}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/dymsumConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/dymsumConfig.cmake" "${PROJECT_BINARY_DIR}/dymsumConfigVersion.cmake"
  DESTINATION "${DYMSUM_CMAKE_DIR}")
