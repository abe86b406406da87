#include "core/path/frame_planner.hpp"

#include <algorithm>
#include <cmath>

namespace lockstep {
namespace {

/// Removes the first `ticks` of a piece and returns them as a piece.
Piece cut_front(Piece& piece, Ticks ticks) {
    const Piece front{ticks, piece.velocity, piece.acceleration};
    piece.velocity.raw += ticks.value * piece.acceleration.raw;
    piece.ticks = piece.ticks - ticks;
    return front;
}

double as_double(Ticks t) { return static_cast<double>(t.value); }
Ticks rounded_up(double ticks) { return {static_cast<std::int64_t>(std::ceil(ticks - 0x1p-20))}; }

Ticks end_of_frame(const TimedPath& path, Ticks most) {
    return std::min(most, std::max(rounded_up(path.end()), Ticks{1}));
}

void note_places(PathFrame& frame, const TimedPath& path, const PathTrail& trail) {
    const double part = as_double(frame.ticks) / static_cast<double>(frame.places.size());
    for (std::size_t k = 0; k < frame.places.size(); ++k) {
        frame.places[k] = trail.place_of(path.spot_at(part * static_cast<double>(k)));
    }
    frame.begin = frame.places[0];
}

/// Notes the moves that begin in the first `ticks` of the path.
void note_begins(const TimedPath& path, Ticks ticks, const PathTrail& trail, std::vector<MoveBegin>& begins) {
    constexpr double kHair_mm = 1e-9;
    begins.clear();
    for (const PathPhase& phase : path.phases()) {
        const double from = std::max(phase.begin, 0.0);
        const double to = std::min(phase.end(), as_double(ticks));
        if (to < from) { continue; }
        trail.each_begin(phase.origin.piece, [&](double on_geometry, std::uint32_t block) {
            const double u = on_geometry - phase.origin.u;
            const double most = phase.shape->is_aside ? 0 : phase.along(to);
            const bool is_in = u >= phase.along(from) - kHair_mm && u <= most + kHair_mm;
            if (is_in) { begins.push_back({block, std::clamp(phase.time_at(u), from, to)}); }
        });
    }
}

/// Boards rest as long as the motors move, because their outputs change meanwhile.
void rest_boards(PathFrame& frame, std::size_t motors) {
    const AxisTrack& motor = frame.axes.front();
    for (std::size_t i = motors; i < frame.axes.size(); ++i) {
        AxisTrack& board = frame.axes[i];
        board = {};
        for (const Piece& piece : motor.body) { board.body.append({piece.ticks, {}, {}}); }
        for (const Piece& piece : motor.tail) { board.tail.append({piece.ticks, {}, {}}); }
    }
}

/// A straight interval starts again in each frame. A curved one is passed as planned: the square of the speed is linear
/// from end to end. A rest is finished too, but the speed behind it is still free. When braking, any interval starts
/// again; then the interval numbers of the tail may be those before a change of the overrides.
FrameCursor cursor_at(const TimedPath& path, const SpeedWindow& window, Ticks t, bool is_braking) {
    const double at = as_double(t);
    const auto& passages = path.passages();
    std::size_t m = passages.size() - 1;
    while (m > 0 && passages[m].begin > at) { --m; }
    const Passage& passage = passages[m];
    std::size_t k = passage.first_phase;
    const auto& phases = path.phases();
    while (k + 1 < phases.size() && phases[k + 1].interval == passage.interval && phases[k].end() <= at) { ++k; }
    const double speed = phases[k].speed(at);
    const double w = speed * speed;
    FrameCursor cursor{.interval = passage.interval, .w0 = w, .u = phases[k].along(at), .w = w};
    if (is_braking) {
        cursor.interval = window.interval_at(phases[k].piece, cursor.u);
        return cursor;
    }
    const IntervalKind kind = window.interval(passage.interval).kind;
    if (kind != IntervalKind::Straight) {
        cursor.begin = passage.begin - at;
        cursor.w0 = passage.w0;
    }
    if (kind == IntervalKind::Curved) { cursor.w1 = passage.w1; }
    return cursor;
}

/// An interval under way need not be passed as planned from here on.
void restart_here(FrameCursor& at, SpeedWindow& window) {
    if (!at.w1) { return; }
    at.begin = 0;
    at.w0 = at.w;
    at.w1.reset();
    window.cut(at.interval, at.u, at.w);
}

/// Traces the tail from the cursor on, as slowly as possible. An interval under way is left at once, because the bounds
/// of an interval hold for any part of it. The remainder keeps them at constant speed, and as planned, so also at the
/// least speed that they allow at its end. This is at most the planned one, so the path behind can be followed. Only
/// charges, which count in the middle of an interval, may ask for more in its remainder; then it is passed as planned.
void trace_tail(const FrameCursor& from, const SpeedWindow& window, TimedPath& tail) {
    tail.begin(0);
    double w0 = from.w;
    for (std::size_t k = from.interval; k < window.end(); ++k) {
        Interval part = window.interval(k);
        if (part.kind == IntervalKind::Rest) { break; }
        const Quadratic& shape = window.shape_of(part);
        const bool is_under_way = k == from.interval;
        if (is_under_way) { part.from = from.u; }
        const double least = window.bounds(part).least_after(w0);
        const double w1 = is_under_way && from.w1 ? std::min(least, *from.w1) : least;
        if (w1 <= 0) {
            tail.brake(shape, part, k, w0, w1);
            break;
        }
        tail.pass(shape, part, k, w0, w1);
        w0 = w1;
    }
    tail.rest();
}

/// Notes what outputs need of the tail.
void note_tail(PathFrame& frame, const TimedPath& tail, const PathSetup& setup, const PathTrail& trail,
               std::vector<MoveBegin>& begins) {
    begins.clear();
    frame.tail_speeds.clear();
    if (frame.last || !setup.has_outputs) { return; }
    Ticks length;
    for (const AxisTrack& track : frame.axes) { length = std::max(length, total_ticks(track.tail)); }
    note_begins(tail, length, trail, begins);
    if (setup.tells_speeds) { list_speeds(tail, length, frame.tail_speeds); }
}

}  // namespace

FramePlanner::FramePlanner(const FramePlanner& other, const PathSetup& setup, SpeedWindow& window,
                           const PathTrail& trail)
    : setup_(setup),
      window_(window),
      trail_(trail),
      at_(other.at_),
      held_tail_(other.held_tail_),
      fit_(setup),
      last_(other.last_),
      begins_(other.begins_),
      tail_begins_(other.tail_begins_),
      overridden_(setup),
      has_begun_(other.has_begun_),
      has_made_(other.has_made_),
      is_done_(other.is_done_),
      counts_(other.counts_) {}

void FramePlanner::begin(std::span<const Position> at) {
    at_ = {};
    for (const Position& position : at) { at_.points.append({position, 0, {}}); }
    held_tail_.begin(0);
    has_begun_ = has_made_ = is_done_ = is_traced_ = false;
}

/// Traces the path in time from the cursor to behind the frame. Returns false if the path is not known that far; the
/// next call continues from there.
bool FramePlanner::trace() {
    if (!is_traced_) { path_.begin(at_.begin); }
    is_traced_ = true;
    const double enough = as_double(setup_.frame_ticks) + kMargin_ticks;
    const auto& passed = path_.passages();
    double w0 = passed.empty() ? at_.w0 : passed.back().w1;
    std::size_t k = passed.empty() ? at_.interval : passed.back().interval + 1;
    for (; k < window_.known() && path_.end() < enough; ++k) {
        const Interval& part = window_.interval(k);
        double w1 = std::min(window_.reach_behind(k), window_.bounds(part).after(w0));
        if (at_.w1 && k == at_.interval) { w1 = *at_.w1; }
        path_.pass(window_.shape_of(part), part, k, w0, w1);
        w0 = w1;
    }
    if (path_.end() >= enough) { return true; }
    if (!window_.is_finished()) { return false; }
    path_.rest();
    return true;
}

/// Returns false if nothing of the path is known yet, or if it has no length.
bool FramePlanner::start() {
    if (has_begun_) { return true; }
    if (window_.known() == window_.first()) {
        is_done_ = window_.is_finished();
        return false;
    }
    at_.interval = window_.first();
    at_.w0 = window_.interval(at_.interval).reach;
    has_begun_ = true;
    return true;
}

bool FramePlanner::is_ready() { return !is_done_ && start() && trace(); }

std::optional<FitFailure> FramePlanner::fit(PathFrame& frame, FrameCursor& behind, FrameRoom* room) {
    if (auto failure = fit_body(frame, behind)) { return failure; }
    if (!frame.last && !fit_tail(frame, behind)) { return FitFailure{frame.ticks}; }
    note_begins(path_, frame.ticks, trail_, begins_);
    note_tail(frame, tail_, setup_, trail_, tail_begins_);
    const bool fits = room == nullptr || room->has_room(begins_, tail_begins_, frame.last);
    return fits ? std::nullopt : std::optional(FitFailure{frame.ticks, FitFailure::Why::Crowded});
}

std::expected<const PathFrame*, PathStuck> FramePlanner::next(FrameRoom* room) {
    if (!start()) { return nullptr; }
    PathFrame& frame = made_;
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
        if (!trace()) { return nullptr; }
        frame.ticks = end_of_frame(path_, setup_.frame_ticks);
        frame.last = window_.is_finished() && path_.passages().back().interval + 1 == window_.end() &&
                     rounded_up(path_.end()) <= frame.ticks;
        FrameCursor behind;
        const std::optional<FitFailure> failure = fit(frame, behind, room);
        if (!failure) {
            note_places(frame, path_, trail_);
            if (setup_.tells_speeds) { list_speeds(path_, frame.ticks, frame.speeds); }
            frame.rest = place_of_rest(frame, behind);
            take(behind);
            is_done_ = frame.last;
            std::swap(held_tail_, tail_);
            std::swap(last_, made_);
            return &last_;
        }
        slow_down(*failure, frame.ticks, attempt);
    }
    const bool is_at_rest = held_tail_.phases().empty() || held_tail_.end() <= 0;
    if (is_at_rest) { return std::unexpected(PathStuck{trail_.place_of(path_.spot_at(0))}); }
    brake();
    return &last_;
}

