#include "clients/analysis/measure/job_moves.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "clients/analysis/vector/clones.hpp"
#include "clients/analysis/vector/lanes.hpp"

namespace lockstep::analysis {
namespace {

/// The number of steps, counted from the first, that are in the cursor's move. The first step is in it.
std::size_t steps_in_move(const MoveCursor& cursor, const EquallyLate& late) {
    if (late.is_one_way()) {
        const std::int64_t in_stroke = std::min(std::ssize(late.steps), cursor.steps_from(late.before));
        return static_cast<std::size_t>(std::max<std::int64_t>(1, in_stroke));
    }
    std::int64_t count = late.before;
    std::size_t steps = 0;
    for (; steps < late.steps.size() && cursor.is_in_stroke(count, late.steps[steps].direction); ++steps) {
        count += late.steps[steps].direction;
    }
    return std::max<std::size_t>(1, steps);
}

}  // namespace

bool MoveLog::is_whole() const {
    return std::ranges::all_of(
        motors, [](const MotorMove& of) { return std::abs(of.made_steps - of.asked_steps) <= of.slack_steps; });
}

bool MoveCursor::find_next(const AskedPath& asked, std::size_t motor, std::int64_t count, int direction,
                           std::int64_t most_beyond) {
    const std::size_t end = std::min(asked.strokes_of(motor).size(), next_ + kReach);
    const std::size_t near = std::min(end, next_ + kNear);
    if (find_among(asked, motor, next_, near, count, direction)) { return true; }
    const bool goes_on = stroke_.direction() == direction && stroke_.to != stroke_.from;
    const std::int64_t beyond = (count - stroke_.to) * direction;
    if (goes_on && beyond >= 0 && beyond < most_beyond) { return true; }
    return find_among(asked, motor, near, end, count, direction);
}

bool MoveCursor::find_among(const AskedPath& asked, std::size_t motor, std::size_t first, std::size_t end,
                            std::int64_t count, int direction) {
    const auto& strokes = asked.strokes_of(motor);
    for (std::size_t i = first; i < end; ++i) {
        if (!strokes[i].has(count, direction)) { continue; }
        next_ = i;
        stroke_ = strokes[i];
        return true;
    }
    return false;
}

JobMoves::JobMoves(AskedPath asked, bool on_a_line)
    : asked_(std::move(asked)),
      on_a_line_(on_a_line),
      made_cursor_(asked_.motors()),
      late_cursor_(asked_.motors()),
      made_(asked_.size()),
      made_steps_(asked_.size() * asked_.motors()) {
    if (asked_.size() == 0) { return; }
    while (asked_.details(details_.size()) != nullptr) { details_.emplace_back(); }
    peaks_.resize(details_.size() * asked_.motors());
    counts_.assign(asked_.starts().steps.begin(), asked_.starts().steps.end());
    axes_ = asked_.places();
    at_mm_.resize(axes_.axes());
    axes_.set(counts_, at_mm_);
    for (std::size_t i = 0; i < axes_.axes(); ++i) { near_mm2_ += std::pow(axes_.kinematics()->step_mm(i), 2); }
    places_.mm.resize(axes_.axes());
    begin(0);
}

void JobMoves::begin(std::size_t move) {
    current_ = move;
    if (!on_a_line_) { return; }
    shape_ = asked_.shape(move);
    bound_.forget();
}

/// The square of the distance from the axes' place to the curve. Near the joint of two moves, one motor may be in a
/// later move than the others: then the nearest of the last curves counts.
double JobMoves::square_of_distance_mm2() {
    constexpr std::size_t kBack = 8;
    double least = shape_.square_of_distance(at_mm_);
    bound_.set(shape_);
    for (std::size_t back = 1; back <= std::min(kBack, current_) && least > near_mm2_; ++back) {
        least = std::min(least, asked_.shape(current_ - back).square_of_distance(at_mm_));
    }
    return least;
}

/// `ends_tick`: no other motor makes a step in this tick.
void JobMoves::take(std::size_t motor, const MeasuredStep& step, bool ends_tick) {
    if (asked_.size() == 0) { return; }
    MoveCursor& cursor = made_cursor_[motor];
    const std::size_t move_before = cursor.move();
    const auto beyond = [&] { return slack(cursor.move(), motor); };
    if (cursor.find(asked_, motor, step.count - step.direction, step.direction, beyond)) {
        take_in(cursor.move(), motor, {step.tick, step.tick, 1, step.rates});
    } else {
        ++unasked_steps_;
    }
    const bool is_next = std::exchange(counts_[motor], step.count) == step.count - step.direction;
    axes_.go_to(motor, step.count, at_mm_);
    if (!on_a_line_) { return; }
    Made& made = made_[current_];
    if (!is_next) {
        bound_.forget();
        forget_distances(move_before);
    }
    if (step.tick < newest_) { return forget_distances(std::min(cursor.move(), current_)); }
    newest_ = made.newest = step.tick;
    if (!ends_tick && !axes_.is_direct()) { return; }
    note_place(0);
    places_.size = 1;
    measure_places(made.largest_square_mm2);
}

void JobMoves::take(MergedSteps& steps, MotorsOfLanes motor_of_lane, Tick until) {
    while (!steps.before(until).empty()) {
        take_in_strokes(steps, motor_of_lane, end_of_strokes(steps, motor_of_lane, until));
        if (steps.before(until).empty()) { return; }
        const std::size_t lane = steps.lane();
        const MeasuredStep step = steps.pop();
        const bool ends_tick = steps.empty() || steps.tick() != step.tick;
        if (motor_of_lane[lane]) { take(*motor_of_lane[lane], step, ends_tick); }
    }
}

/// The tick before which all steps continue the motors' strokes, in moves that have begun.
Tick JobMoves::end_of_strokes(const MergedSteps& steps, MotorsOfLanes motor_of_lane, Tick until) const {
    if (asked_.size() == 0 || steps.tick() < newest_) { return steps.tick(); }
    for (std::size_t i = 0; i < steps.lanes().size(); ++i) {
        const MergedSteps::Lane& lane = steps.lanes()[i];
        if (lane.steps.empty() || lane.steps.front().tick >= until) { continue; }
        if (!motor_of_lane[i]) { return steps.tick(); }
        const MoveCursor& cursor = made_cursor_[*motor_of_lane[i]];
        const bool goes_on = lane.is_one_way && lane.count == counts_[*motor_of_lane[i]] && cursor.move() <= current_ &&
                             cursor.is_in_stroke(lane.count, lane.steps.front().direction);
        const auto most = goes_on ? static_cast<std::size_t>(cursor.steps_from(lane.count)) : 0;
        if (most < lane.steps.size()) { until = std::min(until, lane.steps[most].tick); }
    }
    return until;
}

/// Takes the steps before a tick until which all motors continue their strokes.
void JobMoves::take_in_strokes(MergedSteps& steps, MotorsOfLanes motor_of_lane, Tick until) {
    const auto merged = steps.before(until);
    if (merged.empty()) { return; }
    for (std::size_t i = 0; i < steps.lanes().size(); ++i) {
        const MergedSteps::Lane& lane = steps.lanes()[i];
        const std::size_t count = lane.before(until);
        if (count == 0) { continue; }
        const std::size_t motor = *motor_of_lane[i];
        const std::size_t move = made_cursor_[motor].move();
        StepsOfMove of{lane.steps[0].tick, lane.steps[count - 1].tick, static_cast<std::int64_t>(count), {}};
        if (move < details_.size()) { of.peak = peak_of({lane.rates, count}); }
        take_in(move, motor, of);
        if (!on_a_line_) { counts_[motor] += of.steps * lane.steps[0].direction; }
    }
    if (on_a_line_) {
        measure_distances(merged, motor_of_lane);
        newest_ = made_[current_].newest = steps.tick_of(merged.back());
    }
    steps.pass_before(until);
}

LOCKSTEP_VECTOR_CLONES
StepRates JobMoves::peak_of(std::span<const StepRates> rates) {
    constexpr std::size_t kTogether = 8;  // rates in FloatLanes, by turns of speed and acceleration
    static_assert(sizeof(FloatLanes) == kTogether * sizeof(StepRates));
    FloatLanes most{};
    for (; rates.size() >= kTogether; rates = rates.subspan(kTogether)) {
        FloatLanes of;
        load(of, rates.data());
        most = of > most ? of : most;
    }
    std::array<StepRates, kTogether> together;
    store(most, together.data());
    StepRates peak;
    const auto note = [&](const StepRates& at) {
        peak.steps_per_tick = std::max(peak.steps_per_tick, at.steps_per_tick);
        peak.steps_per_tick2 = std::max(peak.steps_per_tick2, at.steps_per_tick2);
    };
    std::ranges::for_each(together, note);
    std::ranges::for_each(rates, note);
    return peak;
}

/// Measures the distances at steps that all are in moves that have begun.
void JobMoves::measure_distances(std::span<const MergedStep> steps, MotorsOfLanes motor_of_lane) {
    float& largest = made_[current_].largest_square_mm2;
    while (!steps.empty()) {
        steps = steps.subspan(note_places(steps, motor_of_lane));
        measure_places(largest);
    }
}

/// Notes the places after the next steps. Returns the number of these steps.
std::size_t JobMoves::note_places(std::span<const MergedStep> steps, MotorsOfLanes motor_of_lane) {
    if (steps.size() >= Places::kMost && axes_.is_direct()) {
        note_block(steps.first<Places::kMost>(), motor_of_lane);
        return Places::kMost;
    }
    std::size_t taken = 0;
    for (places_.size = 0; places_.size < Places::kMost && taken < steps.size(); ++taken) {
        const MergedStep& step = steps[taken];
        const std::size_t motor = *motor_of_lane[step.lane()];
        counts_[motor] += step.direction();
        axes_.go_to(motor, counts_[motor], at_mm_);
        note_place(places_.size);
        const bool ends_tick = taken + 1 == steps.size() || steps[taken + 1].tick() != step.tick();
        places_.size += ends_tick || axes_.is_direct() ? 1 : 0;
    }
    return taken;
}

/// The same for a whole block, if the motors are the axes: a motor's count after each step is the sum of its changes.
LOCKSTEP_VECTOR_CLONES
void JobMoves::note_block(std::span<const MergedStep, Places::kMost> steps, MotorsOfLanes motor_of_lane) {
    std::array<std::int32_t, Places::kMost> kinds;
    for (std::size_t i = 0; i < steps.size(); ++i) { kinds[i] = static_cast<std::int32_t>(steps[i].kind()); }
    IntLanes kind;
    load(kind, kinds.data());
    for (std::size_t i = 0; i < places_.mm.size(); ++i) {
        if (std::ranges::find(motor_of_lane, std::optional(i)) == motor_of_lane.end()) {
            places_.mm[i].fill(at_mm_[i]);
        }
    }
    for (std::size_t lane = 0; lane < motor_of_lane.size(); ++lane) {
        if (!motor_of_lane[lane]) { continue; }
        const std::size_t motor = *motor_of_lane[lane];
        const auto forward = static_cast<std::int32_t>(2 * lane);
        IntLanes sums = (kind == forward + 1) - (kind == forward);
        sum_up(sums);
        std::array<std::int32_t, Places::kMost> changes;
        store(sums, changes.data());
        const auto before = static_cast<double>(counts_[motor]);
        const double mm_per_step = axes_.mm_per_step(motor);
        for (std::size_t half = 0; half < Places::kMost; half += Places::kMost / 2) {
            HalfIntLanes change;
            load(change, changes.data() + half);
            const DoubleLanes count = before + __builtin_convertvector(change, DoubleLanes);
            store(count * mm_per_step, places_.mm[motor].data() + half);
        }
        counts_[motor] += changes.back();
    }
    places_.size = Places::kMost;
}

void JobMoves::note_place(std::size_t number) {
    for (std::size_t axis = 0; axis < at_mm_.size(); ++axis) { places_.mm[axis][number] = at_mm_[axis]; }
}

/// Measures the distances of the places that may be farther than the farthest one.
void JobMoves::measure_places(float& largest) {
    std::size_t place = bound_.first_farther(places_, 0, static_cast<double>(largest));
    while (place < places_.size) {
        places_.get(place, at_mm_);
        largest = std::max(largest, static_cast<float>(square_of_distance_mm2()));
        place = bound_.first_farther(places_, place + 1, static_cast<double>(largest));
    }
    places_.get(places_.size - 1, at_mm_);
}

/// Called if later steps of other motors were compared with an outdated position of this motor.
void JobMoves::forget_distances(std::size_t from_move) {
    for (std::size_t move = from_move; move <= current_; ++move) { made_[move].is_distance_known = false; }
}

std::size_t JobMoves::first_move_that_lacks(std::size_t motor) const {
    std::size_t move = 0;
    const auto has_all = [&] {
        return made_steps_[move * asked_.motors() + motor] + slack(move, motor) >= asked_.steps(move, motor);
    };
    while (move < asked_.size() && has_all()) { ++move; }
    return move;
}

bool JobMoves::lacks_steps_of(std::size_t motor) const { return first_move_that_lacks(motor) < asked_.size(); }

void JobMoves::know_until(std::size_t motor, Tick until) {
    for (std::size_t move = first_move_that_lacks(motor); move < asked_.size(); ++move) {
        if (made_[move].newest > until) { made_[move].is_distance_known = false; }
    }
}

std::int64_t JobMoves::moves_without_distance() const {
    return std::ranges::count(made_, false, &Made::is_distance_known);
}

void JobMoves::take_in(std::size_t move, std::size_t motor, const StepsOfMove& steps) {
    if (move > current_) { begin(move); }
    const std::size_t place = move * asked_.motors() + motor;
    made_steps_[place] += steps.steps;
    const bool is_lead = motor == asked_.lead(move);
    if (is_lead && made_[move].first == kNever) { made_[move].first = steps.first; }
    if (move >= details_.size()) { return; }
    StepRates& peak = peaks_[place];
    peak.steps_per_tick = std::max(peak.steps_per_tick, steps.peak.steps_per_tick);
    peak.steps_per_tick2 = std::max(peak.steps_per_tick2, steps.peak.steps_per_tick2);
    if (is_lead) { details_[move].last = steps.last; }
}

void JobMoves::Details::add(const EquallyLate& steps) {
    earliest = late.empty() ? steps.late : std::min(earliest, steps.late);
    latest = late.empty() ? steps.late : std::max(latest, steps.late);
    late.add(steps.late, std::ssize(steps.steps));
}

void JobMoves::take(std::size_t motor, EquallyLate late) {
    if (asked_.size() == 0) { return; }
    MoveCursor& cursor = late_cursor_[motor];
    const auto beyond = [&] { return slack(cursor.move(), motor); };
    while (true) {
        const bool is_found = cursor.find(asked_, motor, late.before, late.steps.front().direction, beyond);
        const std::size_t count = is_found ? steps_in_move(cursor, late) : 1;
        if (is_found) {
            late_.add(late.late, static_cast<std::int64_t>(count));
            if (cursor.move() < details_.size()) { details_[cursor.move()].add(late.first(count)); }
        }
        if (count == late.steps.size()) { return; }
        late = late.behind(count);
    }
}

std::optional<std::int32_t> JobMoves::line_at(Tick tick) const {
    std::optional<std::int32_t> line;
    for (std::size_t move = 0; move < made_.size(); ++move) {
        if (made_[move].first <= tick) { line = asked_.line(move); }
    }
    return line;
}

MoveLog JobMoves::move(std::size_t number) const {
    const Made& made = made_[number];
    MoveLog log{.line = asked_.line(number)};
    const bool is_made = made.first != kNever;
    if (is_made && on_a_line_ && made.is_distance_known) {
        log.largest_distance_mm = std::sqrt(static_cast<double>(made.largest_square_mm2));
    }
    for (std::size_t motor = 0; motor < asked_.motors(); ++motor) {
        log.motors.push_back({.asked_steps = asked_.steps(number, motor),
                              .made_steps = made_steps_[number * asked_.motors() + motor],
                              .slack_steps = slack(number, motor)});
    }
    if (number < details_.size()) { add_details(number, log); }
    return log;
}

void JobMoves::add_details(std::size_t number, MoveLog& log) const {
    const AskedMove& asked = *asked_.details(number);
    const Details& made = details_[number];
    log.length_mm = asked.length_mm;
    log.planned = asked.planned;
    log.late = made.late;
    log.skew = made.latest - made.earliest;
    if (made_[number].first != kNever) {
        log.first = made_[number].first;
        log.made = made.last - *log.first + asked.planned - asked.stepping;
    }
    for (std::size_t motor = 0; motor < asked_.motors(); ++motor) {
        log.motors[motor].peak_steps_per_tick = peaks_[number * asked_.motors() + motor].steps_per_tick;
        log.motors[motor].peak_steps_per_tick2 = peaks_[number * asked_.motors() + motor].steps_per_tick2;
    }
}

}  // namespace lockstep::analysis
