// The command line that starts LCM's lcm-spy with this machine's types. (Debian's script passes an option that Java no
// longer has, and does not know the types.)
#pragma once

#include <expected>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "clients/text/failure.hpp"

namespace lockstep {

/// The properties of the host that lcm-spy depends on.
struct SpyHost {
    std::string display;                        // $DISPLAY, or empty
    bool display_answers = false;               // this process can connect to the display
    std::optional<std::filesystem::path> java;  // the program itself, with links resolved
    std::vector<std::filesystem::path> jars;    // lcm-spy, its chart library, the machine's types
};

SpyHost look_at_host();

/// The error says what is missing and how to get it.
std::expected<std::vector<std::string>, Failure> spy_command(const SpyHost& host, const std::string& lcm_url);

}  // namespace lockstep
