// The command line that starts LCM's lcm-spy with this machine's types. (Debian's own script passes Java an option that
// Java no longer has, and knows no types.)
#pragma once

#include <expected>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "clients/text/failure.hpp"

namespace lockstep {

/// The host's properties that lcm-spy depends on.
struct SpyHost {
    std::string display;                        // $DISPLAY; empty: none
    bool display_answers = false;               // it takes our windows
    std::optional<std::filesystem::path> java;  // the program itself, links resolved
    std::vector<std::filesystem::path> jars;    // lcm-spy, its charts, the machine's types
};

SpyHost look_at_host();

/// Error: what is missing, and how to get it.
std::expected<std::vector<std::string>, Failure> spy_command(const SpyHost& host, const std::string& lcm_url);

}  // namespace lockstep
