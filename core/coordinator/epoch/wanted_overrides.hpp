// The overrides that an epoch shall change to, until its source has planned with them.
#pragma once

#include <optional>
#include <utility>

#include "core/coordinator/path/frame_source.hpp"
#include "core/overrides.hpp"
#include "core/protocol/messages.hpp"

namespace lockstep {

class WantedOverrides {
public:
    /// New overrides, which hold after frame `behind`.
    struct Change {
        FrameNumber behind = 0;
        Overrides overrides;
    };

    /// An epoch begins, with the overrides that are in force.
    void clear() { *this = {}; }
    /// From the next frame to be made, or as soon after it as the path allows. Of several changes between two frames
    /// the last one counts.
    void set(const Overrides& overrides) { wanted_ = overrides; }
    /// Call it before a frame is made behind frame `newest`. Tries once behind each frame.
    void try_behind(FrameNumber newest, FrameSource& source) {
        if (!wanted_ || tried_behind_ == newest) { return; }
        tried_behind_ = newest;
        if (!source.set_overrides(*wanted_)) { return; }
        taken_ = Change{newest, *wanted_};
        wanted_.reset();
    }
    /// The newest change, once.
    std::optional<Change> take_change() { return std::exchange(taken_, std::nullopt); }

private:
    std::optional<Overrides> wanted_;          // not planned with yet
    std::optional<FrameNumber> tried_behind_;  // the last frame after which that was tried
    std::optional<Change> taken_;
};

}  // namespace lockstep
