// Which machine a verb is about: --machine, else $LOCKSTEP_MACHINE, else the one that is up on this host, else the one
// whose file is installed there.
#pragma once

#include <expected>
#include <filesystem>
#include <string>
#include <vector>

#include "clients/session/chosen_machine.hpp"
#include "clients/text/failure.hpp"

namespace lockstep {

/// Where a host's machine is installed; the units of systemd read it, too.
inline constexpr const char* kInstalledMachine = "/etc/lockstep/machine.textproto";

/// Which file: pure, given what there is to choose from. `up`: configuration files of the machines that are up;
/// `installed`: empty where none is. Error: none or several are up; it says how to choose.
std::expected<std::filesystem::path, Failure> choose_file(const std::string& option, const char* environment,
                                                          const std::vector<std::filesystem::path>& up,
                                                          const std::filesystem::path& installed = {});

/// Error: no machine chosen, or everything that is wrong with its file.
std::expected<ChosenMachine, Failure> choose_machine(const std::string& option);

}  // namespace lockstep
