// Finds a machine's processes in the process table of this host, if the record of them is damaged or lost.
#pragma once

#include <filesystem>
#include <vector>

#include "clients/supervisor/process_record.hpp"

namespace lockstep {

/// Returns the services that were started with this machine file, and their supervisors, except this process. A
/// supervisor keeps this lock open, or is the lockstep command that started such a service: if the lock was moved or
/// removed, only the second shows it.
std::vector<ProcessRecord> found_processes(const std::filesystem::path& machine_file,
                                           const std::filesystem::path& lock);

/// The names of the machines of which a service runs with ROOT/NAME/machine.textproto, whether or not the file exists.
std::vector<std::string> found_machines(const std::filesystem::path& root);

/// Derives a service's name in the record from its command line; empty if it is no service of this machine file. Pure.
std::string service_name(const std::vector<std::string>& words, const std::filesystem::path& machine_file);

}  // namespace lockstep
