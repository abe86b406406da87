// Where on its program the machine can have been at each step of a job.
//
// The program's path goes one way. A place fits the counts of the axes if no axis is farther from it than its stretch
// allows. Of all places that fit, those are kept that can be reached from the ones before without leaving the path.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "tests/simulation/simtest/record/epoch_runs.hpp"
#include "tests/simulation/simtest/record/recording.hpp"

namespace lockstep::simtest {

/// From the earliest to the latest.
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
/// A step can differ from its intended time by the clock error bound that its axis has published. So an axis may have
/// made any number of steps from those certainly made to those possibly made.
Following follow(const Recording& recording, const JobRecord& job, const std::vector<Tick>& until);

/// Of each job of the recording; nothing for a homing.
using Followings = std::vector<std::optional<Following>>;
Followings follow_all(const Recording& recording);

/// An axis is bound until an emergency stop; one that a fault may separate from the others, until that fault;
/// one that a switch may stop, until that stop.
std::vector<Tick> bound_until(const Recording& recording, const std::map<Epoch, EpochRuns>& epochs,
                              const JobRecord& job);

}  // namespace lockstep::simtest
