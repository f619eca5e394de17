# pintle_module(NAME SOURCES … LINKS …) builds libpintle_NAME.so, which the library loads when it is first called for
# (meshes/module.h). It holds its own copy of what it needs of the library. Whoever links the library gets a RUNPATH
# that leads to it: to the build tree, or to lib/pintle beside an installed library, wherever that is moved.
include(GNUInstallDirs)
set(pintle_modules ${PROJECT_BINARY_DIR}/modules)
target_link_options(pintle INTERFACE
  $<INSTALL_INTERFACE:LINKER:-rpath,$<INSTALL_PREFIX>/${CMAKE_INSTALL_LIBDIR}/pintle>)
if(PROJECT_IS_TOP_LEVEL)
  set(CMAKE_BUILD_RPATH ${pintle_modules})  # of programs; taken out of those that are installed
else()
  target_link_options(pintle INTERFACE $<BUILD_INTERFACE:LINKER:-rpath,${pintle_modules}>)
endif()
set_target_properties(pintle PROPERTIES BUILD_RPATH ${pintle_modules} INSTALL_RPATH $ORIGIN/pintle)  # if shared

function(pintle_module name)
  cmake_parse_arguments(PARSE_ARGV 1 module "" "" "SOURCES;LINKS")
  set(target pintle_${name})
  add_library(${target} MODULE ${module_SOURCES})
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR})
  target_compile_definitions(${target} PRIVATE PINTLE_VERSION="${PROJECT_VERSION}")
  target_link_libraries(${target} PRIVATE pintle_flags pintle_eigen ${module_LINKS})
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF LIBRARY_OUTPUT_DIRECTORY ${pintle_modules}
    CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  add_dependencies(pintle ${target})
  install(TARGETS ${target} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/pintle COMPONENT program)
endfunction()

# pintle_helper(NAME SOURCES … LINKS …) builds the program pintle-NAME, which the library starts. It stands beside the modules.
function(pintle_helper name)
  cmake_parse_arguments(PARSE_ARGV 1 helper "" "" "SOURCES;LINKS")
  set(target pintle_${name})
  add_executable(${target} ${helper_SOURCES})
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR})
  target_compile_definitions(${target} PRIVATE PINTLE_VERSION="${PROJECT_VERSION}")
  target_link_libraries(${target} PRIVATE pintle_flags pintle_eigen ${helper_LINKS})
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF OUTPUT_NAME pintle-${name} RUNTIME_OUTPUT_DIRECTORY ${pintle_modules})
  pintle_batches(${target} SIZE 8 ALONE "gmsh_|confine|_main")  # system and Gmsh headers are for these alone
  add_dependencies(pintle ${target})
  install(TARGETS ${target} RUNTIME DESTINATION ${CMAKE_INSTALL_LIBDIR}/pintle COMPONENT program)
endfunction()
