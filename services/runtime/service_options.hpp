// The command line options, exit codes and loop period that all services share.
#pragma once

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>

#include "services/runtime/log.hpp"
#include "services/setup/machine_setup.hpp"

namespace lockstep {

inline constexpr int kServiceDone = 0;
inline constexpr int kServiceFailed = 1;
inline constexpr int kServiceBadInput = 2;

/// For wrong options or a wrong configuration, before the log is open.
inline int end_with_bad_input(const std::string& why) {
    std::cerr << why << (why.ends_with('\n') ? "" : "\n");
    return kServiceBadInput;
}
inline int end_with_failure(const std::string& why) {
    log_error(why);
    return kServiceFailed;
}

struct ServiceOptions {
    std::filesystem::path machine_file;
    std::optional<std::filesystem::path> log_file;  // none: standard error
    bool record = true;                             // publish the record over LCM
};

/// The period at which a service checks for messages. It is a fraction of a slot, so that sampling takes only a small
/// part of a hop (core/protocol/rules.hpp). Shared memory delivers at once, so sampling may then take a larger part.
inline std::chrono::nanoseconds loop_period(const MachineSetup& machine) {
    const int loops_per_slot = machine.network.one_host ? 2 : 4;
    const std::chrono::nanoseconds period{machine.timing.slot_us * 1000 / loops_per_slot};
    return std::min<std::chrono::nanoseconds>(period, std::chrono::milliseconds{5});
}

}  // namespace lockstep
