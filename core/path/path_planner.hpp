// From a program's moves to frames: geometry, look-ahead and fit in time, as a stream.
//
// Moves go in with line(), arc(), rest() and finish(); frames come out of next(). Memory depends on the distance to
// stop, not on the program's length. The frames do not depend on when moves went in, only on where finish() was called
// and behind which frames the machine was resumed or the overrides were turned.
#pragma once

#include <expected>
#include <optional>

#include "core/path/arc_cutter.hpp"
#include "core/path/chord_joiner.hpp"
#include "core/path/frame_planner.hpp"
#include "core/path/path_trail.hpp"

namespace lockstep {

class PathPlanner {
public:
    explicit PathPlanner(const PathSetup& setup);
    /// A copy goes on in the same way.
    PathPlanner(const PathPlanner& other);
    PathPlanner& operator=(const PathPlanner&) = delete;

    /// The axes rest at `at`.
    void begin(std::span<const Position> at);
    /// Where the program has the axes at the begin, which is less than a step from where they rest. An arc needs it.
    void begin_program_at(const AxisVector& steps) { programmed_ = steps; }
    /// The axes rest at `at`, where one of the last kFramesKept frames rests, or where the path begins. The next frame
    /// goes on from there.
    ///
    /// A planner that was begun where the first of the stream's moves begins, and then gets these moves, goes on in the
    /// same way from any place: it makes no frames up to there.
    void resume(const PathPlace& place, std::span<const Position> at);

    /// `block`: the move's number in its program; they ascend.
    void line(const PathLine& line, const MoveSettings& settings, std::uint32_t block) {
        line_to_steps(setup_.to_steps(line.to_mm), settings, block);
    }
    /// To a place in steps, or fractions of them. Moves end within the travel. The program's places may be up to half a
    /// step beyond it: they decide the shape of an arc.
    void line_to_steps(const AxisVector& to, const MoveSettings& settings, std::uint32_t block);
    void arc(const PathArc& arc, const MoveSettings& settings, std::uint32_t block) {
        arc_to_steps(arc.shape, setup_.to_steps(arc.to_mm), settings, block);
    }
    void arc_to_steps(const ArcShape& shape, const AxisVector& to, const MoveSettings& settings, std::uint32_t block);
    /// The machine rests on whole steps for so long, at least for kLeastRest.
    void rest(Ticks ticks, std::uint32_t block);
    /// The machine comes to rest on whole steps at the end of what was given.
    void finish();

    /// New overrides, from the next node of the path behind the last frame. Unless they are taken, the ones before
    /// still hold; where the axes cannot follow from there, they may behind a later frame.
    TurnResult turn(const Overrides& overrides);
    const Overrides& overrides() const { return overrides_; }

    /// The next frame, valid until the next call; null while too few moves are known. Not after the last one.
    std::expected<const PathFrame*, PathStuck> next();
    /// The next frame can be made.
    bool is_ready() { return frames_.is_ready(); }
    bool is_done() const { return frames_.is_done(); }
    /// The moves that begin in the last frame; right behind next() only.
    const std::vector<MoveBegin>& begins() const { return frames_.begins(); }
    std::int64_t slowed() const { return frames_.slowed(); }
    std::int64_t braked() const { return frames_.braked(); }
    /// Intervals that wait for their frames, and pieces that are kept: what memory depends on.
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
    AxisVector at_;           // where the last move ends, steps: whole ones where the machine rests
    AxisVector programmed_;   // where it ends by the program: up to half a step beyond the travel
    PathPlace start_;         // where the path goes on,
    bool is_sought_ = false;  // which is not known on the geometry yet
    std::size_t ready_ = 0;   // pieces that do not change: the last one's end may have to be a whole step
    std::size_t passed_ = 0;  // and that the window has
    bool is_finished_ = false;
    SlidingVector<std::size_t> begins_;  // the pieces in which the last frames begin
};

}  // namespace lockstep
