// Look-ahead: the greatest speed at each place of the path, in a window that moves with the motion.
//
// Pieces of geometry are added at the end and cut into intervals. A backward pass from rest at the end of the known
// path finds each interval's `reach`. If that equals the limit of the place itself, later pieces cannot change anything
// before the place: all intervals up to there are final. So the result does not depend on when pieces arrived, bit for
// bit, and the window is as long as the stopping distance. A pass runs when the number of intervals that are not final
// has doubled: amortized constant work for each piece.
//
// At a joint of two pieces each axis's speed jumps by the difference of its slopes times the speed along the path. The
// jump is at most kJointShare of the start velocity. If joints follow each other faster than the acceleration recovers
// their jumps, the jumps are charged like curvature (core/motion/strain.hpp has the rule). If it takes less time, the
// joints are slowed instead.
#pragma once

#include <algorithm>
#include <optional>

#include "core/path/geometry/path_trail.hpp"
#include "core/path/interval.hpp"
#include "core/path/sliding_vector.hpp"
#include "core/reused_queue.hpp"

namespace lockstep {

/// The result of applying new overrides.
enum class OverrideResult : std::uint8_t {
    Taken,
    CannotFollow,  // the axes cannot follow from this place
    LacksPath,     // too little of the path is known to decide
};

class SpeedWindow {
public:
    explicit SpeedWindow(const PathSetup& setup) : setup_(setup) { restart({}, {}); }
    /// Resets it to a new window. Its memory is kept. The path begins at rest at `begin`, on the first piece that is
    /// added.
    void restart(const Overrides& overrides, const PathSpot& begin);

    /// Adds a piece that begins where the last one ends, in steps of the axes. A length of 0 is a rest.
    void add(const Quadratic& piece);
    /// Ends the path at rest at the end of the last piece. All intervals are then final.
    void finish();
    bool is_finished() const { return is_finished_; }

    /// Intervals are numbered from the beginning. Those from first() up to end() are stored, those up to known() have a
    /// final end.
    std::size_t first() const { return first_; }
    std::size_t end() const { return first_ + intervals_.size(); }
    std::size_t known() const;
    const Interval& interval(std::size_t number) const { return intervals_[number - first_]; }
    /// The interval that contains the place u of a piece.
    std::size_t interval_at(std::size_t piece, double u) const;
    const JoinedPiece& piece_of(const Interval& part) const { return pieces_[part.piece - first_piece_]; }
    const Quadratic& shape_of(const Interval& part) const { return piece_of(part).shape; }
    IntervalBounds bounds(const Interval& part) const { return {setup_, piece_of(part), part}; }
    /// The greatest w at the end of an interval from which all later limits can be kept.
    double reach_behind(std::size_t number) const;

    /// Moves the beginning of a straight interval to u, and sets w there.
    void cut(std::size_t number, double u, double w);
    /// Lowers the cap of an interval's beginning, or of the end of the path.
    void lower(std::size_t number, double cap);
    /// Computes `reach` again for the intervals [first, last].
    void update(std::size_t first, std::size_t last);
    /// Slows a straight interval: multiplies the square of its greatest speed by `slower`.
    void slow(std::size_t number, double slower);
    /// Drops everything before an interval.
    void drop_before(std::size_t number);
    /// Applies new overrides from an interval's end if it `is_under_way`, otherwise from its beginning; `w` is the
    /// squared speed there. Speeds during the hardest braking from there are allowed. A piece in progress gets faster
    /// only if it can still recover the jumps at its ends. Unless it returns Taken, the window must not be used again.
    OverrideResult set_overrides(const Overrides& overrides, std::size_t number, bool is_under_way, double w);

    static constexpr double kJointShare = 0.975;  // of the start velocity
    static constexpr double kMaxInterval_mm = 0.25;
    static constexpr double kMaxTurn = 0.06;        // rad within an interval
    static constexpr std::size_t kMaxOpen = 16384;  // intervals that are not final; at more, half are made final

private:
    struct Joint {
        double cap = 0;  // w
        double jump = 0;
    };
    /// Where a piece begins and ends. A null neighbour means that the machine rests there.
    struct Neighbours {
        const Quadratic* before = nullptr;
        const Quadratic* next = nullptr;
        Joint begin;
        Joint end;

        /// The rows that move beside a piece.
        AxisSet moving() const {
            return (before != nullptr ? before->moving : 0) | (next != nullptr ? next->moving : 0);
        }
        bool follows() const { return before != nullptr && before->length > 0; }
        bool goes_on() const { return next != nullptr && next->length > 0; }
    };
    struct FastPassage;

    /// Where the path begins on the first piece of the window.
    double begin_of(const Quadratic& piece) const { return std::max(begin_u_ - piece.begin, 0.0); }
    /// Where it begins on a piece.
    double begin_of(const Quadratic& piece, const Neighbours& beside) const {
        return beside.before == nullptr ? begin_of(piece) : 0;
    }
    void add_rows(const Quadratic& piece);
    void close_piece(std::size_t k);
    void close_end();
    const Quadratic* shape_at(std::size_t k) const { return k < pieces_.size() ? &pieces_[k].shape : nullptr; }
    bool is_passed(const Quadratic& piece, const Neighbours& beside) const;
    Joint joint(const Quadratic* before, const Quadratic* after) const;
    FastPassage fast_passage(const JoinedPiece& piece, const Neighbours& beside) const;
    void charge(JoinedPiece& piece, const Neighbours& beside) const;
    void slow_joints(JoinedPiece& piece, const Neighbours& beside) const;
    bool is_slow_at_ends(const JoinedPiece& piece, const Neighbours& beside) const;
    void cut_piece(std::size_t k, const Neighbours& beside);
    void look_ahead();
    bool may_rise(std::size_t piece) const;
    void turn_piece(std::size_t number, bool is_under_way);
    void recut_behind(std::size_t piece);
    OverrideResult allow_braking(std::size_t number, double w);
    bool split_braking(std::size_t number, double w);

    PathSetup setup_;
    Overrides overrides_;
    double begin_u_ = 0;               // where the path begins on the first piece of geometry
    ReusedQueue<JoinedPiece> pieces_;  // phases refer to them; the last one may be open: the next one is not known
    SlidingVector<Interval> intervals_;
    std::size_t first_ = 0;
    std::size_t first_piece_ = 0;
    bool is_open_ = false;
    std::optional<Joint> joint_;    // at the begin of the open piece, if it is known
    ReusedQueue<Quadratic> ahead_;  // recut_behind: the pieces to cut again, the last one first
    std::size_t final_ = 0;         // all intervals before this one are final
    std::size_t due_ = kLeastPass;  // a pass runs when this many are not final
    double end_cap_ = 0;            // w at the end of the path, once it is finished
    bool is_finished_ = false;

    static constexpr std::size_t kLeastPass = 32;
    static constexpr double kMost = 1e6;            // w, or mm per tick^2, if no axis moves
    static constexpr double kLeastBegin_mm = 1e-9;  // a shorter rest of the first piece is omitted
};

}  // namespace lockstep
