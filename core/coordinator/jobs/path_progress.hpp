// How much of a job on a path is done. It never falls, although what is left is planned again after a hold, and when an
// override changes.
#pragma once

#include <algorithm>

#include "core/motion/path.hpp"

namespace lockstep {

class PathProgress {
public:
    PathProgress() = default;
    /// `done`: of a job that another coordinator has begun.
    explicit PathProgress(double done) : share_(done) {}

    /// Once a slot: `into` the path in progress, with so much `left` of the job, as planned now. As long as the plan
    /// stays, the shares done add up to the share of its time.
    void note(Subticks into, Subticks left) {
        const Subticks done = before_ + into;
        if (done <= counted_) { return; }
        const auto since = static_cast<double>((done - counted_).value);
        share_ = std::min(1.0, share_ + (1 - share_) * since / (since + static_cast<double>(left.value)));
        counted_ = done;
    }
    /// The path in progress is at its end, after `ran`.
    void end_path(Subticks ran) { before_ = before_ + ran; }

    /// 0 to 1.
    double share() const { return share_; }

private:
    double share_ = 0;
    Subticks before_;   // run of the paths that have ended
    Subticks counted_;  // of the run, in `share_`
};

}  // namespace lockstep
