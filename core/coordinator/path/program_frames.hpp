// The frames of a program's moves by core/path. The program is read as a stream, a bounded amount in each slot.
#pragma once

#include "core/coordinator/path/frame_source.hpp"
#include "core/coordinator/path/program_plan.hpp"
#include "core/path/path_planner.hpp"
#include "core/path/sliding_vector.hpp"

namespace lockstep {

class ProgramFrames final : public FrameSource {
public:
    ProgramFrames(const MachineConfig& machine, const std::shared_ptr<const ProgramBlocks>& program,
                  std::uint32_t first, const AxisCounts& from);

    std::unique_ptr<FrameSource> clone() const override { return std::make_unique<ProgramFrames>(*this); }
    bool begin(const std::shared_ptr<const ProgramBlocks>& program, std::span<const std::size_t> axes,
               std::uint32_t first, const AxisCounts& from) override;
    void resume(const PathPlace& place, std::span<const Position> at, const Overrides& overrides) override;
    bool read() override;
    bool lacks_blocks() override { return is_starved_ && !planner_.is_ready() && !is_done(); }
    bool is_ready() override { return planner_.is_ready(); }
    bool is_done() const override { return planner_.is_done(); }
    std::expected<const PathFrame*, PathStuck> next() override;
    const std::vector<MoveBegin>& begins() const override { return planner_.begins(); }
    /// Reads as many blocks as the decision needs, so that the answer does not depend on what was read before.
    bool turn(const Overrides& overrides) override;
    LegEnd end() const override { return {end_, next_, to_}; }
    std::span<const FrameEvent> events() const override { return due_; }
    void begin_events_from(std::uint32_t block) override { events_.begin_from(block); }
    std::span<const PathEvent> events_before(std::uint32_t block) const override { return events_.before(block); }
    std::optional<std::int32_t> line_of(std::uint32_t block) const override;
    double seconds_from(const PathPlace& place) const override { return program_->seconds_from(place); }

    static constexpr std::size_t kBlocksAtOnce = 200;   // a fraction of a millisecond of work
    static constexpr std::size_t kBlocksPassed = 2000;  // at once if they were run before, which is less work
    static constexpr std::size_t kReserve = 4096;  // intervals: while this many wait for their frames, no more are read

private:
    bool read_block();
    bool begin_at_place();
    void finish(LegEnd::Kind end);
    void read_move(const ProgramMove& move, std::uint32_t number);
    void forget_lines(const PathFrame& frame);

    std::shared_ptr<const ProgramBlocks> program_;
    std::vector<double> steps_per_mm_;
    std::vector<std::size_t> axes_;  // the machine's axes that the program names
    double tick_s_ = 0;
    std::uint32_t next_ = 0;  // the next block to read
    std::uint32_t resumed_ = 0;
    bool has_moved_ = false;  // a move of the leg was read
    bool is_finished_ = false;
    LegEnd::Kind end_ = LegEnd::Kind::Program;
    bool is_starved_ = false;                           // the next block was not at hand
    AxisCounts to_;                                     // where the last block read leads to, whole steps
    SlidingVector<std::optional<std::int32_t>> lines_;  // lines of the blocks before the next one
    SlidingVector<std::uint32_t> begins_;               // the blocks in which the last frames begin
    EventQueue events_;
    std::vector<FrameEvent> due_;  // events in the last frame
    AxisVector at_;                // where the last block read leads to
    PathPlanner planner_;
};

}  // namespace lockstep
