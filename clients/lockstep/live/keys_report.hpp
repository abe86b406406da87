// The keys of a machine's members on this host: the data of `lockstep keys` and the doctor.
#pragma once

#include <filesystem>

#include "core/machine.hpp"
#include "idl/proto/report.pb.h"

namespace lockstep {

/// A member without any file of its own here does not run on this host, and has no errors.
proto::KeysReport keys_report(const MachineConfig& machine, const std::filesystem::path& directory);

}  // namespace lockstep
