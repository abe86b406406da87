// The frames of a program's moves by core/path. The program is read as a stream, a bounded amount in each slot.
#pragma once

#include "core/coordinator/path/event_room.hpp"
#include "core/coordinator/path/frame_source.hpp"
#include "core/coordinator/path/program_moves.hpp"
#include "core/path/path_planner.hpp"
#include "core/path/sliding_vector.hpp"

namespace lockstep {

class ProgramFrames final : public FrameSource, private FrameRoom {
public:
    ProgramFrames(const MachineConfig& machine, const std::shared_ptr<const ProgramBlocks>& program,
                  std::uint32_t first, const AxisCounts& from);

    std::unique_ptr<FrameSource> clone() const override { return std::make_unique<ProgramFrames>(*this); }
    bool begin(const std::shared_ptr<const ProgramBlocks>& program, std::span<const AxisIndex> axes,
               std::uint32_t first, const AxisCounts& from) override;
    void resume(const PathPlace& place, std::span<const Position> at, const Overrides& overrides) override;
    bool read() override;
    bool lacks_blocks() override { return moves_.is_starved() && !planner_.is_ready() && !is_done(); }
    bool is_ready() override { return planner_.is_ready(); }
    bool is_done() const override { return planner_.is_done(); }
    std::expected<const PathFrame*, PathStuck> next() override;
    const std::vector<MoveBegin>& begins() const override { return planner_.begins(); }
    /// Reads as many blocks as the decision needs, so that the answer does not depend on what was read before.
    bool set_overrides(const Overrides& overrides) override;
    LegEnd end() const override { return moves_.end(); }
    std::span<const FrameEvent> events() const override { return due_; }
    std::span<const FrameEvent> tail_events() const override { return due_in_tail_; }
    void begin_events_from(std::uint32_t block) override { events_.begin_from(block); }
    std::span<const PathEvent> events_before(std::uint32_t block) const override { return events_.before(block); }
    std::optional<std::int32_t> line_of(std::uint32_t block) const override;
    double seconds_from(const PathPlace& place) const override { return moves_.program().seconds_from(place); }
    /// Intervals and pieces in memory.
    std::size_t kept() const { return planner_.waiting() + planner_.kept(); }

    static constexpr std::size_t kBlocksAtOnce = 200;   // or quarter turns: a fraction of a millisecond
    static constexpr std::size_t kBlocksPassed = 2000;  // at once if they were run before, which is less work
    static constexpr std::size_t kReserve = 4096;  // intervals: while this many wait for their frames, no more are read

private:
    bool read_block();
    bool has_room(std::span<const MoveBegin> body, std::span<const MoveBegin> tail, bool is_last) override;
    void forget_lines(const PathFrame& frame);

    ProgramMoves moves_;
    std::uint32_t resumed_ = 0;
    bool is_finished_ = false;
    SlidingVector<std::optional<std::int32_t>> lines_;  // lines of the blocks before the next one
    SlidingVector<std::uint32_t> begins_;               // the blocks in which the last frames begin
    EventQueue events_;
    std::vector<FrameEvent> due_;  // events in the last frame
    std::vector<FrameEvent> due_in_tail_;
    EventRoom room_;
    PathPlanner planner_;
};

}  // namespace lockstep
