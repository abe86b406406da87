// The keys of a machine's members on this host, for `lockstep keys` and the doctor.
#pragma once

#include <filesystem>

#include "idl/proto/report.pb.h"
#include "services/setup/machine_setup.hpp"

namespace lockstep {

/// A member without any key file here does not run on this host, and has no errors.
proto::KeysReport keys_report(const MachineSetup& machine, const std::filesystem::path& directory);

}  // namespace lockstep
