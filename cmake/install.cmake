# find_package(pintle) in another project gives pintle::pintle; headers keep the names they have
# here, "contact/normal_law.h", under include/pintle.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(pintle_config ${CMAKE_INSTALL_LIBDIR}/cmake/pintle)

install(TARGETS pintle pintle_eigen pintle_plots pintle_report EXPORT pintleTargets)
install(DIRECTORY contact elements files framework meshes DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/pintle
  FILES_MATCHING PATTERN "*.h")
install(FILES eigen_layout.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/pintle)
install(EXPORT pintleTargets NAMESPACE pintle:: DESTINATION ${pintle_config})

configure_package_config_file(cmake/pintleConfig.cmake.in pintleConfig.cmake
  INSTALL_DESTINATION ${pintle_config})
write_basic_package_version_file(pintleConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES
  ${CMAKE_CURRENT_BINARY_DIR}/pintleConfig.cmake
  ${CMAKE_CURRENT_BINARY_DIR}/pintleConfigVersion.cmake
  cmake/FindSuiteSparse.cmake
  DESTINATION ${pintle_config})

if(PROJECT_IS_TOP_LEVEL)
  set_target_properties(pintle_app PROPERTIES INSTALL_RPATH $ORIGIN/../${CMAKE_INSTALL_LIBDIR}/pintle)  # the modules
  install(TARGETS pintle_app)
  foreach(beside IN ITEMS pintle_picture pintle_view)
    if(TARGET ${beside})
      set_target_properties(${beside} PROPERTIES INSTALL_RPATH $ORIGIN/../${CMAKE_INSTALL_LIBDIR}/pintle)
      install(TARGETS ${beside})
    endif()
  endforeach()
endif()
