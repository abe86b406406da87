// Opens the log that a process keeps on its own board, as the machine's file configures it (`record`).
#pragma once

#include <cstdint>
#include <expected>
#include <filesystem>
#include <memory>
#include <string>

#include "services/record/record_sink.hpp"
#include "services/setup/machine_setup.hpp"

namespace lockstep {

/// `axis` is empty for the coordinator. Error: the disk's error, and the remedy.
std::expected<std::unique_ptr<RecordSink>, std::string> open_own_log(const MachineSetup& machine,
                                                                     const std::string& axis);

/// Where this host's processes of the machine keep their logs.
std::filesystem::path own_log_directory(const MachineSetup& machine);

/// The text that a process logs when it has lost `lost` messages of the record since its start.
std::string lost_records_text(const MachineSetup& machine, std::uint64_t lost);

}  // namespace lockstep
