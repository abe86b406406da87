// Which frames of each epoch each axis ran, as its process said, or as its steps tell where the process ended.
#pragma once

#include "tests/simulation/simtest/record/recording.hpp"

namespace lockstep::simtest {

/// The highest frame of an epoch that an axis ran; where its steps are all there is to tell it by, it may be several.
struct LastFrame {
    FrameNumber low = 0;
    FrameNumber high = 0;
};

/// How the axes differ in an epoch, and what excuses it.
struct EpochRuns {
    std::vector<LastFrame> last;      // of each axis
    std::vector<bool> lost_device{};  // a device that is lost stops anywhere
    std::vector<bool> may_differ;
    bool apart = false;          // they are not all the same
    std::optional<Tick> parted;  // apart: when the first frame that not all ran began
};

/// Net steps of a lost run from after its last recorded frame to rest behind frame k.
std::int64_t steps_to_rest(const SentEpoch& epoch, std::size_t axis, FrameNumber recorded, FrameNumber k);

std::map<Epoch, EpochRuns> epoch_runs(const Recording& recording);

}  // namespace lockstep::simtest
