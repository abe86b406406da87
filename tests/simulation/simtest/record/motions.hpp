// Who moved which axis when: by the pulses' tracks, and by who sent the frames or was followed.
#pragma once

#include "tests/simulation/simtest/record/recording.hpp"

namespace lockstep::simtest {

/// A body or a tail, a part of a move of the axis on its own, or what a device went on with when its process had ended.
struct Motion {
    std::size_t axis = 0;
    Tick begin;  // machine time
    Tick end;
    Term writer;
    const Track* track = nullptr;  // null: nobody said what it was
};

/// Of all axes, by their beginning.
std::vector<Motion> motions_of(const Recording& recording);

}  // namespace lockstep::simtest