/// Makes a frame of the pieces of the last frame's tail. This is always possible. At the tail's end the machine rests.
void FramePlanner::brake() {
    PathFrame& frame = last_;
    frame.ticks = setup_.frame_ticks;
    frame.last = false;
    note_places(frame, held_tail_, trail_);
    note_begins(held_tail_, frame.ticks, trail_, begins_);
    if (setup_.tells_speeds) { list_speeds(held_tail_, frame.ticks, frame.speeds); }
    FrameCursor behind = cursor_at(held_tail_, window_, frame.ticks, true);
    for (std::size_t i = 0; i < setup_.motors(); ++i) {
        AxisTrack& track = frame.axes[i];
        track.from = at_.points[i].position;
        track.body.clear();
        Ticks left = frame.ticks;
        while (left > Ticks{} && !track.tail.empty()) {
            const bool is_whole = track.tail[0].ticks <= left;
            track.body.append(is_whole ? track.tail[0] : cut_front(track.tail[0], left));
            left = left - track.body.back().ticks;
            if (is_whole) { track.tail.erase_front(1); }
        }
        if (left > Ticks{}) { track.body.append({left, {}, {}}); }
        behind.points.append(at_.points[i]);
        check(check_pieces({track.body.begin(), track.body.size()}, setup_.limits[i], behind.points[i]) ==
                  FaultCode::None,
              "a tail keeps the limits");
    }
    rest_boards(frame, setup_.motors());
    held_tail_.shift(frame.ticks);
    note_tail(frame, held_tail_, setup_, trail_, tail_begins_);
    ++counts_.braked;
    take(behind);
}

