// A job on a path, as far as it has come.
#pragma once

#include <cstdint>
#include <optional>
#include <variant>

#include "core/coordinator/epoch/epoch_runner.hpp"
#include "core/coordinator/jobs/job.hpp"
#include "core/coordinator/jobs/path_progress.hpp"
#include "core/motion/path.hpp"
#include "core/pause.hpp"

namespace lockstep {

struct PathTask {
    MachineJob job;
    std::uint32_t next = 0;      // the first block of the next leg, or of the one in progress
    AxisCounts from;             // where that leg begins
    std::optional<Probe> probe;  // the leg ends where this touches
    PathProgress progress;
    bool has_moved = false;  // an epoch was begun
    int fruitless = 0;       // interruptions in a row without a frame that was run

    /// Call it when all axes rest together on the path, as their counts prove.
    void interrupt(const EpochEnd& end) {
        if (end.ran > 0) { fruitless = 0; }
    }
    /// Call it after an interruption without a command. Returns false after three interruptions in a row in which no
    /// frame was run.
    bool may_try_again(const EpochEnd& end) {
        constexpr int kMaxFruitless = 3;
        fruitless += end.ran == 0 ? 1 : 0;
        return fruitless < kMaxFruitless;
    }
};

/// The next activity of a job on a path: an epoch that has begun, a pause, or nothing, because its program is done.
struct EpochBegun {};
struct ProgramDone {};
/// The job ends with its probing move. `why`: why it ends without success.
struct Probed {
    FaultCode why = FaultCode::None;
};
using PathNext = std::variant<EpochBegun, Pause, ProgramDone, Probed>;

}  // namespace lockstep
