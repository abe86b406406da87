// How much the axes' speeds change within short times, from samples of their places.
//
// Lockstep's promise for an axis is that over any time its speed changes by at most start velocity + acceleration *
// time. What is measured is the greatest change as a share of this. All planners are sampled in the same way.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "tests/benchmarks/planners/straight_moves.hpp"

namespace lockstep::planners {

struct Trapezoid;

inline constexpr double kSample_s = 1e-4;

/// Times over which changes are measured, in samples. A jump within a sample shows in two of them.
inline constexpr std::array<std::size_t, 3> kWindows{2, 50, 200};

/// The greatest change in each window, as a share of what the axis allows in it; the most of all axes.
using ChangeShares = std::array<double, kWindows.size()>;

class SpeedChanges {
public:
    /// At rest at `start`, in mm.
    SpeedChanges(const Limits& limits, const Vector& start) : limits_(limits), at_(start), speeds_(kKept) {}

    /// Where the axes are kSample_s later.
    void take(const Vector& place) {
        Vector& now = speeds_[taken_ % kKept];
        for (std::size_t i = 0; i < kAxes; ++i) { now[i] = (place[i] - at_[i]) / kSample_s; }
        at_ = place;
        for (std::size_t w = 0; w < kWindows.size(); ++w) { note(now, w); }
        ++taken_;
    }
    /// The axes rest where they are.
    void finish() {
        const Vector rest = at_;
        for (std::size_t n = 0; n < kKept; ++n) { take(rest); }
    }
    const ChangeShares& shares() const { return shares_; }

private:
    static constexpr std::size_t kKept = kWindows.back() + 1;

    void note(const Vector& now, std::size_t w) {
        const Vector& before = speeds_[(taken_ + kKept - kWindows[w]) % kKept];
        const double seconds = static_cast<double>(kWindows[w]) * kSample_s;
        for (std::size_t i = 0; i < kAxes; ++i) {
            const double allowed = limits_[i].start_velocity + limits_[i].acceleration * seconds;
            shares_[w] = std::max(shares_[w], std::abs(now[i] - before[i]) / allowed);
        }
    }

    Limits limits_;
    Vector at_;
    std::vector<Vector> speeds_;  // of the last samples, means; at first at rest
    std::size_t taken_ = 0;
    ChangeShares shares_{};
};

/// Of straight moves with their speeds.
ChangeShares changes_of(const std::vector<StraightMove>& moves, const std::vector<Trapezoid>& speeds,
                        const Limits& limits);

}  // namespace lockstep::planners
