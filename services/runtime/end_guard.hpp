// Bounds how long a process takes to end: a thread whose disk hangs, for example, may never end.
//
// It is the first object of a service, so that it outlives everything that the end waits for. What is not written by
// then is lost, as if the process had been killed; its flight recorder's memory stays.
#pragma once

#include <chrono>
#include <thread>

#include "services/runtime/stop_signal.hpp"

namespace lockstep {

inline constexpr std::chrono::seconds kLongestEnd{4};

class EndGuard {
public:
    /// Once a stop has been requested the process has `longest` to end; then it ends at once, with kServiceFailed. It
    /// counts its own checks, not time: while the whole process stands still it does not check either.
    explicit EndGuard(const StopSignal& stop, std::chrono::milliseconds longest = kLongestEnd);

private:
    void watch(const std::stop_token& ended, const StopSignal& stop) const;

    std::chrono::milliseconds between_looks_;
    std::jthread thread_;
};

}  // namespace lockstep
