#include "clients/analysis/moves/job_moves.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

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
    for (; steps < late.steps.size() && cursor.is_in_stroke(count, late.steps.direction(steps)); ++steps) {
        count += late.steps.direction(steps);
    }
    return std::max<std::size_t>(1, steps);
}

}  // namespace

JobMoves::JobMoves(AskedPath asked, bool on_a_line)
    : asked_(std::move(asked)),
      on_a_line_(on_a_line),
      made_cursor_(asked_.motors()),
      late_cursor_(asked_.motors()),
      made_(asked_.size()),
      made_steps_(asked_.size() * asked_.motors()) {
    if (asked_.size() == 0) { return; }
    details_ = MoveDetails(asked_);
    distance_ = PathDistance(asked_);
    begin(0);
}

void JobMoves::begin(std::size_t move) {
    current_ = move;
    if (on_a_line_) { distance_.begin(asked_, move); }
}

void JobMoves::take(MotorIndex motor, const MeasuredStep& step, bool ends_tick) {
    if (asked_.size() == 0) { return; }
    MoveCursor& cursor = made_cursor_[motor];
    const std::size_t move_before = cursor.move();
    const auto beyond = [&] { return slack(cursor.move(), motor); };
    if (cursor.find(asked_, motor, step.count - step.direction, step.direction, beyond)) {
        take_in(cursor.move(), motor, {step.tick, step.tick, 1, {&step.rates, 1}});
    } else {
        ++unasked_steps_;
    }
    const bool is_next = distance_.step(motor, step.count, step.direction);
    if (!on_a_line_) { return; }
    Made& made = made_[current_];
    if (!is_next) { forget_distances(move_before); }
    if (step.tick < newest_) { return forget_distances(std::min(cursor.move(), current_)); }
    newest_ = made.newest = step.tick;
    if (ends_tick || distance_.is_direct()) { distance_.measure(asked_, made.largest_square_mm2); }
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
        if (lane.steps.empty() || lane.steps.tick(0) >= until) { continue; }
        if (!motor_of_lane[i]) { return steps.tick(); }
        const MoveCursor& cursor = made_cursor_[*motor_of_lane[i]];
        const bool goes_on = lane.steps.is_one_way() && lane.count == distance_.count(*motor_of_lane[i]) &&
                             cursor.move() <= current_ && cursor.is_in_stroke(lane.count, lane.steps.direction(0));
        const auto most = goes_on ? static_cast<std::size_t>(cursor.steps_from(lane.count)) : 0;
        if (most < lane.steps.size()) { until = std::min(until, lane.steps.tick(most)); }
    }
    return until;
}

/// Takes the steps before a tick until which all motors continue their strokes.
void JobMoves::take_in_strokes(MergedSteps& steps, MotorsOfLanes motor_of_lane, Tick until) {
    const auto merged = steps.before(until);
    if (merged.empty()) { return; }
    for (std::size_t i = 0; i < steps.lanes().size(); ++i) {
        const MergedSteps::Lane& lane = steps.lanes()[i];
        const std::size_t count = lane.steps.before(until);
        if (count == 0) { continue; }
        const MotorIndex motor = *motor_of_lane[i];
        const std::size_t move = made_cursor_[motor].move();
        const StepsOfMove of{
            lane.steps.tick(0), lane.steps.tick(count - 1), static_cast<std::int64_t>(count), {lane.rates, count}};
        take_in(move, motor, of);
        if (!on_a_line_) { distance_.pass(motor, of.steps * lane.steps.direction(0)); }
    }
    if (on_a_line_) {
        Made& made = made_[current_];
        distance_.measure(asked_, merged, motor_of_lane, made.largest_square_mm2);
        newest_ = made.newest = steps.tick_of(merged.back());
    }
    steps.pass_before(until);
}

/// Called if later steps of other motors were compared with an outdated position of this motor.
void JobMoves::forget_distances(std::size_t from_move) {
    for (std::size_t move = from_move; move <= current_; ++move) { made_[move].is_distance_known = false; }
}

std::size_t JobMoves::first_move_that_lacks(MotorIndex motor) const {
    std::size_t move = 0;
    const auto has_all = [&] {
        return made_steps_[move * asked_.motors() + motor] + slack(move, motor) >= asked_.steps(move, motor);
    };
    while (move < asked_.size() && has_all()) { ++move; }
    return move;
}

bool JobMoves::lacks_steps_of(MotorIndex motor) const { return first_move_that_lacks(motor) < asked_.size(); }

void JobMoves::know_until(MotorIndex motor, Tick until) {
    for (std::size_t move = first_move_that_lacks(motor); move < asked_.size(); ++move) {
        if (made_[move].newest > until) { made_[move].is_distance_known = false; }
    }
}

std::int64_t JobMoves::moves_without_distance() const {
    return std::ranges::count(made_, false, &Made::is_distance_known);
}

void JobMoves::take_in(std::size_t move, MotorIndex motor, const StepsOfMove& steps) {
    if (move > current_) { begin(move); }
    const std::size_t place = move * asked_.motors() + motor;
    made_steps_[place] += steps.steps;
    const bool is_lead = motor == asked_.lead(move);
    if (is_lead && made_[move].first == kNever) { made_[move].first = steps.first; }
    if (!details_.has(move)) { return; }
    details_.add_rates(move, motor, steps.rates);
    if (is_lead) { details_.set_last(move, steps.last); }
}

void JobMoves::take(MotorIndex motor, EquallyLate late) {
    if (asked_.size() == 0) { return; }
    MoveCursor& cursor = late_cursor_[motor];
    const auto beyond = [&] { return slack(cursor.move(), motor); };
    while (true) {
        const bool is_found = cursor.find(asked_, motor, late.before, late.steps.front().direction, beyond);
        const std::size_t count = is_found ? steps_in_move(cursor, late) : 1;
        if (is_found) {
            late_.add(late.late, static_cast<std::int64_t>(count));
            if (details_.has(cursor.move())) { details_.add_late(cursor.move(), late.first(count)); }
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
    for (MotorIndex motor{0}; motor < asked_.motors(); ++motor) {
        log.motors.push_back({.asked_steps = asked_.steps(number, motor),
                              .made_steps = made_steps_[number * asked_.motors() + motor],
                              .slack_steps = slack(number, motor)});
    }
    if (details_.has(number)) {
        details_.write(*asked_.details(number), number, is_made ? std::optional(made.first) : std::nullopt, log);
    }
    return log;
}

}  // namespace lockstep::analysis
