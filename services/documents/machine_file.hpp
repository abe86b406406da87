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

#include "services/files/diagnostic.hpp"
#include "services/setup/machine_setup.hpp"

namespace lockstep {

std::expected<MachineSetup, Diagnostics> parse_machine(std::string_view text);

std::expected<MachineSetup, Diagnostics> load_machine_file(const std::filesystem::path& path);

/// Returns the configuration as text. parse_machine returns the same configuration from it, bit for bit.
std::string machine_text(const MachineSetup& machine);

/// FNV-1a of the configuration with its defaults filled in, so it is equal for files with the same meaning. It is never
/// 0.
std::uint64_t config_hash(const MachineSetup& machine);

}  // namespace lockstep
