// Keeps an axis's position for the next process in one small file, which is replaced after each run.
// core/axis/device/position_claim.hpp states when the next process accepts it.
#pragma once

#include <filesystem>
#include <string>
#include <utility>

#include "core/axis/device/position_claim.hpp"
#include "services/axis/position_document.hpp"
#include "services/files/newest_file.hpp"
#include "services/setup/machine_setup.hpp"

namespace lockstep {

/// Returns DIRECTORY/AXIS.textproto. DIRECTORY comes from the machine's file, otherwise from the host.
std::filesystem::path position_file(const MachineSetup& machine, MotorIndex motor);

struct ReadPosition {
    KeptOrNot kept;
    std::string trouble;  // with PositionUnreadable: what is wrong with the file, for the log
};

/// Refuses a file that belongs to another user (except root) or that others may write.
ReadPosition read_position(const std::filesystem::path& path);

/// If a write fails, the position in the file is out of date, and the next process refuses it.
class PositionKeeper {
public:
    PositionKeeper(std::filesystem::path path, NumberedText::OnFailure on_failure)
        : file_(std::move(path), position_text, on_failure) {}

    /// The loop calls this. It neither waits nor allocates memory.
    void keep(const KeptPosition& position) { file_.keep(position.run, position); }

private:
    NewestFile<KeptPosition> file_;
};

}  // namespace lockstep
