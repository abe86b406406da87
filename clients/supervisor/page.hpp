// The page of a machine that is up: whether it is served, and where.
#pragma once

#include <chrono>
#include <expected>
#include <string>

#include "clients/supervisor/state_directory.hpp"

namespace lockstep {

/// Waits until lockstep-web serves the page. Returns its addresses with their tokens, one per line. Fails if the
/// process was given up or the time has passed; the error has the end of its log.
std::expected<std::string, std::string> await_page(const StateDirectory& state, std::chrono::nanoseconds patience);

}  // namespace lockstep
