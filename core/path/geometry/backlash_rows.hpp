// The rows of a path whose motors take up backlash.
//
// A motor pushes its slide with one side of the play. Where its direction changes, a piece of rows is inserted in which
// this motor alone moves, by its play, and the path's place stays where it is. So the look-ahead treats it as a corner,
// and limits, tails, holds and overrides need nothing else. A curve is cut where the direction of such a motor changes.
//
// A motor that goes back by no more than kSlack does not take up its play yet: its slide stays behind by so much.
#pragma once

#include <span>
#include <vector>

#include "core/motion/path.hpp"
#include "core/path/geometry/quadratic.hpp"
#include "core/path/path_setup.hpp"

namespace lockstep {

class BacklashRows {
public:
    /// The next path begins at `begin_mm` of its first piece, where the motors rest at these places. Empty: where the
    /// map places them.
    void restart(double begin_mm, std::span<const Position> motors);
    /// The rows of the next piece of the axes, in order. Valid until the next call.
    const std::vector<Quadratic>& rows_of(const PathSetup& setup, const Quadratic& axes);

    static constexpr double kSlack = 0.2;  // steps

private:
    /// Of a motor.
    struct Side {
        double play = 0;    // its place minus its slide's
        double turned = 0;  // the place of its slide that is farthest in the direction in which it was pushed last
    };

    void find_sides(const PathSetup& setup, const Quadratic& slides, double begin);
    void find_cuts(const PathSetup& setup, const Quadratic& axes);
    void add_part(const PathSetup& setup, const Quadratic& axes, double from, double to);
    bool push_all(const PathSetup& setup, const Quadratic& slides, double begin);
    static bool push(const MotorBacklash& motor, Side& side, double from, double to);
    void add(const Quadratic& slides, const std::vector<Side>& sides);
    void add_take_up(const PathSetup& setup, const Quadratic& next, const std::vector<Side>& before);

    std::vector<double> at_;
    double begin_mm_ = 0;
    bool begins_ = true;
    std::vector<Side> sides_;
    std::vector<Side> before_;
    std::vector<double> cuts_;
    std::vector<Quadratic> rows_;
};

}  // namespace lockstep
