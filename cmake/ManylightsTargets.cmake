# Compiler settings that all of the project's own targets share, and the helper that declares a test.

add_library(manylights_build_flags INTERFACE)
target_compile_features(manylights_build_flags INTERFACE cxx_std_20)
if(MSVC)
  target_compile_options(manylights_build_flags INTERFACE /W4 /fp:precise $<$<BOOL:${MANYLIGHTS_WERROR}>:/WX>)
else()
  # No contraction to fused multiply-adds: membership and cell edges must come out the same on every machine.
  target_compile_options(manylights_build_flags INTERFACE -Wall -Wextra -Wpedantic -Wshadow -ffp-contract=off
                                                          $<$<BOOL:${MANYLIGHTS_WERROR}>:-Werror>)
endif()

# manylights_add_test(name SOURCES ... LIBRARIES ... [TIMEOUT seconds] [LABELS ...]): a GoogleTest binary, one CTest entry.
function(manylights_add_test name)
  cmake_parse_arguments(TEST "" "TIMEOUT" "SOURCES;LIBRARIES;LABELS" ${ARGN})
  if(NOT TEST_TIMEOUT)
    set(TEST_TIMEOUT 120)
  endif()
  find_package(GTest REQUIRED)
  add_executable(${name} ${TEST_SOURCES})
  target_link_libraries(${name} PRIVATE manylights_build_flags ${TEST_LIBRARIES} GTest::gtest_main)
  target_compile_definitions(${name} PRIVATE MANYLIGHTS_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  if(NOT MSVC)
    # The libraries under test are optimised as users get them; the test bodies only have to compile quickly.
    target_compile_options(${name} PRIVATE $<$<CONFIG:Release>:-O1>)
  endif()
  add_test(NAME ${name} COMMAND ${name} --gtest_brief=1)
  set_tests_properties(${name} PROPERTIES TIMEOUT ${TEST_TIMEOUT} LABELS "${TEST_LABELS}")
endfunction()
