#include "core/path/speed_window.hpp"

#include <algorithm>
#include <cmath>

#include "core/path/geometry/motor_rows.hpp"

namespace lockstep {
namespace {

constexpr double kRounding = 1e-11;  // of w: far more than the rounding of a backward pass
constexpr double kStopShare = 0.8;   // of the start velocity, where the path begins or ends: a joint may follow
constexpr double kRestShare = 0.4;   // of the start velocity, at a short rest, where two jumps follow each other
constexpr double kWorthSlowing = 2;  // least gain, because the adjacent pieces become slower too
constexpr int kMostHalves = 40;
constexpr std::size_t kLeastParts = 4;  // of a piece that may be faster than the joints at its ends

/// The angle by which a piece turns over `length`, rad.
double turn_of(const Quadratic& piece, double length, const PathSetup& setup) {
    double square = 0;
    each_of(piece.moving >> setup.first_axis_row(), [&](std::size_t i) {
        const double bend = piece.bend.begin()[setup.first_axis_row() + i] / setup.steps_per_mm[i];
        square += bend * bend;
    });
    return std::sqrt(square) * length;
}

}  // namespace

void SpeedWindow::restart(const Overrides& overrides, const PathSpot& begin) {
    overrides_ = overrides;
    begin_u_ = begin.u;
    first_piece_ = begin.piece;
    pieces_.clear();
    intervals_.clear();
    first_ = final_ = 0;
    is_open_ = false;
    joint_.reset();
    due_ = kLeastPass;
    end_cap_ = 0;
    is_finished_ = false;
}

void SpeedWindow::add(const Quadratic& piece) {
    if (!setup_.has_map()) { return add_rows(piece); }
    for (RowPieces rows(setup_, piece); !rows.is_done();) { add_rows(rows.next()); }
}

void SpeedWindow::add_rows(const Quadratic& piece) {
    JoinedPiece& open = pieces_.reuse_back();
    open.shape = piece;
    open.shape.moving = moving_rows(piece);
    open.begin_cap = open.end_cap = JoinedPiece::kNoCap;
    open.is_charged = false;
    if (is_open_) { close_piece(pieces_.size() - 2); }
    is_open_ = true;
    if (end() - final_ >= due_) { look_ahead(); }
}

void SpeedWindow::finish() {
    close_end();
    look_ahead();
    final_ = end();
}

void SpeedWindow::close_end() {
    if (is_open_) {
        end_cap_ = joint(&pieces_.back().shape, nullptr).cap;
        close_piece(pieces_.size() - 1);
    }
    is_open_ = false;
    is_finished_ = true;
}

/// The joint of two pieces. Null means that the machine rests there.
SpeedWindow::Joint SpeedWindow::joint(const Quadratic* before, const Quadratic* after) const {
    Joint joint{kMost, 0};
    const bool is_stop = before == nullptr || after == nullptr;
    const bool is_rest = (before != nullptr && before->length == 0) || (after != nullptr && after->length == 0);
    each_of(Neighbours{before, after, {}, {}}.moving(), [&](std::size_t i) {
        const double t0 = before == nullptr || before->length == 0 ? 0 : before->slope_at(i, before->length);
        const double t1 =
            after == nullptr || after->length == 0 ? 0 : after->slope_at(i, before == nullptr ? begin_of(*after) : 0);
        const double jump = std::abs(t1 - t0);
        if (jump < kNothing) { return; }
        const double start = setup_.limits[i].start_velocity;
        const double share = is_rest && !is_stop ? kRestShare : is_stop ? kStopShare : kJointShare;
        const double speed = share * start / jump;
        joint.cap = std::min(joint.cap, speed * speed);
        joint.jump = std::max(joint.jump, jump / start);
    });
    return joint;
}

/// The passage of a piece at the greatest speed by limits and joints. It tells which jumps a straight piece can
/// recover.
struct SpeedWindow::FastPassage {
    double v0 = 0;  // mm per tick
    double v1 = 0;
    double rise = 0;  // ticks
    double cruise = 0;
    double fall = 0;
    double acceleration = 0;  // mm per tick^2

