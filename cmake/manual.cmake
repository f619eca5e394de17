# Man pages and completion, made of what the programs say by --help, wherever Python is there and the programs run here.
if(CMAKE_CXX_FLAGS MATCHES "fsanitize" OR CMAKE_CROSSCOMPILING)
  return()
endif()
find_program(PINTLE_MANUAL_PYTHON python3)
if(NOT PINTLE_MANUAL_PYTHON)
  message(STATUS "No man pages and no completion: they ask for python3")
  return()
endif()
list(TRANSFORM pintle_programs REPLACE "(.+)" "$<TARGET_FILE:\\1>" OUTPUT_VARIABLE program_files)
add_custom_command(OUTPUT ${PROJECT_BINARY_DIR}/manual/made
  COMMAND ${PINTLE_MANUAL_PYTHON} ${PROJECT_SOURCE_DIR}/packaging/manual.py ${PROJECT_BINARY_DIR}/manual ${program_files}
  COMMAND ${CMAKE_COMMAND} -E touch ${PROJECT_BINARY_DIR}/manual/made
  DEPENDS ${pintle_programs} packaging/manual.py VERBATIM)
add_custom_target(pintle_manual ALL DEPENDS ${PROJECT_BINARY_DIR}/manual/made)
