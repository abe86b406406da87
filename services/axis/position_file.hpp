// Where an axis's position outlives its process: one small file, replaced whole after each run (core/
// axis/device/position_claim.hpp says when the next process believes it).
#pragma once

#include <condition_variable>
#include <expected>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "core/axis/device/position_claim.hpp"

namespace lockstep {

/// DIRECTORY/AXIS.textproto, in the directory that the machine's file or the host names.
std::filesystem::path position_file(const MachineConfig& machine, std::size_t axis);

struct ReadPosition {
    KeptOrNot kept;
    std::string trouble;  // with PositionUnreadable: what is wrong with the file, for the log
};

/// Refuses what somebody else may have written: a file of another user, or one that others may write.
ReadPosition read_position(const std::filesystem::path& path);

/// Writes behind the caller's back: who keeps never waits for the disk. Of positions that come faster than the disk
/// takes them the newest is written; one that is not written is refused later, as any old one is.
class PositionKeeper {
public:
    using Complain = void (*)(const std::string& why);
    /// `complain` is called by the writing thread, when writing fails for the first time in a row.
    PositionKeeper(std::filesystem::path path, Complain complain);
    /// Waits until all is written.
    ~PositionKeeper();

    void keep(KeptPosition position);

private:
    void serve(const std::stop_token& stop);
    void write(const KeptPosition& position);

    std::filesystem::path path_;
    Complain complain_;
    bool failed_ = false;  // the last time
    std::mutex mutex_;
    std::condition_variable_any news_;
    std::optional<KeptPosition> next_;
    std::jthread thread_;
};

}  // namespace lockstep
