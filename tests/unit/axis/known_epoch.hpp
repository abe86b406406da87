// The term and the epoch that an axis follows in these tests.
#pragma once

#include "core/protocol/messages.hpp"

namespace lockstep {

inline constexpr Term kTerm{1, 1};
inline constexpr Epoch kEpoch = first_epoch(kTerm) + 7;

}  // namespace lockstep
