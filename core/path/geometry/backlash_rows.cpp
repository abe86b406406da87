#include "core/path/geometry/backlash_rows.hpp"

#include <algorithm>
#include <cmath>

#include "core/path/geometry/motor_rows.hpp"

namespace lockstep {
namespace {

constexpr double kHair_mm = 1e-9;   // a shorter part is none
constexpr double kNearSide = 1e-3;  // steps: far more than the rounding of a rest

}  // namespace

void BacklashRows::restart(double begin_mm, std::span<const Position> motors) {
    begin_mm_ = begin_mm;
    begins_ = true;
    at_.clear();
    for (const Position& position : motors) { at_.push_back(position.as_steps()); }
}

/// The plays of the motors where the path begins. A motor may have come to rest while it took up its play.
void BacklashRows::find_sides(const PathSetup& setup, const Quadratic& slides, double begin) {
    if (at_.empty()) { return; }
    for (const MotorIndex m : motor_indices(sides_.size())) {
        const Backlash& backlash = setup.backlashes[m].backlash;
        if (backlash.is_none()) { continue; }
        const double slide = slides.place(m, begin);
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
    for (const MotorIndex m : motor_indices(setup.motors())) {
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
    if (begins_) { sides_.assign(setup.motors(), {}); }
    find_cuts(setup, axes);
    double from = 0;
    for (const double to : cuts_) {
        add_part(setup, axes, from, to);
        from = to;
    }
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

/// Parts before the begin of the path are passed, so nothing is taken up in them. Where the machine rests, the slides
/// are on whole steps, so their rows tell where they are, not the axes.
void BacklashRows::add_part(const PathSetup& setup, const Quadratic& axes, double from, double to) {
    const Quadratic part = from == 0 && to == axes.length ? axes : part_of(axes, from, to);
    Quadratic slides = RowPieces(setup, part).next();
    const double begin = begins_ ? std::clamp(begin_mm_, from, to) - from : 0;
    const bool is_passed = begin > 0 && begin >= slides.length;
    if (begins_ && (!is_passed || to == axes.length)) {
        find_sides(setup, slides, begin);
        begins_ = false;
    }
    before_ = sides_;
    const bool takes_up = !is_passed && push_all(setup, slides, begin);
    if (takes_up && begin > 0) {
        add(part_of(slides, 0, begin), before_);
        slides = part_of(slides, begin, slides.length);
    }
    add(slides, sides_);
    if (takes_up) { add_take_up(setup, rows_.back(), before_); }
}

/// Returns whether a motor first has to take up its play.
bool BacklashRows::push_all(const PathSetup& setup, const Quadratic& slides, double begin) {
    bool takes_up = false;
    for (const MotorIndex m : motor_indices(sides_.size())) {
        const MotorBacklash& motor = setup.backlashes[m];
        if (motor.backlash.is_none()) { continue; }
        takes_up = push(motor, sides_[m], slides.place(m, begin), slides.place(m, slides.length)) || takes_up;
    }
    return takes_up;
}

void BacklashRows::add(const Quadratic& slides, const std::vector<Side>& sides) {
    Quadratic& rows = rows_.emplace_back(slides);
    for (const MotorIndex m : motor_indices(sides.size())) { rows.from[m] += sides[m].play; }
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
