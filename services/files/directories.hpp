// Where this host keeps the files of a machine's processes: those that end with them, and those that stay.
#pragma once

#include <cstdint>
#include <expected>
#include <filesystem>
#include <string>
#include <vector>

namespace lockstep {

/// For files that live as long as the processes: $LOCKSTEP_STATE if set; else /run/lockstep for root; else
/// $XDG_RUNTIME_DIR/lockstep; else /tmp/lockstep-UID.
std::filesystem::path state_root();

/// For the logs that the processes keep: ROOT/MACHINE/record. ROOT is $LOCKSTEP_STATE if set; else
/// /var/lib/lockstep for root; else $HOME/.local/state/lockstep; else /tmp/lockstep-UID.
std::filesystem::path record_directory(const std::string& machine);

/// For the positions that outlive the axes' processes: ROOT/MACHINE/position, with the same ROOT.
std::filesystem::path position_directory(const std::string& machine);

/// The values that outlive the machine's programs: ROOT/MACHINE/values.textproto, with the same ROOT.
std::filesystem::path values_file(const std::string& machine);

/// For memory that outlives its process, but not the host: never on a disk. /dev/shm/lockstep-UID.
std::filesystem::path memory_directory();

/// The file through which a machine's processes on one host share the axes' states (network.one_host). They are of one
/// user and one network namespace, so their loopback would connect them too. In memory_directory().
std::filesystem::path shared_states_file(const std::string& machine, std::uint32_t domain);

/// Creates it if it is missing, readable by this user alone. Error: why not. In a directory that everybody may write,
/// another user may have created it, or put something else there.
std::expected<void, std::string> make_own_directory(const std::filesystem::path& directory);

/// The directories of all users that this user may read: root reads all, others their own.
std::vector<std::filesystem::path> memory_directories();

}  // namespace lockstep
