// Directories of this host for the files of a machine's processes, temporary and lasting.
#pragma once

#include <cstdint>
#include <expected>
#include <filesystem>
#include <string>
#include <vector>

namespace lockstep {

/// For files that are needed only while the processes run: $LOCKSTEP_STATE if set; else /run/lockstep for root; else
/// $XDG_RUNTIME_DIR/lockstep; else /tmp/lockstep-UID.
std::filesystem::path state_root();

/// For the logs that the processes keep: ROOT/MACHINE/record. ROOT is $LOCKSTEP_STATE if set; else
/// /var/lib/lockstep for root; else $HOME/.local/state/lockstep; else /tmp/lockstep-UID.
std::filesystem::path record_directory(const std::string& machine);

/// For the positions that outlive the axes' processes: ROOT/MACHINE/position, with the same ROOT.
std::filesystem::path position_directory(const std::string& machine);

/// The values that outlive the machine's programs: ROOT/MACHINE/values.textproto, with the same ROOT.
std::filesystem::path values_file(const std::string& machine);

/// For memory that outlives its process, but not the host's run: /dev/shm/lockstep-UID. It is never on a disk.
std::filesystem::path memory_directory();

/// The file in memory_directory() through which a machine's processes on one host share the axes' states
/// (network.one_host). Only processes of one user and one network namespace share it, as they would share a loopback
/// interface.
std::filesystem::path shared_states_file(const std::string& machine, std::uint32_t domain);

/// Creates the directory if it is missing, accessible to this user only. Error: why it cannot be used. Where everybody
/// may write, another user may have created it, or a file of that name.
std::expected<void, std::string> make_own_directory(const std::filesystem::path& directory);

/// The memory directories that this user may read: root reads those of all users, other users only their own.
std::vector<std::filesystem::path> memory_directories();

}  // namespace lockstep
