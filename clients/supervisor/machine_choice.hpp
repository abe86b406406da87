// The machine of a verb: --machine, else $LOCKSTEP_MACHINE, else the one that is up on this host, else the one that is
// installed there.
#pragma once

#include <expected>
#include <filesystem>
#include <string>
#include <vector>

#include "clients/session/chosen_machine.hpp"
#include "clients/text/failure.hpp"

namespace lockstep {

/// The path of an installed machine's file; systemd's units read it too.
inline constexpr const char* kInstalledMachine = "/etc/lockstep/machine.textproto";

/// Chooses the file: pure, from the candidates. `up`: configuration files of the machines that are up;
/// `installed`: empty if none is. Error: none or several are up, and how to choose.
std::expected<std::filesystem::path, Failure> choose_file(const std::string& option, const char* environment,
                                                          const std::vector<std::filesystem::path>& up,
                                                          const std::filesystem::path& installed = {});

/// With the settings that senders have written: of a machine that is up on this host, those that were there when it was
/// brought up. Error: everything that is wrong with its file.
std::expected<ChosenMachine, Failure> read_machine(const std::filesystem::path& file);

/// Error: no machine chosen, or everything that is wrong with its file.
std::expected<ChosenMachine, Failure> choose_machine(const std::string& option);

}  // namespace lockstep