std::optional<FitFailure> FramePlanner::fit_body(PathFrame& frame, FrameCursor& next) {
    auto points = at_.points;
    frame.axes.resize(setup_.motors() + setup_.boards);
    for (std::size_t i = 0; i < setup_.motors(); ++i) {
        frame.axes[i].from = points[i].position;
        frame.axes[i].body.clear();
        frame.axes[i].tail.clear();
    }
    const auto failure = fit_.fit(path_, frame.ticks, setup_.body_pieces, {points.begin(), points.size()});
    if (failure) { return failure; }
    for (const MotorIndex i : motor_indices(setup_.motors())) {
        for (const Piece& piece : fit_.pieces(i)) { frame.axes[i].body.append(piece); }
        if (frame.last && !may_rest(points[i], setup_.limits[i])) { return FitFailure{frame.ticks}; }
    }
    rest_boards(frame, setup_.motors());
    next = frame.last ? FrameCursor{.interval = window_.end()} : cursor_at(path_, window_, frame.ticks, false);
    next.points = points;
    return std::nullopt;
}

bool FramePlanner::fit_tail(PathFrame& frame, const FrameCursor& from) {
    trace_tail(from, window_, tail_);
    const Ticks end = rounded_up(tail_.end());
    if (tail_.phases().empty() || end <= Ticks{}) { return true; }
    auto points = from.points;
    if (fit_.fit(tail_, end, setup_.tail_pieces, {points.begin(), points.size()})) { return false; }
    for (const MotorIndex i : motor_indices(setup_.motors())) {
        for (const Piece& piece : fit_.pieces(i)) { frame.axes[i].tail.append(piece); }
        if (!may_rest(points[i], setup_.limits[i])) { return false; }
    }
    rest_boards(frame, setup_.motors());
    return true;
}

