# find_package(pintle) in another project gives pintle::pintle; headers keep the names they have
# here, "contact/normal_law.h", under include/pintle. Components are what `./dev package` makes packages of.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(pintle_config ${CMAKE_INSTALL_LIBDIR}/cmake/pintle)
set(pintle_share ${CMAKE_INSTALL_DATAROOTDIR}/pintle)

install(TARGETS pintle pintle_eigen pintle_plots pintle_report EXPORT pintleTargets COMPONENT development)
install(DIRECTORY contact elements files framework meshes DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/pintle
  COMPONENT development FILES_MATCHING PATTERN "*.h")
install(FILES eigen_layout.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/pintle COMPONENT development)
install(EXPORT pintleTargets NAMESPACE pintle:: DESTINATION ${pintle_config} COMPONENT development)

configure_package_config_file(cmake/pintleConfig.cmake.in pintleConfig.cmake
  INSTALL_DESTINATION ${pintle_config})
write_basic_package_version_file(pintleConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES
  ${CMAKE_CURRENT_BINARY_DIR}/pintleConfig.cmake
  ${CMAKE_CURRENT_BINARY_DIR}/pintleConfigVersion.cmake
  cmake/FindLZ4.cmake
  cmake/FindSuiteSparse.cmake
  cmake/FindYAML.cmake
  DESTINATION ${pintle_config} COMPONENT development)

if(NOT PROJECT_IS_TOP_LEVEL)
  return()
endif()
set_target_properties(${pintle_programs} PROPERTIES INSTALL_RPATH $ORIGIN/../${CMAKE_INSTALL_LIBDIR}/pintle)  # the modules
install(TARGETS ${pintle_programs} COMPONENT program)
install(DIRECTORY examples DESTINATION ${pintle_share} COMPONENT program PATTERN __pycache__ EXCLUDE)
install(FILES docs/scene.schema.json docs/study.schema.json DESTINATION ${pintle_share}/docs COMPONENT program)  # where examples seek them
install(FILES README.md SECURITY.md CHANGELOG.md CITATION.cff LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)

# Man pages and completion are made of what the program says of itself (packaging/manual.py).
install(FILES packaging/open-scene DESTINATION ${pintle_share} COMPONENT program)
install(FILES packaging/pintle.desktop DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/applications COMPONENT program)
install(FILES packaging/pintle.xml DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/mime/packages COMPONENT program)
set(manual ${PROJECT_BINARY_DIR}/manual)
foreach(made IN ITEMS "man:man/man1" "bash:bash-completion/completions" "zsh:zsh/vendor-completions" "fish:fish/vendor_completions.d")
  string(REPLACE ":" ";" made ${made})
  list(POP_FRONT made from to)
  install(DIRECTORY ${manual}/${from}/ DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/${to} COMPONENT program OPTIONAL)
endforeach()
