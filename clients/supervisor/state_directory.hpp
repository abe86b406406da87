// The files of a machine that is up on this host: the copy of the configuration that its processes run with, the
// record of the processes, a log for each.
// The directory is ROOT/MACHINE, with the root of services/files/directories.hpp.
#pragma once

#include <expected>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "clients/supervisor/process_record.hpp"
#include "services/documents/edit/kept_settings.hpp"

namespace lockstep {

inline constexpr const char* kSupervisor = "supervisor";

class StateDirectory {
public:
    explicit StateDirectory(const std::string& machine);

    const std::filesystem::path& path() const { return path_; }
    std::filesystem::path machine_file() const { return path_ / "machine.textproto"; }
    /// The addresses of the page, with their tokens, while it is served.
    std::filesystem::path page_file() const { return path_ / "page"; }
    std::filesystem::path log_file(const std::string& process) const { return path_ / (process + ".log"); }

    /// Creates the directory. The error has the reason and the remedy.
    std::expected<void, std::string> make() const;
    /// Claims the directory for this process and those that it forks from now on, until the last of them ends. Returns
    /// false if it is claimed already.
    bool lock() const;
    void remove_logs() const;
    /// The error names the file and the reason.
    std::expected<void, std::string> write_machine_file(const std::string& text) const;

    /// Stores the path of the copied file, and the settings beside it at that time, which the copy includes.
    std::expected<void, std::string> write_source(const std::filesystem::path& file,
                                                  const KeptSettings& settings) const;
    /// Empty if it is not known.
    std::filesystem::path source() const;
    std::filesystem::path settings_in_force() const { return path_ / "settings"; }

    /// Replaces the records at once: readers see the old or the new ones, never a part.
    void record(const std::vector<ProcessRecord>& processes) const;
    std::vector<ProcessRecord> recorded() const;
    /// The recorded processes that run now. If the record is unreliable, those that the host's process table shows.
    std::vector<ProcessRecord> running() const;
    /// Why the record is unreliable; nullopt if it is reliable or the machine was never up.
    std::optional<std::string> record_trouble() const;
    /// Whether processes of the machine run with this directory, but it was moved or removed.
    bool is_lost() const;
    void forget_processes() const;

private:
    std::string lost_text() const;
    std::filesystem::path processes_file() const { return path_ / "processes"; }
    std::filesystem::path lock_file() const { return path_ / "lock"; }
    std::filesystem::path path_;
};

/// The names, in order, of the machines that are up on this host and use this state root, also of those whose state
/// directory was moved or removed.
std::vector<std::string> machines_up();

/// The last lines of a file, each indented; empty if there are none.
std::string tail_of(const std::filesystem::path& file, std::size_t lines);

}  // namespace lockstep
