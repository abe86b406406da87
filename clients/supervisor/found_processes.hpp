// Finds a machine's processes in the process table of this host, if the record of them is damaged or lost.
#pragma once

#include <filesystem>
#include <vector>

#include "clients/supervisor/process_record.hpp"

namespace lockstep {

/// Returns the services that were started with this machine file and the supervisors that keep this lock open, except
/// this process.
std::vector<ProcessRecord> found_processes(const std::filesystem::path& machine_file,
                                           const std::filesystem::path& lock);

/// Derives a service's name in the record from its command line; empty if it is no service of this machine file. Pure.
std::string service_name(const std::vector<std::string>& words, const std::filesystem::path& machine_file);

}  // namespace lockstep
