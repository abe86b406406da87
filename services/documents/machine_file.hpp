// The machine's configuration file: idl/proto/machine.proto in protobuf's text format.
//
// The functions accept a whole file, or refuse it with all its errors. Optional keys have the defaults that
// machine.proto documents. Any other key is an error.
#pragma once

#include <cstdint>
#include <expected>
#include <filesystem>
#include <string>
#include <string_view>

#include "core/machine.hpp"
#include "services/files/diagnostic.hpp"

namespace lockstep {

std::expected<MachineConfig, Diagnostics> parse_machine(std::string_view text);

std::expected<MachineConfig, Diagnostics> load_machine_file(const std::filesystem::path& path);

/// Returns the configuration as text. parse_machine returns the same configuration from it, bit for bit.
std::string machine_text(const MachineConfig& machine);

/// FNV-1a of the configuration with its defaults filled in, so it is equal for files with the same meaning. It is never
/// 0.
std::uint64_t config_hash(const MachineConfig& machine);

}  // namespace lockstep
