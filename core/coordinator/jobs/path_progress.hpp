// How much of a job on a path is done. It never falls, although the rest is planned again after a hold and when an
// override changes.
#pragma once

#include <algorithm>

#include "core/motion/path.hpp"

namespace lockstep {

class PathProgress {
public:
    PathProgress() = default;
    /// `done`: the share of a job that another coordinator has run.
    explicit PathProgress(double done) : share_(done) {}

    /// Call it once a slot. `into`: time run of the path in progress. `left`: time left of the job, as planned now.
    /// While the plan stays the same, the added shares equal the share of its time.
    void note(Subticks into, Subticks left) {
        const Subticks done = before_ + into;
        if (done <= counted_) { return; }
        const auto since = static_cast<double>((done - counted_).value);
        share_ = std::min(1.0, share_ + (1 - share_) * since / (since + static_cast<double>(left.value)));
        counted_ = done;
    }
    /// The path in progress has ended after `ran`.
    void end_path(Subticks ran) { before_ = before_ + ran; }

    /// 0 to 1.
    double share() const { return share_; }

private:
    double share_ = 0;
    Subticks before_;   // how long the paths that have ended took
    Subticks counted_;  // the time of motion for which `share_` accounts
};

}  // namespace lockstep
