// The keys of a machine's members on this host, for `lockstep keys` and the doctor.
#pragma once

#include <filesystem>

#include "core/machine.hpp"
#include "idl/proto/report.pb.h"

namespace lockstep {

/// A member without any key file here does not run on this host, and has no errors.
proto::KeysReport keys_report(const MachineConfig& machine, const std::filesystem::path& directory);

}  // namespace lockstep
