// Plans a job again from its record: the epochs it has, given how each of them ended.
#pragma once

#include <expected>
#include <optional>
#include <string>
#include <vector>

#include "core/coordinator/path/epoch_runner.hpp"
#include "core/coordinator/path/program_plan.hpp"
#include "core/machine.hpp"
#include "core/program.hpp"

namespace lockstep::verification {

/// The start of an epoch.
struct EpochStart {
    Path path;
    std::vector<Position> at;  // of each axis, exactly
    PathPlace place;           // on the program
};

class JobReplay {
public:
    /// `start_counts`: one per axis of the machine. Error: the program cannot be planned from there.
    static std::expected<JobReplay, std::string> plan(const MachineConfig& machine, const Program& program,
                                                      const std::vector<std::int64_t>& start_counts);

    const MachineConfig& machine() const { return machine_; }

    /// The next epoch, planned with these overrides; none: the program is done.
    std::optional<EpochStart> next(const Overrides& overrides = {}) const;

    /// How an epoch with this path ended: Complete or Interrupted.
    void ended(const Path& path, const EpochEnd& end);

private:
    JobReplay(const MachineConfig& machine, std::vector<Leg> legs);
    void skip_empty_legs();

    MachineConfig machine_;
    ProgramPlanner planner_;
    std::vector<Leg> legs_;
    std::size_t leg_ = 0;
    // The part of its leg that an interrupted epoch left.
    std::vector<PathMove> remaining_;
    Displacement along_;
    std::vector<Position> positions_;
};

}  // namespace lockstep::verification
