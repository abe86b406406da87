// The keys of a machine's members as they are on this host: what `lockstep keys` and the doctor say.
#pragma once

#include <filesystem>

#include "core/machine.hpp"
#include "idl/proto/report.pb.h"

namespace lockstep {

/// A member none of whose own files is there is not of this host, and nothing is wrong with it.
proto::KeysReport keys_report(const MachineConfig& machine, const std::filesystem::path& directory);

}  // namespace lockstep
