# Installs the library, its headers and its shaders, and a package that find_package(manylights) finds.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(manylights_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/manylights)
install(TARGETS manylights EXPORT manylightsTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
  RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/manylights DESTINATION include)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/shaders/manylights DESTINATION share/manylights/shaders)
install(EXPORT manylightsTargets NAMESPACE manylights:: DESTINATION ${manylights_package_dir})

configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/manylightsConfig.cmake.in
  ${PROJECT_BINARY_DIR}/manylightsConfig.cmake
  INSTALL_DESTINATION ${manylights_package_dir}
  PATH_VARS CMAKE_INSTALL_PREFIX)
# Before 1.0 a minor version may change the interface.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/manylightsConfigVersion.cmake
  VERSION ${PROJECT_VERSION} COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/manylightsConfig.cmake ${PROJECT_BINARY_DIR}/manylightsConfigVersion.cmake
  DESTINATION ${manylights_package_dir})
