# swirl_test(NAME LABELS LABEL... COMMAND WORD... [ENVIRONMENT NAME=VALUE...])
#
# A test with the label `slow` or `soak` is outside the default suite. Each process of a test may use the processor
# for some time (limited.sh). The limit by the clock ends tests that wait for ever, on a busy machine, too.
set(limited sh ${CMAKE_CURRENT_LIST_DIR}/limited.sh)
set(processor_seconds 600)
set(processor_seconds_slow 3600)
set(processor_seconds_soak 10800)
set(hang 3600)
set(hang_slow 14400)
set(hang_soak 43200)

function(swirl_test name)
  cmake_parse_arguments(PARSE_ARGV 1 test "" "" "LABELS;COMMAND;ENVIRONMENT")
  set(suite "")
  foreach(label slow soak)
    if(label IN_LIST test_LABELS)
      set(suite _${label})
    endif()
  endforeach()
  list(APPEND test_ENVIRONMENT SWIRL_SOURCE=${PROJECT_SOURCE_DIR})
  add_test(NAME ${name} COMMAND ${limited} ${processor_seconds${suite}} ${test_COMMAND})
  set_tests_properties(${name} PROPERTIES TIMEOUT ${hang${suite}} LABELS "${test_LABELS}"
    ENVIRONMENT "${test_ENVIRONMENT}")
endfunction()
