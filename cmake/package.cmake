# Debian packages by CPack: `./dev package`. The program with what the library loads, the library with its headers, the Python module.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME pintle)
set(CPACK_PACKAGE_VENDOR "Pintle")
set(CPACK_PACKAGE_CONTACT "Pintle maintainers <maintainers@users.noreply.pintle.example>")
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL program development)
if(TARGET pintle_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(program "pintle (= ${PROJECT_VERSION})")

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME pintle)
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "planar flexible mechanisms with real joints
 From a scene file in YAML to joint forces, impacts, stresses, an energy ledger
 that closes, and a page that shows the mechanism moving. Clearances, contacts,
 friction, flexible links by finite elements, gears, belts, cams, events;
 statics, kinematics, inverse dynamics, linearisation, sweeps and fits.")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS "libcholmod3, libspqr2, libopenblas0 | liblapack3")  # loaded on demand
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "libpintle-dev, paraview, python3-pintle, xdg-utils")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libpintle-dev)
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "planar flexible mechanisms with real joints: C++ library
 The static library, its headers and its CMake package: find_package(pintle),
 then link pintle::pintle.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
  "${program}, libeigen3-dev, libsuitesparse-dev, liblz4-dev, libnlopt-dev, libyaml-dev")

if(TARGET pintle_python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-pintle)
  set(CPACK_COMPONENT_PYTHON_DESCRIPTION "planar flexible mechanisms with real joints: Python module
 Scenes from files or dictionaries, results as NumPy arrays and pandas frames,
 stepping by hand, forces as Python functions.")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
  math(EXPR next "${pintle_python_minor} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
    "${program}, python3 (>= 3.${pintle_python_minor}), python3 (<< 3.${next}), python3-numpy")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-pandas, python3-matplotlib")
endif()

include(CPack)
foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  cpack_add_component(${component})
endforeach()

foreach(package IN ITEMS "pintle:program" "libpintle-dev:development" "python3-pintle:python")
  string(REPLACE ":" ";" package ${package})
  list(POP_FRONT package name component)
  install(FILES packaging/copyright DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/${name} COMPONENT ${component})
endforeach()
