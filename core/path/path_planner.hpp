// Plans frames from a program's moves: geometry, look-ahead and fit in time, as a stream.
//
// line(), arc(), rest() and finish() take moves, next() returns frames. Memory depends on the stopping distance, not on
// the program's length. The frames do not depend on when moves were added, only on where finish() was called, and
// behind which frames the machine was resumed or the overrides were changed.
#pragma once

#include <expected>

#include "core/path/frame_planner.hpp"
#include "core/path/path_geometry.hpp"

namespace lockstep {

class PathPlanner {
public:
    explicit PathPlanner(const PathSetup& setup);
    /// A copy continues in the same way.
    PathPlanner(const PathPlanner& other);
    PathPlanner& operator=(const PathPlanner&) = delete;

    /// Begins a path. The axes rest at `at`.
    void begin(std::span<const Position> at);
    /// Sets the programmed place at the begin, which is less than a step from the place of rest. Arcs need it.
    void begin_program_at(const AxisVector& steps) { geometry_.begin_program_at(steps); }
    /// The axes rest at `at`: the place of rest of one of the last kFramesKept frames, or the begin of the path. The
    /// next frame continues from there.
    ///
    /// Another planner that was begun at the begin of the stream's first move, and then gets the same moves, continues
    /// in the same way from any place. It makes no frames before that place.
    void resume(const PathPlace& place, std::span<const Position> at);

    /// `block`: the move's number in its program. Numbers ascend.
    void line(const PathLine& line, const MoveSettings& settings, std::uint32_t block) {
        line_to_steps(setup_.to_steps(line.to_mm), settings, block);
    }
    /// `to` is in steps, also fractional ones. Moves end within the travel. Programmed places may be up to half a step
    /// beyond it; they determine the shape of an arc.
    void line_to_steps(const AxisVector& to, const MoveSettings& settings, std::uint32_t block);
    void arc(const PathArc& arc, const MoveSettings& settings, std::uint32_t block) {
        arc_to_steps(arc.shape, setup_.to_steps(arc.to_mm), settings, block);
    }
    void arc_to_steps(const ArcShape& shape, const AxisVector& to, const MoveSettings& settings, std::uint32_t block);
    /// The same, but only begins the arc. Call cut_on() while there are more pieces of it. So an arc of many turns can
    /// be planned in little memory. The next move cuts what is left of it.
    void begin_arc_to_steps(const ArcShape& shape, const AxisVector& to, const MoveSettings& settings,
                            std::uint32_t block);
    bool has_more() const { return geometry_.has_more(); }
    /// Adds the next quarter turn of the arc, or its rest.
    void cut_on();
    /// The machine rests on whole steps for `ticks`, at least for kLeastRest.
    void rest(Ticks ticks, std::uint32_t block);
    /// Ends the path: the machine comes to rest on whole steps at the end of the last move.
    void finish();

    /// Applies new overrides from the next node of the path behind the last frame on. Unless it returns Taken, the
    /// previous ones still hold. If it returns CannotFollow, the axes may be able to follow behind a later frame.
    TurnResult turn(const Overrides& overrides);
    const Overrides& overrides() const { return overrides_; }

    /// Returns the next frame, valid until the next call, or null while too few moves are known. Must not be called
    /// after the last frame.
    std::expected<const PathFrame*, PathStuck> next();
    /// Whether the next frame can be made.
    bool is_ready() { return frames_.is_ready(); }
    bool is_done() const { return frames_.is_done(); }
    /// The moves that begin in the last frame; valid directly after next() only.
    const std::vector<MoveBegin>& begins() const { return frames_.begins(); }
    std::int64_t slowed() const { return frames_.slowed(); }
    std::int64_t braked() const { return frames_.braked(); }
    /// Intervals that wait for their frames, and stored pieces. Memory depends on these.
    std::size_t waiting() const { return window_.end() - window_.first(); }
    std::size_t kept() const { return geometry_.trail().end() - geometry_.trail().first(); }
    /// The place where the path continues has not been read yet.
    bool is_seeking() const { return is_sought_; }

    static constexpr Ticks kLeastRest = PathGeometry::kLeastRest;
    static constexpr std::size_t kFramesKept = 64;  // far more frames than can be in flight

private:
    void seek(const PathPlace& place);
    void pass_on();
    void remember(const PathFrame& frame);

    PathSetup setup_;
    Overrides overrides_;
    PathGeometry geometry_;
    SpeedWindow window_;
    FramePlanner frames_;
    PathPlace start_;         // where the path continues
    bool is_sought_ = false;  // start_ is not found on the geometry yet
    std::size_t passed_ = 0;  // pieces that were passed to the window
    bool is_finished_ = false;
    SlidingVector<std::size_t> begins_;  // the pieces in which the last frames begin
};

}  // namespace lockstep
