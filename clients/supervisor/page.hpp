// The page of a machine that is up: whether it is served, and where.
#pragma once

#include <chrono>
#include <expected>
#include <string>

#include "clients/supervisor/state_directory.hpp"

namespace lockstep {

/// Waits until lockstep-web serves the page: its addresses with their tokens, a line each. Error: it was given up, or
/// the time passed, with the end of its log.
std::expected<std::string, std::string> await_page(const StateDirectory& state, std::chrono::nanoseconds patience);

}  // namespace lockstep
