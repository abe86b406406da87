// The frames of a program's moves by core/path: the program is read as a stream, a bounded amount in each slot.
#pragma once

#include "core/coordinator/path/frame_source.hpp"
#include "core/coordinator/path/program_plan.hpp"
#include "core/path/path_planner.hpp"

namespace lockstep {

class ProgramFrames final : public FrameSource {
public:
    ProgramFrames(const MachineConfig& machine, std::shared_ptr<const Program> program, const Leg& leg);

    std::unique_ptr<FrameSource> clone() const override { return std::make_unique<ProgramFrames>(*this); }
    void resume(const PathPlace& place, std::span<const Position> at, const Overrides& overrides) override;
    void read() override;
    bool is_ready() override { return planner_.is_ready(); }
    bool is_done() const override { return planner_.is_done(); }
    std::expected<std::optional<PathFrame>, PathStuck> next() override { return planner_.next(); }
    std::vector<MoveBegin> begins() const override { return planner_.begins(); }
    /// Reads as much more as deciding takes, so that the answer does not depend on what was read before.
    bool turn(const Overrides& overrides) override;
    double seconds_from(const PathPlace& place) const override;

    static constexpr std::size_t kBlocksAtOnce = 200;  // a fraction of a millisecond of work
    static constexpr std::size_t kReserve = 4096;  // intervals: when so many wait for their frames, no more are read

private:
    void read_block();

    std::shared_ptr<const Program> program_;
    std::vector<AxisLimits> limits_;
    std::vector<double> steps_per_mm_;
    std::vector<std::size_t> axes_;  // of the machine: those that the program names
    Leg leg_;
    double tick_s_ = 0;
    std::uint32_t next_ = 0;  // the block to be read
    bool is_finished_ = false;
    AxisVector at_;  // where the last block read leads to
    PathPlanner planner_;
};

}  // namespace lockstep
