// The syntax of the names used in topics, channels and files.
#pragma once

#include <string>
#include <string_view>

namespace lockstep {

inline constexpr std::size_t kMaxAxisName = 16;
/// LCM's channel names have at most 63 characters, and contain the machine's and the axis's name.
inline constexpr std::size_t kMaxMachineName = 24;

/// A letter, then letters, digits and _, at most kMaxAxisName.
bool is_axis_name(std::string_view name);
/// The same, also with -, at most kMaxMachineName.
bool is_machine_name(std::string_view name);
/// Letters, digits, - and ., at most 253 characters, as in RFC 1123.
bool is_host_name(std::string_view name);
/// Of IPv4 or IPv6.
bool is_ip_address(const std::string& text);
/// Whether only this host reaches it.
bool is_loopback_address(const std::string& text);
/// sim; or shm:NAME and uio:PATH, PATH an absolute one.
bool is_device_name(std::string_view name);
/// Whether they are equal but for capitals.
bool same_name(std::string_view one, std::string_view other);

}  // namespace lockstep