    FastPassage(double w0, double w1, double top, double a, const Interval& whole) : acceleration(a) {
        const double length = whole.length();
        const double most_change = 2 * a * length;
        w0 = std::min(w0, w1 + most_change);
        w1 = std::min(w1, w0 + most_change);
        v0 = std::sqrt(w0);
        v1 = std::sqrt(w1);
        if (whole.kind != IntervalKind::Straight) { return; }
        const double peak = std::sqrt(std::max({std::min((w0 + w1) / 2 + a * length, top), w0, w1}));
        rise = (peak - v0) / a;
        fall = std::max(peak - v1, 0.0) / a;
        cruise = std::max(0.0, length - (v0 + peak) / 2 * rise - (v1 + peak) / 2 * fall) / peak;
    }

    double ticks() const { return rise + cruise + fall; }

    /// The jumps up (or down), in steps per tick, from which an axis of this slope and acceleration limit recovers.
    double recovers(double slope, double limit, bool is_up) const {
        const double along = (is_up ? slope : -slope) * acceleration;
        return (limit - along) * rise + limit * cruise + (limit + along) * fall;
    }
};

SpeedWindow::FastPassage SpeedWindow::fast_passage(const JoinedPiece& piece, const Neighbours& beside) const {
    const Quadratic& shape = piece.shape;
    const double from = begin_of(shape, beside);
    const IntervalKind kind = shape.is_straight ? IntervalKind::Straight : IntervalKind::Curved;
    const Interval whole{.kind = kind, .from = from, .to = shape.length};
    const double top = IntervalBounds(setup_, piece, whole).cap(overrides_);
    double path_acceleration = kMost;
    each_of(shape.moving, [&](std::size_t i) {
        const double slope = std::abs(shape.slope.begin()[i]);
        if (slope > kNothing) { path_acceleration = std::min(path_acceleration, weaker(setup_.limits[i]) / slope); }
    });
    const double w0 = std::min({beside.begin.cap, top, piece.begin_cap});
    const double w1 = std::min({beside.end.cap, top, piece.end_cap});
    return {w0, w1, top, path_acceleration, whole};
}

/// Jumps from and to rest are not counted here. Each piece recovers half of the other jumps at its ends, so that jumps
/// never add up to more than one. If the piece is too short for that on an axis, the turns of its joints are charged as
/// bend of this axis, spread over the piece.
void SpeedWindow::charge(JoinedPiece& piece, const Neighbours& beside) const {
    const Quadratic* const before = beside.before;
    const Quadratic* const next = beside.next;
    const Quadratic& shape = piece.shape;
    const FastPassage fast = fast_passage(piece, beside);
    const double length = shape.length - begin_of(shape, beside);
    const bool follows = beside.follows();
    const bool goes_on = beside.goes_on();
    piece.is_charged = false;
    each_of(piece.rows, [&](std::size_t i) {
        const double turn0 = follows ? shape.slope_at(i, 0) - before->slope_at(i, before->length) : 0;
        const double turn1 = goes_on ? next->slope_at(i, 0) - shape.slope_at(i, shape.length) : 0;
        const double jumps = (turn0 * fast.v0 + turn1 * fast.v1) / 2;
        const double recovered =
            shape.is_straight ? fast.recovers(shape.slope[i], weaker(setup_.limits[i]), jumps > 0) : 0;
        if (std::abs(jumps) <= recovered) { return; }
        if (!piece.is_charged) { piece.charged = shape.bend; }
        piece.is_charged = true;
        piece.charged[i] += (turn0 + turn1) / (2 * length);
    });
}

/// Slows the joints in place of the charge, if that takes less time. This is so for a long piece with a joint from
/// which one axis recovers slowly: the charge would slow the whole piece.
void SpeedWindow::slow_joints(JoinedPiece& piece, const Neighbours& beside) const {
    const double from = begin_of(piece.shape, beside);
    const Interval whole{.kind = IntervalKind::Curved, .from = from, .to = piece.shape.length};
    const double charged_ticks = whole.length() / std::sqrt(IntervalBounds(setup_, piece, whole).cap(overrides_));
    const FastPassage fast = fast_passage(piece, beside);
    JoinedPiece slowed;
    slowed.shape = piece.shape;
    slowed.rows = piece.rows;
    double share = 1;
    for (int halves = 0; halves < kMostHalves; ++halves) {
        share /= 2;
        if (beside.follows()) { slowed.begin_cap = share * fast.v0 * fast.v0; }
        if (beside.goes_on()) { slowed.end_cap = share * fast.v1 * fast.v1; }
        charge(slowed, beside);
        if (slowed.is_charged) { continue; }
        if (kWorthSlowing * fast_passage(slowed, beside).ticks() < charged_ticks) { piece = slowed; }
        return;
    }
}

/// Closes a piece when the next one is known, or there is none.
void SpeedWindow::close_piece(std::size_t k) {
    JoinedPiece& piece = pieces_[k];
    Neighbours beside{k > 0 ? shape_at(k - 1) : nullptr, shape_at(k + 1), {}, {}};
    if (is_passed(piece.shape, beside)) {
        if (beside.next == nullptr || beside.next->piece != piece.shape.piece) { begin_u_ = 0; }
        ++first_piece_;
        return pieces_.pop_front();
    }
    beside.begin = joint_ ? *joint_ : joint(beside.before, &piece.shape);
    beside.end = joint(&piece.shape, beside.next);
    joint_ = beside.end;
    piece.rows = piece.shape.moving | beside.moving();
    if (piece.shape.length > 0) { charge(piece, beside); }
    if (piece.is_charged && piece.shape.is_straight) { slow_joints(piece, beside); }
    beside.begin.cap = std::min({beside.begin.cap, piece.begin_cap, k > 0 ? pieces_[k - 1].end_cap : kMost});
    cut_piece(k, beside);
}

/// Whether the path begins at the end of the piece. If the machine must rest there, the shortest remainder counts.
bool SpeedWindow::is_passed(const Quadratic& piece, const Neighbours& beside) const {
    if (beside.before != nullptr || piece.length == 0) { return false; }
    return piece.length - begin_of(piece) <= (beside.goes_on() ? kLeastBegin_mm : 0);
}

/// Whether the piece may be faster than both of its ends.
bool SpeedWindow::is_slow_at_ends(const JoinedPiece& piece, const Neighbours& beside) const {
    const Interval whole{.from = begin_of(piece.shape, beside), .to = piece.shape.length};
    const double top = IntervalBounds(setup_, piece, whole).cap(overrides_);
    return beside.begin.cap < top && std::min(beside.end.cap, piece.end_cap) < top;
}

void SpeedWindow::cut_piece(std::size_t k, const Neighbours& beside) {
    const JoinedPiece& piece = pieces_[k];
    const Quadratic& shape = piece.shape;
    const Joint& begin = beside.begin;
    const double from = begin_of(shape, beside);
    const double length = shape.length - from;
    Interval part{.piece = first_piece_ + k, .jump = begin.jump, .joint = begin.cap};
    double cap = begin.cap;
    std::size_t parts = 1;
    if (shape.length == 0) {
        part.kind = IntervalKind::Rest;
    } else if (shape.is_straight && !piece.is_charged) {
        part.kind = IntervalKind::Straight;
        part.acceleration = part.deceleration = kMost;
        each_of(shape.moving, [&](std::size_t i) {
            const double slope = std::abs(shape.slope.begin()[i]);
            if (slope <= kNothing) { return; }
            part.acceleration = std::min(part.acceleration, setup_.limits[i].max_acceleration / slope);
            part.deceleration = std::min(part.deceleration, setup_.limits[i].max_deceleration / slope);
        });
    } else {
        const double by_length = length / kMaxInterval_mm;
        const double by_turn = turn_of(shape, length, setup_) / kMaxTurn;
        parts = 1 + static_cast<std::size_t>(std::max(by_length, by_turn));
        if (parts < kLeastParts && (shape.is_straight || is_slow_at_ends(piece, beside))) { parts = kLeastParts; }
    }
    const auto place = [&](std::size_t of) {
        return of == parts ? shape.length : from + length * static_cast<double>(of) / static_cast<double>(parts);
    };
    IntervalBounds bounds(setup_, piece, part);
    part.from = from;
    part.to = shape.length;
    std::optional<double> common;
    if (part.kind == IntervalKind::Rest) { common = kMost; }
    if (parts > 1) { common = bounds.common_cap(overrides_); }
    part.to = from;
    for (std::size_t number = 0; number < parts; ++number) {
        part.from = part.to;
        part.to = place(number + 1);
        part.top = common ? *common : bounds.cap(overrides_);
        part.cap = std::min(cap, part.top);
        if (number == 0 && !intervals_.empty()) { part.cap = std::min(part.cap, intervals_.back().top); }
        intervals_.push_back(part);
        cap = part.top;
        part.jump = 0;
        part.joint = kMost;
    }
}

std::size_t SpeedWindow::interval_at(std::size_t piece, double u) const {
    std::size_t low = first_;
    std::size_t high = end();
    while (high - low > 1) {
        const std::size_t middle = (low + high) / 2;
        const Interval& part = interval(middle);
        const bool is_behind = part.piece > piece || (part.piece == piece && part.from > u);
        (is_behind ? high : low) = middle;
    }
    return low;
}

double SpeedWindow::reach_behind(std::size_t number) const {
    if (number + 1 < end()) { return interval(number + 1).reach; }
    return is_finished_ ? std::min(end_cap_, interval(number).top) : 0;
}

std::size_t SpeedWindow::known() const {
    if (is_finished_) { return end(); }
    return final_ > first_ ? final_ - 1 : first_;
}

/// Each constant speed up to the top can be kept, so an interval whose end may be as fast as its beginning needs no look
/// at its bounds. A reach that differs from the cap only by rounding is set to the cap, because whether a place is final must not
/// depend on where the pass began.
void SpeedWindow::update(std::size_t first, std::size_t last) {
    double behind = reach_behind(last);
    IntervalBounds bounds = this->bounds(interval(last));
    for (std::size_t k = last + 1; k-- > first; behind = interval(k).reach) {
        Interval& part = intervals_[k - first_];
        if (part.may_cruise && behind >= part.cap) {
            part.reach = part.cap;
            continue;
        }
        bounds.take(piece_of(part), part);
        const double reach = bounds.before(behind);
        part.reach = reach < (1 - kRounding) * part.cap ? reach : part.cap;
    }
}

/// If the reach of a place is the cap of its own limits, it does not depend on later pieces.
void SpeedWindow::look_ahead() {
    if (final_ < end()) { update(final_, end() - 1); }
    std::size_t last = end();
    while (last > final_ && interval(last - 1).reach < interval(last - 1).cap) { --last; }
    if (end() - last >= kMaxOpen) { last = end() - kMaxOpen / 2; }
    final_ = last;
    due_ = std::max(2 * (end() - final_), kLeastPass);
}

void SpeedWindow::cut(std::size_t number, double u, double w) {
    Interval& part = intervals_[number - first_];
    part.from = u;
    part.cap = part.reach = w;
    part.jump = 0;
    part.joint = kMost;
}

void SpeedWindow::lower(std::size_t number, double cap) {
    if (number == end()) {
        end_cap_ = std::min(end_cap_, cap);
    } else {
        Interval& part = intervals_[number - first_];
        part.cap = std::min(part.cap, cap);
    }
}

void SpeedWindow::slow(std::size_t number, double slower) {
    Interval& part = intervals_[number - first_];
    if (part.kind == IntervalKind::Straight) { part.top *= slower; }
}

void SpeedWindow::drop_before(std::size_t number) {
    const std::size_t piece =
        number < end() ? interval(number).piece : first_piece_ + pieces_.size() - (is_open_ ? 1 : 0);
    intervals_.drop_front(number - first_);
    while (first_piece_ + 1 < piece) {  // may_rise looks back at the piece before
        pieces_.pop_front();
        ++first_piece_;
    }
    first_ = number;
    final_ = std::max(final_, first_);
}

}  // namespace lockstep
