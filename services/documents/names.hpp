// The syntax of the names used in topics, channels and files, and the axis that has a name.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/machine.hpp"

namespace lockstep {

inline constexpr std::size_t kMaxAxisName = 16;
/// LCM's channel names have at most 63 characters, and contain the machine's and the axis's name.
inline constexpr std::size_t kMaxMachineName = 24;

/// A letter, then letters, digits and _, at most kMaxAxisName.
bool is_axis_name(std::string_view name);
/// As is_axis_name, but also with -, and at most kMaxMachineName.
bool is_machine_name(std::string_view name);
/// Letters, digits, - and ., at most 253 characters, as in RFC 1123.
bool is_host_name(std::string_view name);
/// Whether the text is an IPv4 or IPv6 address.
bool is_ip_address(const std::string& text);
/// Whether the text is an address that only this host can reach.
bool is_loopback_address(const std::string& text);
/// Whether the names are equal except for upper and lower case.
bool same_name(std::string_view one, std::string_view other);
/// The axis with this name, in upper or lower case; nullopt if there is none.
std::optional<AxisIndex> axis_in_any_case(const MachineConfig& machine, std::string_view name);

}  // namespace lockstep
