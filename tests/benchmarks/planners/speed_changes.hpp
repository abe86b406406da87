// How much the axes' speeds change within short times, from samples of their places.
//
// Lockstep promises that within a time t the speed of an axis changes by at most start velocity + acceleration * t. The
// result is the greatest change as a share of this. All planners are sampled in the same way.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "tests/benchmarks/planners/straight_moves.hpp"

namespace lockstep::planners {

struct Trapezoid;

inline constexpr double kSample_s = 1e-4;

/// The times over which changes are measured, in samples. A jump within a sample affects two samples.
inline constexpr std::array<std::size_t, 3> kWindows{2, 50, 200};

/// The greatest change in each window, as a share of what the axis allows in it; the most of all axes.
using ChangeShares = std::array<double, kWindows.size()>;

class SpeedChanges {
public:
    /// The axes rest at `start`, in mm.
    SpeedChanges(const Limits& limits, const Vector& start) : limits_(limits), at_(start), speeds_(kKept) {}

    /// Takes the axes' places kSample_s after those before.
    void take(const Vector& place) {
        Vector& now = speeds_[taken_ % kKept];
        for (std::size_t i = 0; i < kAxes; ++i) { now[i] = (place[i] - at_[i]) / kSample_s; }
        at_ = place;
        for (std::size_t w = 0; w < kWindows.size(); ++w) { note(now, w); }
        ++taken_;
    }
    /// Takes the end of the motion: the axes rest where they are.
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
    std::vector<Vector> speeds_;  // mean speeds of the last samples; at first 0
    std::size_t taken_ = 0;
    ChangeShares shares_{};
};

/// The changes of straight moves with these speeds.
ChangeShares changes_of(const std::vector<StraightMove>& moves, const std::vector<Trapezoid>& speeds,
                        const Limits& limits);

}  // namespace lockstep::planners
