# Writes the tests of a GoogleTest program for CTest: one for each claim, that is a TEST, or a TEST_P or TYPED_TEST with all its values.
#   program, list: the file to write, each: ON for a test of every value, properties: of every test, long: names of those labelled so
cmake_policy(SET CMP0057 NEW)  # if(… IN_LIST …)
execute_process(COMMAND "${program}" --gtest_list_tests OUTPUT_VARIABLE listed COMMAND_ERROR_IS_FATAL ANY)
string(REGEX REPLACE " *# [^\n]*" "" listed "${listed}")  # values of parameters
string(REPLACE "\n" ";" listed "${listed}")
set(claims "")
foreach(line IN LISTS listed)
  if(line MATCHES "^[^ ].*\\.$")
    string(REGEX REPLACE "/[0-9]+\\.$" "/*." suite "${line}")  # of types
  elseif(line MATCHES "^  (.+)$")
    set(name "${CMAKE_MATCH_1}")
    if(NOT each)
      string(REGEX REPLACE "/.*" "/*" name "${name}")  # of values
    endif()
    list(APPEND claims "${suite}${name}")
  endif()
endforeach()
list(REMOVE_DUPLICATES claims)
# What only skips has skipped; what fails beside it has failed.
set(skipped [==[\[  PASSED  \] 0 tests\.
(\[  SKIPPED \][^
]*
)+$]==])
string(REPLACE ";" " " properties "${properties}")
set(tests "")
foreach(claim IN LISTS claims)
  string(REPLACE "/*" "" name "${claim}")
  set(of_this "${properties}")
  if(name IN_LIST long)
    string(APPEND of_this " LABELS long")
  endif()
  string(APPEND tests "add_test([==[${name}]==] [==[${program}]==] [==[--gtest_filter=${claim}]==])\n"
    "set_tests_properties([==[${name}]==] PROPERTIES SKIP_REGULAR_EXPRESSION [==[${skipped}]==] ${of_this})\n")
endforeach()
file(WRITE "${list}" "${tests}")
