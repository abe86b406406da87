// Which owner moved which axis when, by the tracks of the pulses and by the frames' sender or the owner followed.
#pragma once

#include "tests/simulation/simtest/record/recording.hpp"

namespace lockstep::simtest {

/// A body, a tail, a part of a move of the axis on its own, or what a device ran after the end of its process.
struct Motion {
    std::size_t axis = 0;
    Tick begin;  // machine time
    Tick end;
    Term writer;
    const Track* track = nullptr;  // null: unreported
};

/// The motions of all axes, ordered by their beginning.
std::vector<Motion> motions_of(const Recording& recording);

}  // namespace lockstep::simtest
