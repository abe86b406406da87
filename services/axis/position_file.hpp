// Keeps an axis's position for the next process in one small file, which is replaced after each run.
// core/axis/device/position_claim.hpp states when the next process accepts it.
#pragma once

#include <filesystem>
#include <mutex>
#include <string>
#include <utility>

#include "core/axis/device/position_claim.hpp"
#include "services/axis/position_document.hpp"
#include "services/files/newest_file.hpp"

namespace lockstep {

/// Returns DIRECTORY/AXIS.textproto. DIRECTORY comes from the machine's file, otherwise from the host.
std::filesystem::path position_file(const MachineConfig& machine, std::size_t axis);

struct ReadPosition {
    KeptOrNot kept;
    std::string trouble;  // with PositionUnreadable: what is wrong with the file, for the log
};

/// Refuses a file that belongs to another user (except root) or that others may write.
ReadPosition read_position(const std::filesystem::path& path);

/// If a write fails, the position in the file is out of date, and the next process refuses it.
class PositionKeeper {
public:
    PositionKeeper(std::filesystem::path path, NewestFile::OnFailure on_failure) : file_(std::move(path), on_failure) {}

    /// The loop calls this. A std::function with a copy of the position would allocate memory, so the copy is a member.
    void keep(const KeptPosition& position) {
        {
            const std::scoped_lock lock(mutex_);
            newest_ = position;
        }
        file_.keep(position.run, [this] { return text(); });
    }

private:
    /// The writing thread calls this. It may get a newer position than the one that keep() announced.
    std::string text() {
        std::unique_lock lock(mutex_);
        const KeptPosition newest = newest_;
        lock.unlock();
        return position_text(newest);
    }

    std::mutex mutex_;
    KeptPosition newest_;
    NewestFile file_;  // declared last, so that its thread ends first
};

}  // namespace lockstep
