// Aborts a fuzz target if an input breaks a promise; the fuzzer then keeps the input.
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
