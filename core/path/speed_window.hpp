// Look-ahead: how fast the path may be at each place, in a window that moves with the motion.
//
// Pieces of geometry go in at the end, and are cut into intervals. A backward pass from rest at the end of what is
// known finds each interval's `reach`. Where it meets the limit that the place itself has, nothing behind can change
// what is before: up to there it is final. So the result does not depend on when pieces arrived, bit for bit, and the
// window is as long as the way to rest needs. A pass runs when what is not final has doubled: amortized constant work
// for each piece.
//
// A joint of two pieces is a sudden change of each axis's speed by the difference of its slopes times the speed. It is
// at most kJointShare of the start velocity. Joints that follow each other faster than the acceleration recovers their
// jumps are paid for like curvature (core/motion/strain.hpp has the rule), or passed more slowly where that is faster.
#pragma once

#include <optional>

#include "core/path/interval.hpp"
#include "core/path/path_trail.hpp"
#include "core/path/sliding_vector.hpp"
#include "core/reused_queue.hpp"

namespace lockstep {

/// What becomes of new overrides.
enum class TurnResult : std::uint8_t {
    Taken,
    CannotFollow,  // the axes cannot, from this place
    LacksPath,     // too little of the path is known to say
};

class SpeedWindow {
public:
    /// The path begins at rest at `begin`, on the first piece that is added.
    explicit SpeedWindow(const PathSetup& setup, const Overrides& overrides = {}, const PathSpot& begin = {})
        : setup_(setup) {
        restart(overrides, begin);
    }
    /// As a new window. Its memory is kept.
    void restart(const Overrides& overrides, const PathSpot& begin);

    /// A piece that begins where the last one ends; length 0: a rest.
    void add(const Quadratic& piece);
    /// The path ends at rest where the last piece ends. Everything is final then.
    void finish();
    bool is_finished() const { return is_finished_; }

    /// Numbers since the beginning: intervals from first() up to end() are kept, those up to known() have a final end.
    std::size_t first() const { return first_; }
    std::size_t end() const { return first_ + intervals_.size(); }
    std::size_t known() const;
    const Interval& interval(std::size_t number) const { return intervals_[number - first_]; }
    /// The interval in which a spot is.
    std::size_t interval_at(const PathSpot& spot) const;
    const JoinedPiece& piece_of(const Interval& part) const { return pieces_[part.piece - first_piece_]; }
    const Quadratic& shape_of(const Interval& part) const { return piece_of(part).shape; }
    IntervalBounds bounds(const Interval& part) const { return {setup_, piece_of(part), part}; }
    /// The greatest w at the end of an interval from which all that follows can be kept.
    double reach_behind(std::size_t number) const;

    /// A straight interval begins at u from now on, at `w`.
    void cut(std::size_t number, double u, double w);
    /// Lowers the cap of an interval's beginning, or of the end of the path.
    void lower(std::size_t number, double cap);
    /// Finds reach anew for the intervals [first, last].
    void update(std::size_t first, std::size_t last);
    /// A straight interval takes longer, by a factor of the speed's square.
    void slow(std::size_t number, double slower);
    /// Forgets what is before an interval.
    void drop_before(std::size_t number);
    /// New overrides, from an interval's end where it `is_under_way`, else from its beginning; `w` is the speed there.
    /// Speeds that the hardest braking from there passes are allowed. A piece that was begun gets faster only if it can
    /// still recover the jumps at its ends. Unless they are taken, the window is of no use.
    TurnResult turn(const Overrides& overrides, std::size_t number, bool is_under_way, double w);

    static constexpr double kJointShare = 0.975;  // of the start velocity
    static constexpr double kMaxInterval_mm = 0.25;
    static constexpr double kMaxTurn = 0.06;        // rad within an interval
    static constexpr std::size_t kMaxOpen = 16384;  // intervals that are not final: half of more are made final

private:
    struct Joint {
        double cap = 0;  // w
        double turn = 0;
    };
    struct FastPassage;

    const Quadratic* before() const { return before_ ? &*before_ : nullptr; }
    void close_pending(const Quadratic* next);
    void close_end();
    bool is_passed(const Quadratic& piece, const Quadratic* next) const;
    Joint joint(const Quadratic* before, const Quadratic* after) const;
    FastPassage fast_passage(const JoinedPiece& piece, const Quadratic* before, const Quadratic* next) const;
    void charge(JoinedPiece& piece, const Quadratic* before, const Quadratic* next) const;
    void slow_joints(JoinedPiece& piece, const Quadratic* before, const Quadratic* next) const;
    bool is_slow_at_ends(const JoinedPiece& piece, const Joint& begin, const Quadratic* next) const;
    void cut_piece(const JoinedPiece& piece, const Joint& begin, const Quadratic* next);
    void look_ahead();
    bool may_rise(std::size_t piece) const;
    void turn_piece(std::size_t number, bool is_under_way);
    void recut_behind(std::size_t piece);
    TurnResult allow_braking(std::size_t number, double w);
    bool split_braking(std::size_t number, double w);

    PathSetup setup_;
    Overrides overrides_;
    double begin_u_ = 0;               // of the first piece: where the path begins
    ReusedQueue<JoinedPiece> pieces_;  // phases refer to them
    SlidingVector<Interval> intervals_;
    std::size_t first_ = 0;
    std::size_t first_piece_ = 0;
    std::optional<Quadratic> pending_;  // the last piece: what follows it is not known
    std::optional<Quadratic> before_;   // the piece before that
    ReusedQueue<Quadratic> ahead_;      // recut_behind: the pieces to be cut, the last one first
    std::size_t final_ = 0;             // intervals that are: all before
    std::size_t due_ = kLeastPass;      // a pass runs when so many are not
    double end_cap_ = 0;                // w at the end of the path, once it is finished
    bool is_finished_ = false;

    static constexpr std::size_t kLeastPass = 32;
    static constexpr double kMost = 1e6;            // w, or mm per tick^2, where no axis moves
    static constexpr double kLeastBegin_mm = 1e-9;  // less of the first piece than that is left out
};

}  // namespace lockstep
