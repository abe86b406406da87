// The frames of a path by Lai's method (lai_path.hpp). The path is planned as a whole.
#pragma once

#include <vector>

#include "core/check.hpp"
#include "core/coordinator/path/frame_source.hpp"
#include "core/coordinator/path/lai_path.hpp"
#include "core/program_blocks.hpp"

namespace lockstep {

class LaiFrames final : public FrameSource {
public:
    /// `moves`: all moves of the program up to `end`.
    LaiFrames(const MachineConfig& machine, std::shared_ptr<const ProgramBlocks> program, std::vector<PathMove> moves,
              EventQueue events, const LegEnd& end);

    std::unique_ptr<FrameSource> clone() const override { return std::make_unique<LaiFrames>(*this); }
    /// A place counts the steps of the lead axes of its block's parts.
    void resume(const PathPlace& place, std::span<const Position> at, const Overrides& overrides) override;
    bool is_ready() override { return !is_done(); }
    bool is_done() const override { return made_ >= path_.duration().ceil(); }
    std::expected<const PathFrame*, PathStuck> next() override;
    const std::vector<MoveBegin>& begins() const override { return begins_; }
    bool set_overrides(const Overrides&) override { return false; }
    LegEnd end() const override { return end_; }
    std::span<const FrameEvent> events() const override { return due_; }
    void begin_events_from(std::uint32_t block) override { events_.begin_from(block); }
    std::span<const PathEvent> events_before(std::uint32_t block) const override { return events_.before(block); }
    std::optional<std::int32_t> line_of(std::uint32_t block) const override {
        return check_found(program_->block(block), "a block of a path that runs is known").line;
    }
    double seconds_from(const PathPlace& place) const override;

private:
    struct Spot {
        std::size_t move = 0;
        Displacement along;
    };

    /// The distance along a block up to the first part of it that is left.
    Displacement before(std::uint32_t block) const { return block == passed_.block ? passed_.along : Displacement{}; }
    Spot spot_of(const PathPlace& place) const;
    PathPlace place_of(const PathMove& move, Displacement along) const;
    PathPlace place_at(Ticks t) const;
    void note_begins();
    PathPlace fill_tail(PathFrame& frame, MotorPositions at);

    MachineConfig machine_;
    std::shared_ptr<const ProgramBlocks> program_;
    EventQueue events_;
    LegEnd end_;
    std::vector<AxisLimits> limits_;
    std::vector<double> steps_per_mm_;
    Path path_;
    PathPlace passed_;
    Ticks made_;  // duration of the frames made so far
    Ticks last_;  // duration of the last frame
    MotorPositions at_;
    PathFrame frame_;                // the last frame
    std::vector<MoveBegin> begins_;  // moves that begin in it
    std::vector<FrameEvent> due_;    // events due in it
    Path tail_;                      // behind it
    std::vector<Piece> pieces_;      // of a stretch of it, one for each axis
};

}  // namespace lockstep
