// A probe must be open before it is used, so that nothing moves with a probe that touches already.
#pragma once

#include <expected>

#include "clients/session/session.hpp"

namespace lockstep {

/// `probe`: its number. Fails if one of its inputs is closed, with the input's name.
std::expected<void, Failure> check_open(const Session& session, int probe);

}  // namespace lockstep
