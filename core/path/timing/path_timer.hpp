// Plans how long a path takes, and how far and how fast each axis goes, without frames.
//
// The moves are those of a PathPlanner. Geometry and look-ahead are the same, so the speeds at all places are those
// that the frames are made from. Frames add less than a tick at the path's end, and are slower where no pieces keep the
// limits of all axes (FramePlanner). The cost depends on the length of the path and not on its duration. The turns of
// an arc that repeat at the same speed are counted and not passed one by one.
#pragma once

#include <deque>

#include "core/path/path_input.hpp"
#include "core/path/timing/path_load.hpp"

namespace lockstep {

class PathTimer final : public PathInput {
public:
    explicit PathTimer(const PathSetup& setup) : PathInput(setup), window_(setup) {}

    /// Begins a path, to be followed by the moves of PathInput. The axes rest at `at`. Figures are added to `load`,
    /// which must outlive the path.
    void begin(std::span<const Position> at, const Overrides& overrides, PathLoad& load);
    /// The time of the path so far, without the part that waits for later moves. After finish() all of it.
    double ticks() const { return ticks_; }
    /// Intervals in memory.
    std::size_t waiting() const { return window_.end() - window_.first(); }

private:
    /// The begin of a turn of an arc, and its passage.
    struct Turn {
        std::size_t piece = 0;
        bool is_passed = false;
        double ticks = 0;
        double v = 0;
        std::int64_t first_steps = 0;  // of the plane's axes, up to there
        std::int64_t second_steps = 0;
    };

    void pass_on() override;
    void pass_arc() override;
    void end() override;
    void pass_known();
    double speed_behind(const Interval& part, IntervalBounds& bounds) const;
    Interval cruise(const Interval& part, std::size_t known);
    void pass(const Interval& part, double w1);
    void note_turn();
    void cut_turn();
    void skip_turns();

    SpeedWindow window_;
    PathLoad* load_ = nullptr;
    std::size_t passed_on_ = 0;  // pieces
    std::size_t next_ = 0;       // interval
    std::size_t piece_ = 0;      // with which it begins, if it begins a piece
    bool has_begun_ = false;
    double w_ = 0;  // the square of the speed where the next interval begins; v_ is the speed
    double v_ = 0;
    double ticks_ = 0;
    std::deque<Turn> turns_;  // of the arc that is being cut: the last two that were passed, and those to be passed
};

}  // namespace lockstep
