# Man pages and completion, made of what the programs say by --help, wherever Python is there and the programs run here.
if(CMAKE_CXX_FLAGS MATCHES "fsanitize" OR CMAKE_CROSSCOMPILING)
  return()
endif()
find_program(PINTLE_MANUAL_PYTHON python3)
if(NOT PINTLE_MANUAL_PYTHON)
  message(STATUS "No man pages and no completion: they ask for python3")
  return()
endif()
set(described pintle_app)
foreach(beside IN ITEMS pintle_picture pintle_view)
  if(TARGET ${beside})
    list(APPEND described ${beside})
  endif()
endforeach()
list(TRANSFORM described REPLACE "(.+)" "$<TARGET_FILE:\\1>" OUTPUT_VARIABLE described_files)
add_custom_command(OUTPUT ${PROJECT_BINARY_DIR}/manual/made
  COMMAND ${PINTLE_MANUAL_PYTHON} ${PROJECT_SOURCE_DIR}/packaging/manual.py ${PROJECT_BINARY_DIR}/manual ${described_files}
  COMMAND ${CMAKE_COMMAND} -E touch ${PROJECT_BINARY_DIR}/manual/made
  DEPENDS ${described} packaging/manual.py VERBATIM)
add_custom_target(pintle_manual ALL DEPENDS ${PROJECT_BINARY_DIR}/manual/made)
