// Included before everything else in the mutated copy (-include): which of its mutants this process runs.
//   LOCKSTEP_MUTANT=N        the code with change N; without it the code as it is
//   LOCKSTEP_REACHED=FILE    at the end, adds the numbers of the mutants that were reached to a file
#pragma once
#ifdef __cplusplus

#include <cstddef>
#include <cstdio>
#include <cstdlib>

namespace lockstep {

inline const int chosen_mutant = [] {
    const char* const number = std::getenv("LOCKSTEP_MUTANT");
    return number != nullptr ? std::atoi(number) : -1;
}();

inline constexpr int kMostMutants = 1 << 16;

struct Reached {
    const char* file = std::getenv("LOCKSTEP_REACHED");
    bool seen[kMostMutants] = {};

    ~Reached() {
        std::FILE* const out = file != nullptr ? std::fopen(file, "a") : nullptr;
        if (out == nullptr) { return; }
        for (int n = 0; n < kMostMutants; ++n) {
            if (seen[n]) { std::fprintf(out, "%d\n", n); }
        }
        std::fclose(out);
        file = nullptr;
    }
};
inline Reached reached;

/// Whether this process runs mutant n. The code as it is in what the compiler evaluates.
constexpr bool mutant(int n) {
    if (__builtin_is_constant_evaluated()) { return false; }  // C++17: foreign code is built with it
    if (reached.file != nullptr) { reached.seen[n] = true; }
    return chosen_mutant == n;
}

}  // namespace lockstep
#endif
