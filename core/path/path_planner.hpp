// Plans frames from a program's moves: geometry, look-ahead and fit in time, as a stream.
//
// line(), arc(), rest() and finish() take moves, next() returns frames. Memory depends on the stopping distance, not on
// the program's length. The frames do not depend on when moves were added, only on where finish() was called, and
// behind which frames the machine was resumed or the overrides were changed.
#pragma once

#include <expected>

#include "core/path/frame_planner.hpp"
#include "core/path/path_input.hpp"

namespace lockstep {

class PathPlanner final : public PathInput {
public:
    explicit PathPlanner(const PathSetup& setup);
    /// A copy continues in the same way.
    PathPlanner(const PathPlanner& other);
    PathPlanner& operator=(const PathPlanner&) = delete;

    /// Begins a path. The axes rest at `at`, on whole steps, and the motors where the map places them.
    void begin(std::span<const Position> at);
    /// The motors rest at `at`: the place of rest of one of the last kFramesKept frames, or the begin of the path. The
    /// next frame continues from there.
    ///
    /// Another planner that was begun at the begin of the stream's first move, and then gets the same moves, continues
    /// in the same way from any place. It makes no frames before that place.
    void resume(const PathPlace& place, std::span<const Position> at);

    /// The moves of PathInput, and the same with places in mm. An arc is only begun: call cut_on() while there are more
    /// pieces of it. So an arc of many turns can be planned in little memory.
    void line(const PathLine& line, const MoveSettings& settings, std::uint32_t block) {
        line_to_steps(setup_.to_steps(line.to_mm), settings, block);
    }
    bool has_more() const { return geometry_.has_more(); }
    /// Adds the next quarter turn of the arc, or its rest.
    void cut_on();
    /// Adds the whole arc.
    void arc(const PathArc& arc, const MoveSettings& settings, std::uint32_t block) {
        arc_to_steps(arc.shape, setup_.to_steps(arc.to_mm), settings, block);
    }
    void arc_to_steps(const ArcShape& shape, const PlaceVector& to, const MoveSettings& settings, std::uint32_t block);

    /// Applies new overrides from the end of the last frame on. Unless it returns Taken, the
    /// previous ones still hold. If it returns CannotFollow, the axes may be able to follow behind a later frame.
    OverrideResult set_overrides(const Overrides& overrides);
    const Overrides& overrides() const { return overrides_; }

    /// Returns the next frame, valid until the next call, or null while too few moves are known. Must not be called
    /// after the last frame.
    std::expected<const PathFrame*, PathStuck> next(FrameRoom* room = nullptr);
    /// Whether the next frame can be made.
    bool is_ready() { return frames_.is_ready(); }
    bool is_done() const { return frames_.is_done(); }
    /// The moves that begin in the last frame; valid directly after next() only.
    const std::vector<MoveBegin>& begins() const { return frames_.begins(); }
    const std::vector<MoveBegin>& tail_begins() const { return frames_.tail_begins(); }
    const FrameCounts& counts() const { return frames_.counts(); }
    /// Intervals that wait for their frames. Memory depends on these and on kept().
    std::size_t waiting() const { return window_.end() - window_.first(); }
    /// The place where the path continues has not been read yet.
    bool is_seeking() const { return is_sought_; }

    static constexpr std::size_t kFramesKept = 64;  // far more frames than can be in flight

private:
    void seek(const PathPlace& place);
    void pass_on() override;
    void end() override;
    void remember(const PathFrame& frame);

    PathSetup setup_;
    Overrides overrides_;
    SpeedWindow window_;
    FramePlanner frames_;
    PathPlace start_;         // where the path continues
    MotorPositions at_;       // the motors, there
    bool is_sought_ = false;  // start_ is not found on the geometry yet
    std::size_t passed_ = 0;  // pieces that were passed to the window
    bool is_finished_ = false;
    SlidingVector<std::size_t> begins_;  // the pieces in which the last frames begin
};

}  // namespace lockstep