/// The tail's end. Without a tail the machine rests at the end of the frame, which is the end of the path, or in a
/// rest. That rest begins again.
PathPlace FramePlanner::place_of_rest(const PathFrame& frame, const FrameCursor& behind) const {
    if (frame.last) { return trail_.place_of(path_.end_spot()); }
    if (!tail_.passages().empty()) { return trail_.place_of(tail_.end_spot()); }
    return trail_.place_of({window_.shape_of(window_.interval(behind.interval)).piece, 0});
}

/// Lowers the speeds at the nodes before a place, but not below those of the hardest braking from the frame's begin. A
/// frame that is full before its end is slowed down as a whole, in proportion to the part that is missing.
void FramePlanner::slow_down(const FitFailure& failure, Ticks ticks, int attempt) {
    ++counts_.slowed;
    is_traced_ = false;
    const double at = as_double(failure.at);
    const double share = at / as_double(ticks);
    const double needed = attempt < kAttempts / 2 ? std::clamp(share * share, kSlowest, kSlower) : kSlowest;
    const bool is_full = failure.why != FitFailure::Why::NoPiece;
    const double slower = is_full ? needed : kSlower;
    const double from = is_full ? 0 : at - static_cast<double>(kSlowTicks << std::min(attempt, 8));
    const double to = is_full ? as_double(ticks) : at;
    if (!has_made_) { start_slower(slower); }
    restart_here(at_, window_);
    const Ticks enough = failure.why == FitFailure::Why::Crowded ? setup_.frame_ticks : Ticks{};
    double least = at_.w0;
    std::size_t last = at_.interval;
    const auto& passages = path_.passages();
    for (std::size_t k = 0; k < passages.size(); ++k) {
        const Passage& passage = passages[k];
        const double begin = std::max(passage.begin, 0.0);
        const double end = k + 1 < passages.size() ? passages[k + 1].begin : path_.end();
        const Interval& part = window_.interval(passage.interval);
        least = std::max(0.0, window_.bounds(part).least_after(least));
        last = passage.interval;
        const bool is_rest = part.kind == IntervalKind::Rest;
        if ((is_rest ? end : begin) >= from) { window_.lower(last + 1, std::max(slower * passage.w1, least)); }
        if (is_full && last > at_.interval) { window_.slow(last, slower, enough); }
        if (begin > to + kMargin_ticks) { break; }
    }
    window_.update(at_.interval + 1, std::min(last + 1, window_.end() - 1));
}

/// Lowers the speed of the first step from rest: with the planned one, braking may not be possible within the limits.
void FramePlanner::start_slower(double slower) {
    window_.lower(at_.interval, slower * at_.w0);
    window_.update(at_.interval, at_.interval);
    at_.w0 = window_.interval(at_.interval).reach;
}

OverrideResult FramePlanner::set_overrides(const Overrides& overrides) {
    if (is_done_) { return OverrideResult::CannotFollow; }
    overridden_ = window_;
    FrameCursor at = at_;
    restart_here(at, overridden_);
    const OverrideResult result = overridden_.set_overrides(overrides, at.interval, at.w0);
    if (result != OverrideResult::Taken) { return result; }
    std::swap(window_, overridden_);
    at_ = at;
    is_traced_ = false;
    return result;
}

void FramePlanner::take(const FrameCursor& next) {
    is_traced_ = false;
    has_made_ = true;
    at_ = next;
    const bool is_cut =
        !at_.w1 && at_.interval < window_.end() && window_.interval(at_.interval).kind != IntervalKind::Rest;
    if (is_cut) { window_.cut(at_.interval, at_.u, at_.w0); }
    window_.drop_before(at_.interval);
}

}  // namespace lockstep
