// The correction of lost steps before a job: which motors move, and how far, follows from how far their slides were
// pushed.
#pragma once

#include <optional>

#include "tests/simulation/simtest/run/bench.hpp"

namespace lockstep::simtest {

/// Some motor of the machine makes up lost steps.
bool corrects(const MachineConfig& machine);

class CorrectionPlayer {
public:
    /// Make it before the job is asked for.
    explicit CorrectionPlayer(Bench& bench);

    /// Call it when the job was accepted. Waits until the motors that must make up steps have done so, and records
    /// their steps as a job without a program. `at`: the positions of the motors, updated where a motor did not reach
    /// its place because of a fault. `streamed_s`: how long the program may take to come. Changes nothing if no motor
    /// has to move.
    void play(JobRecord& job, Counts& at, double streamed_s);

private:
    std::optional<Tick> first_epoch_of(const JobRecord& job);
    double longest_seconds(double streamed_s) const;
    void check(std::size_t motor, std::span<const StepEdge> steps);

    Bench& bench_;
    Counts due_;                            // the steps that each motor must make up, signed
    std::vector<std::uint32_t> corrected_;  // by each motor, before
};

}  // namespace lockstep::simtest
