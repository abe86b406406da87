#include "core/path/geometry/backlash_rows.hpp"

#include <algorithm>
#include <cmath>

#include "core/path/geometry/motor_rows.hpp"

namespace lockstep {
namespace {

constexpr double kHair_mm = 1e-9;   // a shorter part is none
constexpr double kNearSide = 1e-3;  // steps: far more than the rounding of a rest

/// The place of a motor's slide, in steps of the motor.
double slide_at(const PathSetup& setup, MotorIndex motor, const Quadratic& axes, double u) {
    const Quadratic end = part_of(axes, u, axes.length);
    const double place = setup.motor_map.place(motor, end.from);
    const bool rests = (u == 0 && axes.begins_at_rest) || axes.length == 0;
    return rests ? std::round(place) : place;
}

PlaceVector end_of(const Quadratic& axes) {
    PlaceVector end;
    for (std::size_t i = 0; i < axes.from.size(); ++i) { end.append(axes.place(i, axes.length)); }
    return end;
}

}  // namespace

void BacklashRows::restart(double begin_mm, std::span<const Position> motors) {
    begin_mm_ = begin_mm;
    begins_ = true;
    at_.clear();
    for (const Position& position : motors) { at_.push_back(position.as_steps()); }
}

/// The plays of the motors where the path begins. A motor may have come to rest while it took up its play.
void BacklashRows::find_sides(const PathSetup& setup, const Quadratic& axes) {
    sides_.assign(setup.motors(), {});
    if (at_.empty()) { return; }
    for (const MotorIndex m : motor_indices(sides_.size())) {
        const Backlash& backlash = setup.backlashes[m].backlash;
        if (backlash.is_none()) { continue; }
        const double slide = slide_at(setup, m, axes, std::min(begin_mm_, axes.length));
        double play = at_[m] - slide;
        for (const std::int64_t side : {backlash.low(), backlash.high()}) {
            if (std::abs(play - static_cast<double>(side)) < kNearSide) { play = static_cast<double>(side); }
        }
        sides_[m] = {play, slide};
    }
}

/// The places at which a motor with backlash turns, and the end of the piece.
void BacklashRows::find_cuts(const PathSetup& setup, const Quadratic& axes) {
    cuts_.clear();
    for (const MotorIndex m : motor_indices(sides_.size())) {
        if (setup.backlashes[m].backlash.is_none()) { continue; }
        const double slope = setup.motor_map.shares().place(m, axes.slope);
        const double bend = setup.motor_map.shares().place(m, axes.bend);
        const double at = bend == 0 ? 0 : axes.length / 2 - slope / bend;
        if (at > kHair_mm && at < axes.length - kHair_mm) { cuts_.push_back(at); }
    }
    std::ranges::sort(cuts_);
    const auto is_same = [](double a, double b) { return b - a <= kHair_mm; };
    cuts_.erase(std::unique(cuts_.begin(), cuts_.end(), is_same), cuts_.end());
    cuts_.push_back(axes.length);
}

const std::vector<Quadratic>& BacklashRows::rows_of(const PathSetup& setup, const Quadratic& axes) {
    rows_.clear();
    if (begins_) { find_sides(setup, axes); }
    find_cuts(setup, axes);
    double from = 0;
    for (const double to : cuts_) {
        add_part(setup, axes, from, to);
        from = to;
    }
    begins_ = false;
    return rows_;
}

/// The motor goes from one place of its slide to another one. Returns whether it first has to take up its play.
bool BacklashRows::push(const MotorBacklash& motor, Side& side, double from, double to) {
    const auto low = static_cast<double>(motor.backlash.low());
    const auto high = static_cast<double>(motor.backlash.high());
    const bool is_between = side.play != low && side.play != high;
    const bool is_up = to > from || (to == from && side.play - low > high - side.play);
    const double needed = is_up ? high : low;
    const bool turns = side.play != needed;
    if (turns && !is_between && std::abs(to - side.turned) <= kSlack) { return false; }
    side.turned = turns ? to : is_up ? std::max(side.turned, to) : std::min(side.turned, to);
    side.play = needed;
    return turns;
}

/// Parts before the begin of the path are passed, so nothing is taken up in them.
void BacklashRows::add_part(const PathSetup& setup, const Quadratic& axes, double from, double to) {
    const double begin = begins_ ? std::clamp(begin_mm_, from, to) : from;
    const bool is_passed = axes.length > 0 && begin >= to;
    before_ = sides_;
    bool takes_up = false;
    for (const MotorIndex m : motor_indices(sides_.size())) {
        const MotorBacklash& motor = setup.backlashes[m];
        if (is_passed || motor.backlash.is_none()) { continue; }
        const double here = setup.motor_map.place(m, part_of(axes, begin, axes.length).from);
        const double there = axes.length == 0 ? here : setup.motor_map.place(m, end_of(part_of(axes, from, to)));
        takes_up = push(motor, sides_[m], here, there) || takes_up;
    }
    const auto add = [&](double a, double b, const std::vector<Side>& sides) {
        const Quadratic part = a == 0 && b == axes.length ? axes : part_of(axes, a, b);
        Quadratic& rows = rows_.emplace_back(RowPieces(setup, part).next());
        for (const MotorIndex m : motor_indices(sides.size())) { rows.from[m] += sides[m].play; }
    };
    if (takes_up && begin > from) {
        add(from, begin, before_);
        from = begin;
    }
    add(from, to, sides_);
    if (takes_up) { add_take_up(setup, rows_.back(), before_); }
}

/// Inserts it before the last rows. The slowest motor takes as long as its speed demands; all begin and end together.
void BacklashRows::add_take_up(const PathSetup& setup, const Quadratic& next, const std::vector<Side>& before) {
    Quadratic rows = next;
    rows.slope = SlopeVector::zeros(rows.from.size());
    rows.bend = BendVector::zeros(rows.from.size());
    rows.is_straight = rows.is_feed_fixed = rows.is_aside = true;
    rows.begins_at_rest = rows.ends_at_rest = false;
    rows.length = 0;
    double ticks = 0;
    for (const MotorIndex m : motor_indices(sides_.size())) {
        const double way = std::abs(sides_[m].play - before[m].play);
        if (way == 0) { continue; }
        rows.length = std::max(rows.length, way / setup.backlashes[m].steps_per_mm);
        ticks = std::max(ticks, way / setup.backlashes[m].steps_per_tick);
    }
    for (const MotorIndex m : motor_indices(sides_.size())) {
        const double way = sides_[m].play - before[m].play;
        rows.from[m] -= way;
        rows.slope[m] = way / rows.length;
    }
    rows.feed_mm_per_tick = rows.length / ticks;
    rows.most_mm_per_tick = std::numeric_limits<double>::infinity();
    rows_.insert(rows_.end() - 1, std::move(rows));
}

}  // namespace lockstep
