// Where this host keeps what a machine's processes leave: what is gone with them, and what is to stay.
#pragma once

#include <cstdint>
#include <expected>
#include <filesystem>
#include <string>
#include <vector>

namespace lockstep {

/// For what lasts as long as the processes: $LOCKSTEP_STATE where that is set; else /run/lockstep for root; else
/// $XDG_RUNTIME_DIR/lockstep; else /tmp/lockstep-UID.
std::filesystem::path state_root();

/// For the logs that they keep by themselves: ROOT/MACHINE/record. ROOT is $LOCKSTEP_STATE where that is set; else
/// /var/lib/lockstep for root; else $HOME/.local/state/lockstep; else /tmp/lockstep-UID.
std::filesystem::path record_directory(const std::string& machine);

/// For the positions that outlive the axes' processes: ROOT/MACHINE/position, with the same ROOT.
std::filesystem::path position_directory(const std::string& machine);

/// For memory that is to outlive its process, but not the host: never on a disk. /dev/shm/lockstep-UID.
std::filesystem::path memory_directory();

/// Where the processes of a machine on one host share what its axes say (network.one_host): those of one user and one
/// network namespace, who would hear each other by its loopback. In memory_directory().
std::filesystem::path shared_states_file(const std::string& machine, std::uint32_t domain);

/// Makes it where it is not there, readable by this user alone. Error: why not; where everybody may write, somebody
/// else may have made it, or put something else there.
std::expected<void, std::string> make_own_directory(const std::filesystem::path& directory);

/// Those of all users whom this one may read: root all there are, others their own.
std::vector<std::filesystem::path> memory_directories();

}  // namespace lockstep
