// Runs a function in a copy of this process.
#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <type_traits>

#include "core/check.hpp"

namespace lockstep {

/// What `measure` returns in a copy of this process. Here everything stays as it was before, so several measurements
/// can begin from the same state. A copy that fails ends this process.
template <class Measure>
auto in_copy(const Measure& measure) {
    using Result = decltype(measure());
    static_assert(std::is_trivially_copyable_v<Result>, "the result passes through a pipe");
    std::array<int, 2> ends{};
    check(pipe(ends.data()) == 0, "a pipe to the copy opens");
    const pid_t copy = fork();
    check(copy >= 0, "this process is copied");
    if (copy == 0) {
        const Result result = measure();
        _exit(write(ends[1], &result, sizeof result) == sizeof result ? 0 : 1);
    }
    Result result{};
    close(ends[1]);
    check(read(ends[0], &result, sizeof result) == sizeof result, "the copy returns its result");
    close(ends[0]);
    waitpid(copy, nullptr, 0);
    return result;
}

}  // namespace lockstep
