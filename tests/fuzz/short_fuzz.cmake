# short_fuzz(NAME [LONG] RUNS NUMBER SOURCES ... SEEDS ... [LIBS ...]) adds a test that gives tests/fuzz/NAME.cpp the texts that
# libFuzzer makes of the seeds. The number of texts and the random seed are fixed, so every run is the same. Only these sources
# are built with clang and its sanitizers. LONG: only make test-long builds and runs it. tests/fuzz/run searches for
# longer.
find_program(FUZZ_CLANG clang++-19)
if(NOT FUZZ_CLANG)
  message(STATUS "clang++-19 is not installed: short fuzzing is left out; deploy/install-dependencies installs it")
endif()

function(short_fuzz target)
  if(NOT FUZZ_CLANG)
    return()
  endif()
  cmake_parse_arguments(ARG "LONG" "RUNS" "SOURCES;SEEDS;LIBS" ${ARGN})
  list(TRANSFORM ARG_LIBS PREPEND -l)
  set(sanitize -fsanitize=address,undefined -fno-sanitize-recover=all)
  set(program ${CMAKE_CURRENT_BINARY_DIR}/fuzz_${target})
  set(all ${program}.cpp)  # one file, since the headers take most of the compiler's time
  set(includes ${ARG_SOURCES} ${PROJECT_SOURCE_DIR}/tests/fuzz/${target}.cpp)
  list(TRANSFORM includes REPLACE "(.+)" "#include \"\\1\"\n")
  list(JOIN includes "" includes)
  file(CONFIGURE OUTPUT ${all} CONTENT "${includes}")
  add_custom_command(OUTPUT ${program}.o DEPENDS ${all} DEPFILE ${program}.d
    COMMAND ${CMAKE_CXX_COMPILER_LAUNCHER} ${FUZZ_CLANG} -std=c++23 -O1 -g1 -I${PROJECT_SOURCE_DIR} ${sanitize}
            -fsanitize=fuzzer-no-link -MD -MF ${program}.d -c ${all} -o ${program}.o)
  add_custom_command(OUTPUT ${program} DEPENDS ${program}.o
    COMMAND ${FUZZ_CLANG} ${sanitize} -fsanitize=fuzzer ${program}.o -lfmt ${ARG_LIBS} -o ${program})
  set(always ALL)
  if(ARG_LONG)
    set(always)
    set_property(GLOBAL APPEND PROPERTY RANDOM_TESTS short_fuzz_${target})
  endif()
  add_custom_target(short_fuzz_${target} ${always} DEPENDS ${program})
  list(JOIN ARG_SEEDS "," seeds)
  set(label fuzz)
  set(only_long)
  if(ARG_LONG)
    set(label long)
    set(only_long CONFIGURATIONS Long)
  endif()
  add_test(NAME fuzz.${target} ${only_long} COMMAND ${program} -seed_inputs=${seeds} -seed=1 -runs=${ARG_RUNS} -max_len=4096 -timeout=60
           WORKING_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR})
  set_tests_properties(fuzz.${target} PROPERTIES LABELS ${label} COST ${LONG_COST})
endfunction()
