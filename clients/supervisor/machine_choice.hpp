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

/// The help of --machine, for programs that call choose_machine().
inline constexpr const char* kMachineHelp =
    "the machine's configuration file; default: $LOCKSTEP_MACHINE, else the machine that is up on this host, else "
    "/etc/lockstep/machine.textproto";

/// Chooses the file from the candidates. Pure. `up`: configuration files of the machines that are up. `installed`:
/// empty if none is. If no file or several files qualify, the error says how to choose.
std::expected<std::filesystem::path, Failure> choose_file(const std::string& option, const char* environment,
                                                          const std::vector<std::filesystem::path>& up,
                                                          const std::filesystem::path& installed = {});

/// The path of the installed machine's file; empty if there is none. A file in a directory that this user may not enter
/// may be there, so its path is returned, and reading it reports the directory.
std::filesystem::path installed_machine(const std::filesystem::path& file = kInstalledMachine);

/// Reads the machine with the settings that senders have written. For a machine that is up on this host, these are the
/// settings at the time when it was brought up. The error lists everything that is wrong with the file.
std::expected<ChosenMachine, Failure> read_machine(const std::filesystem::path& file);

/// Fails if no machine is chosen, or as read_machine().
std::expected<ChosenMachine, Failure> choose_machine(const std::string& option);

}  // namespace lockstep
