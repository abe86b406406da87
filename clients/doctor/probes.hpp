// Measures the host: one function for each thing that the doctor rates.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "clients/doctor/ratings.hpp"

namespace lockstep::doctor {

InterfaceFacts look_at_interface(const std::string& name);
/// The size that the kernel grants to a socket that requests so many bytes.
std::int64_t receive_buffer_given(std::int64_t asked);
/// The same for sending, with the kernel's own share.
std::int64_t send_buffer_given(std::int64_t asked);
/// Publishes a message on a channel of the doctor's own, and waits for it. No value: LCM cannot be opened.
std::optional<bool> receives_own_message(const std::string& lcm_url);
RealTimeFacts look_at_real_time();
ClockFacts look_at_clock();
/// Wakes each `period` for so long, as a service does; reports the share that is done, 0 to 1.
StallFacts look_for_stalls(std::chrono::nanoseconds period, std::chrono::nanoseconds during,
                           const std::function<void(double)>& progress);
/// Whether a file could be created there, or in the nearest folder above it that exists. Empty: yes; else why not.
std::string why_not_writable(const std::string& directory);

}  // namespace lockstep::doctor
