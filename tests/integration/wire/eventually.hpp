// Waits for a condition, with a deadline so far off that only a failure reaches it.
#pragma once

#include <chrono>
#include <thread>

namespace lockstep {

/// True as soon as condition() is; false if it is not within 20 s.
template <typename Condition>
bool eventually(Condition condition) {
    using namespace std::chrono_literals;
    const auto deadline = std::chrono::steady_clock::now() + 20s;
    while (!condition()) {
        if (std::chrono::steady_clock::now() > deadline) { return false; }
        std::this_thread::sleep_for(1ms);
    }
    return true;
}

}  // namespace lockstep
