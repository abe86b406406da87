// Plans frames from a program's moves: geometry, look-ahead and fit in time, as a stream.
//
// line(), arc(), rest() and finish() take moves, next() returns frames. Memory depends on the stopping distance, not on
// the program's length. The frames do not depend on when moves were added, only on where finish() was called, and
// behind which frames the machine was resumed or the overrides were changed.
#pragma once

#include <expected>

#include "core/path/arc_cutter.hpp"
#include "core/path/chord_joiner.hpp"
#include "core/path/frame_planner.hpp"
#include "core/path/path_trail.hpp"

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
    void begin_program_at(const AxisVector& steps) { programmed_ = steps; }
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
    std::size_t kept() const { return trail_.end() - trail_.first(); }

    static constexpr Ticks kLeastRest{64};
    static constexpr std::size_t kFramesKept = 64;  // far more frames than can be in flight

private:
    void seek(const PathPlace& place);
    void come_to_rest();
    bool move_end(const AxisVector& end);
    void pass_on(std::size_t ready);
    void pass_on_but_last();
    void remember(const PathFrame& frame);

    PathSetup setup_;
    Overrides overrides_;
    ChordJoiner joiner_;
    PathTrail trail_;
    SpeedWindow window_;
    FramePlanner frames_;
    AxisVector at_;           // where the last move ends, in steps; whole ones if the machine rests there
    AxisVector programmed_;   // where it ends in the program, up to half a step beyond the travel
    PathPlace start_;         // where the path continues
    bool is_sought_ = false;  // start_ is not found on the geometry yet
    std::size_t ready_ = 0;   // pieces that are final; the last piece's end may still move to a whole step
    std::size_t passed_ = 0;  // pieces that were passed to the window
    bool is_finished_ = false;
    SlidingVector<std::size_t> begins_;  // the pieces in which the last frames begin
};

}  // namespace lockstep
