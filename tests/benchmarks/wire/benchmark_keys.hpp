// Keys for the benchmark, with the protection of a machine's keys. Each side may send and receive frames, as no role
// may.
#pragma once

#include <filesystem>

#include "services/setup/machine_setup.hpp"
#include "services/wire/dds/participant.hpp"

namespace lockstep {

/// False: the directory cannot be made, or is not empty.
bool make_benchmark_keys(const NetworkConfig& network, const std::filesystem::path& directory);

Credentials benchmark_credentials(const std::filesystem::path& directory);

}  // namespace lockstep
