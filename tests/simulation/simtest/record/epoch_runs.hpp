// Which frames of each epoch each axis ran, as its process reported, or by its steps if the process ended.
#pragma once

#include "tests/simulation/simtest/record/recording.hpp"

namespace lockstep::simtest {

/// The highest frame of an epoch that an axis ran. If only its steps are known, there can be several candidates.
struct LastFrame {
    FrameNumber low = 0;
    FrameNumber high = 0;
};

/// How the axes differ in an epoch, and which of them may differ.
struct EpochRuns {
    std::vector<LastFrame> last;      // of each axis
    std::vector<bool> lost_device{};  // a device that is lost stops anywhere
    std::vector<bool> may_differ;
    bool apart = false;          // not all axes ran the same frames
    std::optional<Tick> parted;  // apart: the begin of the first frame that not all axes ran
};

/// The net steps of a lost run behind its last recorded frame. nullopt: the axis moved on its own, too, before it
/// recorded again.
std::optional<std::int64_t> unrecorded_steps(const Recording& recording, std::size_t axis, const LostRun& lost);

/// The net steps of a lost run from its last recorded frame to the rest after frame k.
std::int64_t steps_to_rest(const SentEpoch& epoch, std::size_t axis, FrameNumber recorded, FrameNumber k);

std::map<Epoch, EpochRuns> epoch_runs(const Recording& recording);

}  // namespace lockstep::simtest
