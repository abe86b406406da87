// Plans a job again from its record: finds its epochs, given how each earlier one ended.
#pragma once

#include <expected>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "clients/verification/jobs/epoch_replay.hpp"
#include "core/coordinator/path/program_plan.hpp"
#include "core/kinematics/kinematics.hpp"
#include "core/machine.hpp"
#include "services/record/reading/recorded_program.hpp"

namespace lockstep::verification {

using SharedProgram = std::shared_ptr<const analysis::RecordedProgram>;

class JobReplay {
public:
    /// `start_counts`: one per axis of the machine, and behind them the plays if a motor has backlash. Fails if the
    /// program cannot be planned from there.
    static std::expected<JobReplay, std::string> plan(const MachineConfig& machine, SharedProgram program,
                                                      const std::vector<std::int64_t>& start_counts);

    const MachineConfig& machine() const { return machine_; }
    const Kinematics& kinematics() const { return kinematics_; }

    /// Returns the next epoch, or nullopt if the program is done. `plays`: of the motors with backlash, where the epoch
    /// begins; empty: 0.
    std::optional<EpochStart> next(const std::vector<std::int64_t>& plays = {});

    /// Call it with the end of an epoch, Complete or Interrupted, and the epoch's source.
    void ended(const EpochEnd& end, OwnedSource source);

    /// The program ended with its probing move.
    void end_probed() { leg_ = legs_.size(), source_ = {}; }

    const SharedProgram& program() const { return program_; }
    /// The first block of the next motion; the axes rest before it. At the program's end, the number of blocks.
    std::uint32_t moves_from() const;

    /// The line of a block; 0: none.
    std::int32_t line_of(std::uint32_t block) const { return line_of(program_->block(block)); }

private:
    static std::int32_t line_of(const Block* block) { return block != nullptr ? block->line.value_or(0) : 0; }
    JobReplay(const MachineConfig& machine, SharedProgram program, std::vector<Leg> legs);
    TouchInputs touch_of(const Leg& leg) const;

    MachineConfig machine_;
    Kinematics kinematics_;
    ProgramPlanner planner_;
    SharedProgram program_;
    std::vector<Leg> legs_;
    std::size_t leg_ = 0;
    // Of the leg in progress; source_ is null if the leg has not begun.
    OwnedSource source_;
    PathPlace place_;
    MotorPositions positions_;
};

}  // namespace lockstep::verification
