// Compares the runs of one epoch with its planned frames, bit for bit, and finds how far each axis came.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "clients/verification/jobs/epoch_replay.hpp"
#include "clients/verification/jobs/run_difference.hpp"
#include "clients/verification/steps/left_steps.hpp"
#include "core/machine.hpp"
#include "services/record/reading/run.hpp"

namespace lockstep::verification {

using analysis::Run;

/// Why an axis's runs are not its whole part of the epoch.
struct Shortfall {
    enum class Kind : std::uint8_t {
        Cut,      // its pulses ceased early
        Silent,   // the log has nothing after a frame that is not its last
        Differs,  // it ran other frames than the rest, or rests elsewhere
    };
    Kind kind = Kind::Silent;
    MotorIndex motor;
    std::string text;  // "ran other frames than the rest"
};

class EpochCheck {
public:
    /// `at`: where each axis rests before the epoch.
    EpochCheck(const MachineConfig& machine, EpochReplay replay, const MotorPositions& at);

    Epoch epoch() const { return replay_.epoch(); }
    const MachineConfig& machine() const { return machine_; }
    EpochReplay& replay() { return replay_; }
    const EpochReplay& replay() const { return replay_; }

    /// Whether a run of an axis follows its newest one in the log.
    bool follows(MotorIndex motor, const Run& run) const { return out_of_order(axes_[motor], run).empty(); }
    /// Compares the next run of an axis. Returns why it is not the planned one; nullopt if it is. `is_behind_gap`: runs
    /// before it are missing from the log.
    std::optional<RunDifference> compare(MotorIndex motor, const Run& run, bool is_behind_gap);

    /// The first axis that did not run its last frame and tail to their end, and why; nullopt if all did.
    std::optional<Shortfall> shortfall();
    std::optional<Shortfall> shortfall_of(MotorIndex motor);
    /// Takes an axis whose runs are missing for one that ran what the others ran. Returns false if no other axis ran
    /// further than it.
    bool assume_complete(MotorIndex motor);
    /// How the epoch ended, by the coordinator's own evaluation.
    EpochEnd end() const;
    /// The highest frame that an axis ran.
    FrameNumber ran() const;
    /// In an epoch in which a motor's pulses cease at the touch: why it does not rest where they had to; nullopt if it
    /// does, and in all other epochs. `touched`: the tick of the touch.
    std::optional<std::string> rests_off_touch(Tick touched) const;

    /// The runs that the plan allows an axis after its newest run. Each course has further frames, or none, and then
    /// the tail of the last frame, or the path's end if it has no tail. Before its process ended, an axis may have run
    /// or armed, without a record, the frame in motion and all frames that were sent ahead. `ahead`: makes these
    /// frames.
    std::vector<Course> courses_of(MotorIndex motor, EpochReplay& ahead) const;

private:
    struct Progress {  // of an axis
        FrameNumber ran = 0;
        bool in_tail = false;
        bool cut = false;
        Position at;
        std::optional<Tick> end;  // of its last run
    };

    /// The largest clock error with which an axis moves.
    Ticks known_within() const { return machine_.estimates_clocks() ? machine_.clock_error_limit() : Ticks{}; }
    std::string out_of_order(const Progress& axis, const Run& run) const;
    Shortfall silent(MotorIndex motor) const;
    /// Its pulses ceased at the touch of the epoch.
    bool ceased(MotorIndex motor) const;
    MotorIndex least_far() const;
    Position rests_at(MotorIndex motor, const Frame& frame) const;

    MachineConfig machine_;
    EpochReplay replay_;
    std::vector<Progress> axes_;
};

}  // namespace lockstep::verification
