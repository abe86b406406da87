// Asks a person whether a motion may begin that the person did not command in detail.
#pragma once

#include <expected>
#include <string>

#include "clients/text/failure.hpp"
#include "clients/text/output.hpp"

namespace lockstep {

/// Asks "begin? [y/N]" after the motion was shown. `without_terminal`: the failure if nobody can be asked, with the
/// remedy. Fails unless the answer is yes.
std::expected<void, Failure> confirm_motion(bool json, const Output& output, const std::string& without_terminal);

}  // namespace lockstep
