// Measures the host, with one function for each property that the doctor rates.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "clients/doctor/ratings.hpp"

namespace lockstep::doctor {

InterfaceFacts look_at_interface(const std::string& name);
/// The receive buffer, in bytes, that the kernel grants to a socket that requests `asked` bytes.
std::int64_t receive_buffer_given(std::int64_t asked);
/// The send buffer that the kernel grants, including the share that the kernel uses itself.
std::int64_t send_buffer_given(std::int64_t asked);
/// Publishes a message on a channel that only the doctor uses, and waits for it. Returns nullopt if LCM cannot be
/// opened.
std::optional<bool> receives_own_message(const std::string& lcm_url);
RealTimeFacts look_at_real_time();
ClockFacts look_at_clock();
/// Wakes every `period` during the time `during`, as a service does, and reports the completed share, 0 to 1.
StallFacts look_for_stalls(std::chrono::nanoseconds period, std::chrono::nanoseconds during,
                           const std::function<void(double)>& progress);
/// Checks whether a file could be created in the directory, or in its nearest existing parent if it does not exist.
/// Returns the reason if not, else an empty text.
std::string why_not_writable(const std::string& directory);

}  // namespace lockstep::doctor
