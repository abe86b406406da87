// Cuts pieces into intervals.
#pragma once

#include "core/path/piece_joints.hpp"
#include "core/path/sliding_vector.hpp"

namespace lockstep {

class IntervalCut {
public:
    /// Both must outlive it.
    IntervalCut(const PathSetup& setup, const Overrides& overrides) : setup_(setup), overrides_(overrides) {}

    /// Appends the intervals of the piece with this number.
    void cut(const JoinedPiece& piece, std::size_t number, const Neighbours& beside,
             SlidingVector<Interval>& intervals) const;

    static constexpr double kMaxInterval_mm = 0.25;
    static constexpr double kMaxDirectionChange = 0.06;  // rad within an interval

private:
    static IntervalKind kind_of(const JoinedPiece& piece);
    Interval whole(const JoinedPiece& piece, const Neighbours& beside) const;
    std::size_t parts_of(const JoinedPiece& piece, const Neighbours& beside, IntervalBounds& whole) const;

    const PathSetup& setup_;
    const Overrides& overrides_;
};

}  // namespace lockstep
