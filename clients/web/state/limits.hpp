// The bounds of what a client may ask for; Machine.limits publishes them.
#pragma once

#include <chrono>
#include <cstddef>

namespace lockstep::web {

inline constexpr std::size_t kMaxProgram_bytes = 32U * 1024 * 1024;
inline constexpr std::size_t kMaxBody_bytes = 16U * 1024;  // of a command
inline constexpr std::size_t kMaxPathPoints = 1'000'000;
inline constexpr std::size_t kMaxViewers = 200;
inline constexpr std::chrono::milliseconds kJogRenew{100};
inline constexpr std::chrono::milliseconds kJogLife{300};

}  // namespace lockstep::web
