# short_fuzz(NAME RUNS NUMBER SOURCES ... SEEDS ...): tests/fuzz/NAME.cpp, given texts that libFuzzer makes of the seeds:
# the same number of them, from the same seed, each time. Only these sources are built with clang and its sanitizers;
# tests/fuzz/run searches for longer.
find_program(FUZZ_CLANG clang++-19)
if(NOT FUZZ_CLANG)
  message(STATUS "clang++-19 is not installed: short fuzzing is left out; deploy/install-dependencies installs it")
endif()

function(short_fuzz target)
  if(NOT FUZZ_CLANG)
    return()
  endif()
  cmake_parse_arguments(ARG "" "RUNS" "SOURCES;SEEDS" ${ARGN})
  set(sanitize -fsanitize=address,undefined -fno-sanitize-recover=all)
  set(objects)
  foreach(source ${ARG_SOURCES} ${PROJECT_SOURCE_DIR}/tests/fuzz/${target}.cpp)
    file(RELATIVE_PATH name ${PROJECT_SOURCE_DIR} ${source})
    string(REPLACE "/" "_" name ${name})
    set(object ${CMAKE_CURRENT_BINARY_DIR}/${name}.o)
    add_custom_command(OUTPUT ${object} DEPENDS ${source} DEPFILE ${object}.d
      COMMAND ${CMAKE_CXX_COMPILER_LAUNCHER} ${FUZZ_CLANG} -std=c++23 -O1 -g1 -I${PROJECT_SOURCE_DIR} ${sanitize}
              -fsanitize=fuzzer-no-link -MD -MF ${object}.d -c ${source} -o ${object})
    list(APPEND objects ${object})
  endforeach()
  set(program ${CMAKE_CURRENT_BINARY_DIR}/fuzz_${target})
  add_custom_command(OUTPUT ${program} DEPENDS ${objects}
    COMMAND ${FUZZ_CLANG} ${sanitize} -fsanitize=fuzzer ${objects} -o ${program})
  add_custom_target(short_fuzz_${target} ALL DEPENDS ${program})
  list(JOIN ARG_SEEDS "," seeds)
  add_test(NAME fuzz.${target} COMMAND ${program} -seed_inputs=${seeds} -seed=1 -runs=${ARG_RUNS} -max_len=4096 -timeout=60
           WORKING_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR})
  set_tests_properties(fuzz.${target} PROPERTIES LABELS fuzz)
endfunction()
