// Computes the change of speed at each joint of two pieces, and how much of the limits it uses.
//
// At a joint of two pieces each axis's speed jumps by the difference of its slopes times the speed along the path. The
// jump is at most kJointShare of the start velocity. If joints follow each other faster than the acceleration recovers
// their jumps, the jumps are charged like curvature (core/motion/strain.hpp has the rule). If it takes less time, the
// joints are slowed instead.
#pragma once

#include "core/path/interval.hpp"

namespace lockstep {

/// The greatest w at a joint, and the greatest jump of an axis there over its start velocity, per mm per tick.
struct Joint {
    double cap = 0;
    double jump = 0;
};

/// Where a piece begins and ends. A null neighbour means that the machine rests there.
struct Neighbours {
    const Quadratic* before = nullptr;
    const Quadratic* next = nullptr;
    double from = 0;  // the place on the piece where the path begins, if it begins there
    Joint begin;
    Joint end;

    /// The rows that move beside a piece.
    RowSet moving() const {
        return (before != nullptr ? before->moving : RowSet{}) | (next != nullptr ? next->moving : RowSet{});
    }
    bool follows() const { return before != nullptr && before->moves_on(); }
    bool goes_on() const { return next != nullptr && next->moves_on(); }
};

class PieceJoints {
public:
    /// Both must outlive it.
    PieceJoints(const PathSetup& setup, const Overrides& overrides) : setup_(setup), overrides_(overrides) {}

    /// The joint of two pieces. Null means that the machine rests there; then `after` begins at `from`.
    Joint joint(const Quadratic* before, const Quadratic* after, double from) const;
    /// Charges the joints of a piece, or slows them.
    void settle(JoinedPiece& piece, const Neighbours& beside) const;
    /// Charges the joints of a piece.
    void charge(JoinedPiece& piece, const Neighbours& beside) const;

    static constexpr double kJointShare = 0.975;  // of the start velocity
    static constexpr double kMost = 1e6;          // w, or mm per tick^2, if no axis moves

private:
    struct FastPassage;

    FastPassage fast_passage(const JoinedPiece& piece, const Neighbours& beside) const;
    void slow(JoinedPiece& piece, const Neighbours& beside) const;

    const PathSetup& setup_;
    const Overrides& overrides_;
};

}  // namespace lockstep
