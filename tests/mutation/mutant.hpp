// The mutated copy includes this file before everything else (-include). It selects the mutant that a process runs.
//   LOCKSTEP_MUTANT=N        runs the code with change N; without it the code is unchanged
//   LOCKSTEP_REACHED=FILE    appends the numbers of all reached mutants to a file when the process ends
#pragma once
#ifdef __cplusplus

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

/// Whether this process runs mutant n. False in constant expressions, which keep the original code.
constexpr bool mutant(int n) {
    if (__builtin_is_constant_evaluated()) { return false; }  // not std::: some libraries are built as C++17
    if (reached.file != nullptr) { reached.seen[n] = true; }
    return chosen_mutant == n;
}

}  // namespace lockstep
#endif
