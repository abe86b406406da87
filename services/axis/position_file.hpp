// Keeps an axis's position for the next process: one small file, replaced whole after each run (core/
// axis/device/position_claim.hpp states when the next process accepts it).
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

/// DIRECTORY/AXIS.textproto. DIRECTORY comes from the machine's file or from the host.
std::filesystem::path position_file(const MachineConfig& machine, std::size_t axis);

struct ReadPosition {
    KeptOrNot kept;
    std::string trouble;  // with PositionUnreadable: what is wrong with the file, for the log
};

/// Refuses a file that another user may have written: one of another user, or one that others may write.
ReadPosition read_position(const std::filesystem::path& path);

/// Writes in the background: keep() never waits for the disk. If positions come faster than the disk takes them, only
/// the newest is written. A position that was not written is out of date, and the next process refuses the old one.
class PositionKeeper {
public:
    using OnFailure = void (*)(const std::string& why);
    /// The writing thread calls `on_failure` when a write fails after one that succeeded.
    PositionKeeper(std::filesystem::path path, OnFailure on_failure);
    /// Waits until everything is written.
    ~PositionKeeper();

    void keep(KeptPosition position);

private:
    void serve(const std::stop_token& stop);
    void write(const KeptPosition& position);

    std::filesystem::path path_;
    OnFailure on_failure_;
    bool failed_ = false;  // the last write
    std::mutex mutex_;
    std::condition_variable_any news_;
    std::optional<KeptPosition> next_;
    std::jthread thread_;
};

}  // namespace lockstep
