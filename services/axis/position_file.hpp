// Keeps an axis's position for the next process: one small file, replaced whole after each run (core/
// axis/device/position_claim.hpp states when the next process accepts it).
#pragma once

#include <filesystem>
#include <mutex>
#include <string>
#include <utility>

#include "core/axis/device/position_claim.hpp"
#include "services/axis/position_document.hpp"
#include "services/files/newest_file.hpp"

namespace lockstep {

/// DIRECTORY/AXIS.textproto. DIRECTORY comes from the machine's file or from the host.
std::filesystem::path position_file(const MachineConfig& machine, std::size_t axis);

struct ReadPosition {
    KeptOrNot kept;
    std::string trouble;  // with PositionUnreadable: what is wrong with the file, for the log
};

/// Refuses a file that another user may have written: one of another user, or one that others may write.
ReadPosition read_position(const std::filesystem::path& path);

/// A position that was not written is out of date, and the next process refuses the old one.
class PositionKeeper {
public:
    PositionKeeper(std::filesystem::path path, NewestFile::OnFailure on_failure) : file_(std::move(path), on_failure) {}

    /// Called in the loop: a function that held a copy of the position would be allocated.
    void keep(const KeptPosition& position) {
        {
            const std::scoped_lock lock(mutex_);
            newest_ = position;
        }
        file_.keep(position.run, [this] { return text(); });
    }

private:
    /// For the writing thread, which may find a newer position than the one that it was told of.
    std::string text() {
        std::unique_lock lock(mutex_);
        const KeptPosition newest = newest_;
        lock.unlock();
        return position_text(newest);
    }

    std::mutex mutex_;
    KeptPosition newest_;
    NewestFile file_;  // its thread ends first
};

}  // namespace lockstep
