// The places of its program at which the machine can have been at each step of a job.
//
// The machine goes only forward on the program's path. A place fits the counts of the axes if no axis is farther from
// it than its stretch allows. Of all places that fit, those remain that are reached from the previous ones on the path.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "tests/simulation/simtest/record/epoch_runs.hpp"
#include "tests/simulation/simtest/record/recording.hpp"

namespace lockstep::simtest {

/// A range of places, from the earliest to the latest.
struct Reached {
    double first = 0;
    double last = 0;
};

/// The step after which no place is left.
struct Departure {
    std::size_t axis = 0;
    Tick tick;
    std::size_t step = 0;  // of the axis, in the job
    Reached before;
};

struct Following {
    std::vector<std::vector<Reached>> at_step;  // by axis
    Reached end;
    std::optional<Departure> departure;
};

/// `until`: the time after which an axis is no longer bound to the others.
///
/// A step can differ from its intended time by the clock error bound that its axis has published. Therefore the number
/// of steps that an axis has made is between those certainly made and those possibly made.
Following follow(const Recording& recording, const JobRecord& job, const std::vector<Tick>& until);

/// One for each job of the recording; nullopt for a homing.
using Followings = std::vector<std::optional<Following>>;
Followings follow_all(const Recording& recording);

/// The time until which each axis is bound to the others: until an emergency stop, until a fault that may separate it
/// from the others, or until a stop by a switch.
std::vector<Tick> bound_until(const Recording& recording, const std::map<Epoch, EpochRuns>& epochs,
                              const JobRecord& job);

}  // namespace lockstep::simtest
