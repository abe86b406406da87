// Reminds of the end of a process's keys while it runs. Pure: the caller passes the time of the host's clock.
#pragma once

#include <chrono>
#include <optional>
#include <string>

namespace lockstep {

class ExpiryWatch {
public:
    /// `until`: when the first of the member's files expires.
    ExpiryWatch(std::string member, std::chrono::sys_seconds until) : member_(std::move(member)), until_(until) {}

    /// Returns a text once a day from kNearEnd before the end, and once at the end.
    std::optional<std::string> due(std::chrono::sys_seconds now);

private:
    std::string member_;
    std::chrono::sys_seconds until_;
    std::optional<std::chrono::sys_seconds> said_;
};

}  // namespace lockstep
