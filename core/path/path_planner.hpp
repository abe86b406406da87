// From a program's moves to frames: geometry, look-ahead and fit in time, as a stream.
//
// Moves go in with line(), arc(), rest() and finish(); frames come out of next(). Memory depends on the distance to
// stop, not on the program's length. The frames do not depend on when moves went in, only on where finish() was called.
#pragma once

#include <expected>
#include <optional>
#include <string>
#include <vector>

#include "core/path/arc_cutter.hpp"
#include "core/path/chord_joiner.hpp"
#include "core/path/frame_planner.hpp"

namespace lockstep {

class PathPlanner {
public:
    explicit PathPlanner(const PathSetup& setup);
    PathPlanner(const PathPlanner&) = delete;
    PathPlanner& operator=(const PathPlanner&) = delete;

    /// The axes rest at `at`.
    void begin(std::span<const Position> at);

    void line(const PathLine& line, const MoveSettings& settings, std::int32_t number);
    /// Error: the arc has no radius.
    std::expected<void, std::string> arc(const PathArc& arc, const MoveSettings& settings, std::int32_t number);
    /// The machine rests on whole steps for so long, at least for kLeastRest.
    void rest(Ticks ticks, std::int32_t number);
    /// The machine comes to rest on whole steps at the end of what was given.
    void finish();

    /// The next frame; nothing while too few moves are known. Not after the last one.
    std::expected<std::optional<PathFrame>, PathStuck> next() { return frames_.next(); }
    bool is_done() const { return frames_.is_done(); }
    std::int64_t slowed() const { return frames_.slowed(); }
    std::int64_t braked() const { return frames_.braked(); }
    /// Intervals that wait for their frames: what memory depends on.
    std::size_t waiting() const { return window_.end() - window_.first(); }

    static constexpr Ticks kLeastRest{64};

private:
    void come_to_rest();
    void pass_on();

    PathSetup setup_;
    ChordJoiner joiner_;
    SpeedWindow window_;
    FramePlanner frames_;
    AxisVector at_;                  // where the last move ends, steps
    std::vector<Quadratic> pieces_;  // made and not passed on: the last one, whose end may have to be a whole step
};

}  // namespace lockstep
