// What must hold of every input: where it does not, the fuzzer keeps the input.
#pragma once

#include <cstdio>
#include <cstdlib>

namespace lockstep {

inline void require(bool holds, const char* promise) {
    if (holds) { return; }
    std::fprintf(stderr, "does not hold: %s\n", promise);
    std::abort();
}

}  // namespace lockstep
