#include "core/path/geometry/chord_joiner.hpp"

#include <algorithm>
#include <cmath>

#include "core/path/geometry/travel_end.hpp"

namespace lockstep {
namespace {

constexpr double kCornerDeflection = 0.060627287;  // 1 - cos(0.35)
constexpr double kShift = 1.0 / 16;
constexpr double kMostShift = 0.95;  // of the tolerance

}  // namespace

void ChordJoiner::begin(const PlaceVector& at) {
    points_.clear();
    PathPoint first;  // not PathPoint{}, which would clear its unused room
    first.at = at;
    points_.push_back(first);
    end_ = start_at_ = at;
    moving_ = {};
    start_ = behind_ = ahead_ = scanned_ = needed_ = 0;
    measured_ = found_ = guess_ = 1;
    is_fit_begun_ = false;
}

void ChordJoiner::add(const PlaceVector& to, const MoveSettings& settings, std::uint32_t block, PathTrail& out) {
    end_ = to;
    const double length = step_to(points_.back().at, to);
    if (length < kLeast_mm) { return; }
    points_.push_back({.at = to, .along = points_.back().along + length, .settings = settings, .block = block});
    join(false, out);
}

/// The length of a chord in mm. Notes the axes that move.
double ChordJoiner::step_to(const PlaceVector& from, const PlaceVector& to) {
    for (const AxisIndex i : axis_indices(to.size())) {
        if (to.begin()[i] != from.begin()[i]) { moving_.insert(i); }
    }
    double square = 0;
    for (const AxisIndex i : moving_) {
        const double mm = (to.begin()[i] - from.begin()[i]) / setup_.steps_per_mm[i];
        square += mm * mm;
    }
    return std::sqrt(square);
}

void ChordJoiner::finish(const PlaceVector& end, PathTrail& out) {
    const std::size_t last = points_.size() - 1;
    const bool has_begun_there = last == 0 && moving_.empty() && start_at_ == end;
    if (has_begun_there) { return; }
    if (last > start_) {
        const double length = step_to(points_[last - 1].at, end);
        if (length >= kLeast_mm) {
            points_[last].at = end;
            points_[last].along = points_[last - 1].along + length;
            points_[last - 1].is_end = last - 1 > start_;
        }
        join(true, out);
    }
    begin(end);
}

void ChordJoiner::join(bool is_end, PathTrail& out) {
    measure_deflections(is_end);
    find_corners(is_end);
    while (start_ + 1 < points_.size()) {
        const Reach limit = reach(is_end);
        if (limit.chords == 0 || (!limit.is_decided && limit.chords < needed_)) { break; }
        Quadratic piece;
        const std::size_t chords = longest(limit, piece);
        if (chords == 0) { break; }
        piece.feed_mm_per_tick = points_[start_ + 1].settings.feed_mm_per_tick;
        piece.is_feed_fixed = points_[start_ + 1].settings.is_feed_fixed;
        piece.most_mm_per_tick = points_[start_ + 1].settings.most_mm_per_tick;
        piece.chords = static_cast<std::uint32_t>(chords);
        start_at_ = best_end_;
        mark(chords, out);
        out.add(piece);
        guess_ = chords;
        start_ += chords;
        is_fit_begun_ = false;
        needed_ = 0;
        drop_passed();
    }
}

/// Marks where each chord of the next piece begins.
void ChordJoiner::mark(std::size_t chords, PathTrail& out) const {
    for (std::size_t k = start_; k < start_ + chords; ++k) {
        out.mark(points_[k].along - points_[start_].along, points_[k + 1].block, 0);
    }
}

/// Measures the deflection of each vertex behind which the path is known for kLook_mm.
void ChordJoiner::measure_deflections(bool is_end) {
    for (; measured_ + 1 < points_.size(); ++measured_) {
        const double along = points_[measured_].along;
        if (!is_end && points_.back().along - along < kLook_mm) { return; }
        while (behind_ + 1 < measured_ && along - points_[behind_ + 1].along >= kLook_mm) { ++behind_; }
        ahead_ = std::max(ahead_, measured_ + 1);
        while (ahead_ + 1 < points_.size() && points_[ahead_].along - along < kLook_mm) { ++ahead_; }
        points_[measured_].deflection = deflection_at(measured_);
    }
}

double ChordJoiner::deflection_at(std::size_t k) const {
    const PlaceVector& a = points_[behind_].at;
    const PlaceVector& b = points_[k].at;
    const PlaceVector& c = points_[ahead_].at;
    double dot = 0;
    double square0 = 0;
    double square1 = 0;
    for (const AxisIndex i : moving_) {
        const double d0 = (b.begin()[i] - a.begin()[i]) / setup_.steps_per_mm[i];
        const double d1 = (c.begin()[i] - b.begin()[i]) / setup_.steps_per_mm[i];
        dot += d0 * d1;
        square0 += d0 * d0;
        square1 += d1 * d1;
    }
    const double product = square0 * square1;
    return product > 0 ? 1 - dot / std::sqrt(product) : 2;
}

/// Classifies each vertex for which the deflections within kLook_mm behind it are known.
void ChordJoiner::find_corners(bool is_end) {
    for (; found_ < measured_; ++found_) {
        if (!is_end && points_[measured_ - 1].along - points_[found_].along < kLook_mm) { return; }
        points_[found_].is_corner = is_corner(found_);
    }
}

bool ChordJoiner::is_corner(std::size_t k) const {
    const PathPoint& point = points_[k];
    if (point.deflection <= kCornerDeflection) { return false; }
    for (std::size_t j = k - 1; j >= 1 && point.along - points_[j].along < kLook_mm; --j) {
        if (points_[j].deflection >= point.deflection) { return false; }
    }
    for (std::size_t j = k + 1; j < measured_ && points_[j].along - point.along < kLook_mm; ++j) {
        if (points_[j].deflection > point.deflection) { return false; }
    }
    return true;
}

/// A piece reaches to the next corner, change of settings, or the end. It is a single chord if the path must be exact.
ChordJoiner::Reach ChordJoiner::reach(bool is_end) {
    const MoveSettings& settings = points_[start_ + 1].settings;
    const std::size_t last = points_.size() - 1;
    scanned_ = std::max(scanned_, start_ + 1);
    for (;; ++scanned_) {
        if (scanned_ == last) { return {is_end ? last - start_ : found_ - 1 - start_, is_end}; }
        if (scanned_ >= found_) { return {found_ - 1 - start_, false}; }
        const PathPoint& point = points_[scanned_];
        const bool is_far = scanned_ - start_ >= kMaxChords || point.along - points_[start_].along >= kMaxLength_mm;
        const bool is_break = point.is_corner || point.is_end || points_[scanned_ + 1].settings != settings;
        if (is_far || is_break || settings.mode != PathMode::Blend) { return {scanned_ - start_, true}; }
    }
}

bool ChordJoiner::try_chords(std::size_t chords, Quadratic& best) {
    const PlaceVector end = end_at(start_ + chords);
    Quadratic piece;
    if (!fit_.fit(points_, chords, end, tolerance_steps_, moving_, piece)) { return false; }
    if (chords > 1 && !is_within_travel(piece)) { return false; }
    best = piece;
    best_end_ = end;
    return true;
}

/// A piece with a wide tolerance could lead out of the travel.
bool ChordJoiner::is_within_travel(const Quadratic& piece) const {
    for (const AxisIndex i : moving_) {
        const double extreme = piece.bend[i] == 0 ? 0 : piece.length / 2 - piece.slope[i] / piece.bend[i];
        const TravelEnds travel = travel_ends_of(setup_.limits_of_axis(i));
        for (const double u : {std::clamp(extreme, 0.0, piece.length), piece.length}) {
            const double at = piece.place(i, u);
            if (at < travel.least || at > travel.greatest) { return false; }
        }
    }
    return true;
}

/// Doubles the last piece's length until the fit fails, then bisects. Returns 0 if this needs more points.
std::size_t ChordJoiner::longest(const Reach& limit, Quadratic& best) {
    if (!is_fit_begun_) {
        set_tolerance(points_[start_ + 1].settings);
        fit_.begin(start_, start_at_);
        is_fit_begun_ = true;
    }
    std::size_t good = 0;
    std::size_t bad = limit.chords + 1;
    for (std::size_t chords = guess_; good < limit.chords || !limit.is_decided; chords = 2 * good) {
        if (!limit.is_decided && chords > limit.chords) {
            needed_ = chords;
            return 0;
        }
        chords = std::min(chords, limit.chords);
        if (!try_chords(chords, best)) {
            bad = chords;
            break;
        }
        good = chords;
    }
    while (bad - good > 1) {
        const std::size_t middle = (good + bad) / 2;
        (try_chords(middle, best) ? good : bad) = middle;
    }
    return good;
}

/// The place of a piece's end at a vertex.
PlaceVector ChordJoiner::end_at(std::size_t k) const {
    const PathPoint& point = points_[k];
    PlaceVector at = point.at;
    if (k + 1 == points_.size() || point.is_corner) { return at; }
    const PathPoint& last = points_[k - 1];
    const PathPoint& next = points_[k + 1];
    if (point.settings.mode != PathMode::Blend || next.settings.mode != PathMode::Blend) { return at; }
    if (point.settings.tolerance_mm != next.settings.tolerance_mm) { return at; }
    const double before = point.along - last.along;
    const double after = next.along - point.along;
    const double shift = kShift * std::min(before, after);
    double* const to = at.begin();
    for (const AxisIndex i : moving_) {
        const double deflection = (next.at.begin()[i] - to[i]) / after - (to[i] - last.at.begin()[i]) / before;
        const double most = kMostShift * tolerance_steps_[i];
        to[i] += std::clamp(shift * deflection, -most, most);
    }
    return at;
}

void ChordJoiner::set_tolerance(const MoveSettings& settings) {
    if (settings.tolerance_mm == tolerance_mm_) { return; }
    tolerance_mm_ = settings.tolerance_mm;
    tolerance_steps_.clear();
    for (const AxisIndex i : axis_indices(setup_.axes())) {
        const double step = setup_.step_of_motors(i);
        const double whole = std::max(step, settings.tolerance_mm * setup_.steps_per_mm[i]);
        const double map_share = setup_.motor_map.is_linear() ? 0 : kMapShare;
        tolerance_steps_.push_back(whole - kPulseShare * step - kFitShare * step - kRoundingShare * step -
                                   map_share * step);
    }
}

/// Drops old points, except those that the search for turns and corners looks back at.
void ChordJoiner::drop_passed() {
    constexpr std::size_t kWorthIt = 64;
    const std::size_t used = std::min({start_, behind_, found_ - 1});
    if (used < kWorthIt) { return; }
    std::size_t first = 0;
    while (first < used && points_[found_].along - points_[first + 1].along >= kLook_mm) { ++first; }
    if (first < kWorthIt) { return; }
    points_.drop_front(first);
    for (std::size_t* index : {&start_, &measured_, &found_, &behind_, &ahead_, &scanned_}) {
        *index -= std::min(*index, first);
    }
}

}  // namespace lockstep
