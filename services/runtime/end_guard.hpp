// Bounds how long a process takes to end. For example, a thread that waits for a hung disk may never end.
//
// It is the first object of a service, so that it outlives all objects that the end waits for. Data not written by then
// is lost, as if the process had been killed, but its flight recorder's memory stays.
#pragma once

#include <chrono>
#include <thread>

#include "services/runtime/stop_signal.hpp"

namespace lockstep {

inline constexpr std::chrono::seconds kLongestEnd{4};

class EndGuard {
public:
    /// After a stop was requested, the process has `longest` to end. Then the guard ends it at once with
    /// kServiceFailed. The guard counts its own checks, not time, so a stall of the whole process does not count.
    explicit EndGuard(const StopSignal& stop, std::chrono::milliseconds longest = kLongestEnd);

private:
    void watch(const std::stop_token& ended, const StopSignal& stop) const;

    std::chrono::milliseconds between_looks_;
    std::jthread thread_;
};

}  // namespace lockstep
