// The shape of the names that go into topics, channels and files.
#pragma once

#include <string_view>

namespace lockstep {

inline constexpr std::size_t kMaxAxisName = 16;
/// LCM's channel names have at most 63 characters, and the machine's and the axis's name are two parts of them.
inline constexpr std::size_t kMaxMachineName = 24;

/// A letter, then letters, digits and _, at most kMaxAxisName.
bool is_axis_name(std::string_view name);
/// The same with - too, at most kMaxMachineName.
bool is_machine_name(std::string_view name);
/// Letters, digits, - and ., at most 253, as RFC 1123 has them.
bool is_host_name(std::string_view name);
/// sim; or shm:NAME and uio:PATH, PATH an absolute one.
bool is_device_name(std::string_view name);
/// Whether they differ in capitals at most.
bool same_name(std::string_view one, std::string_view other);

}  // namespace lockstep
