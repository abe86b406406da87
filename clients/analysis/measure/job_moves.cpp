#include "clients/analysis/measure/job_moves.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lockstep::analysis {
namespace {

/// The number of steps, counted from the first, that are in the cursor's move. The first step is in it.
std::size_t steps_in_move(const MoveCursor& cursor, std::span<const LateStep> steps) {
    const LateStep& first = steps.front();
    const std::int64_t way = (steps.back().count - first.count) * first.direction;
    if (way + 1 == std::ssize(steps)) {  // no step reverses
        return static_cast<std::size_t>(std::min(way + 1, cursor.steps_from(first.count - first.direction)));
    }
    const auto is_elsewhere = [&](const LateStep& step) {
        return !cursor.is_in_move(step.count - step.direction, step.direction);
    };
    return static_cast<std::size_t>(std::ranges::find_if(steps, is_elsewhere) - steps.begin());
}

}  // namespace

bool MoveLog::is_whole() const {
    return std::ranges::all_of(axes, [](const AxisMove& axis) { return axis.made_steps == axis.asked_steps; });
}

bool MoveCursor::find_next(const AskedPath& asked, std::size_t axis, std::int64_t count, int direction) {
    const auto& moves = asked.moves_of(axis);
    const std::size_t end = std::min(moves.size(), next_ + kReach);
    for (std::size_t i = next_; i < end; ++i) {
        const std::int64_t from = asked.from(moves[i], axis);
        const std::int64_t to = asked.to(moves[i], axis);
        const std::int64_t low = direction > 0 ? from : to + 1;
        const std::int64_t high = direction > 0 ? to : from + 1;
        if (low <= count && count < high) {
            next_ = i;
            move_ = moves[i];
            direction_ = direction;
            low_ = low;
            high_ = high;
            return true;
        }
    }
    return false;
}

JobMoves::JobMoves(AskedPath asked, bool on_a_line)
    : asked_(std::move(asked)),
      on_a_line_(on_a_line),
      made_cursor_(asked_.axes()),
      late_cursor_(asked_.axes()),
      made_(asked_.size()),
      made_steps_(asked_.size() * asked_.axes()),
      line_(asked_.axes()) {
    if (asked_.size() == 0) { return; }
    while (asked_.details(details_.size()) != nullptr) { details_.emplace_back().peaks.resize(asked_.axes()); }
    for (std::size_t axis = 0; axis < asked_.axes(); ++axis) {
        line_[axis].count = asked_.from(0, axis);
        line_[axis].at_mm = static_cast<double>(line_[axis].count) * asked_.mm_per_step(axis);
    }
    begin(0);
}

void JobMoves::begin(std::size_t move) {
    current_ = move;
    double squares = 0;
    for (std::size_t axis = 0; axis < asked_.axes(); ++axis) {
        const std::int64_t steps = asked_.to(move, axis) - asked_.from(move, axis);
        line_[axis].from_mm = static_cast<double>(asked_.from(move, axis)) * asked_.mm_per_step(axis);
        line_[axis].direction = static_cast<double>(steps) * asked_.mm_per_step(axis);
        squares += line_[axis].direction * line_[axis].direction;
    }
    line_length_mm_ = std::sqrt(squares);
    for (Part& part : line_) {
        if (line_length_mm_ > 0) { part.direction /= line_length_mm_; }
        stand(part, part.at_mm);
    }
}

void JobMoves::stand(Part& part, double at_mm) {
    part.at_mm = at_mm;
    part.off_mm = at_mm - part.from_mm;
    part.along_mm = part.off_mm * part.direction;
}

/// The square of the distance from the axes' position to the nearest point of the line.
double JobMoves::square_of_distance_mm2() const {
    double along = 0;
    for (const Part& part : line_) { along += part.along_mm; }
    along = std::clamp(along, 0.0, line_length_mm_);
    double squares = 0;
    for (const Part& part : line_) {
        const double off = part.off_mm - along * part.direction;
        squares += off * off;
    }
    return squares;
}

void JobMoves::take(std::size_t axis, const MeasuredStep& step) {
    if (asked_.size() == 0) { return; }
    MoveCursor& cursor = made_cursor_[axis];
    const std::size_t move_before = cursor.move();
    if (cursor.find(asked_, axis, step.count - step.direction, step.direction)) {
        take_in(cursor.move(), axis, step);
    } else {
        ++unasked_steps_;
    }
    const bool is_next = std::exchange(line_[axis].count, step.count) == step.count - step.direction;
    stand(line_[axis], static_cast<double>(step.count) * asked_.mm_per_step(axis));
    if (!on_a_line_) { return; }
    if (!is_next) { forget_distances(move_before); }
    if (step.tick < newest_) { return forget_distances(std::min(cursor.move(), current_)); }
    newest_ = made_[current_].newest = step.tick;
    float& largest = made_[current_].largest_square_mm2;
    largest = std::max(largest, static_cast<float>(square_of_distance_mm2()));
}

/// Called if later steps of other axes were compared with an outdated position of this axis.
void JobMoves::forget_distances(std::size_t from_move) {
    for (std::size_t move = from_move; move <= current_; ++move) { made_[move].is_distance_known = false; }
}

std::size_t JobMoves::first_move_that_lacks(std::size_t axis) const {
    std::size_t move = 0;
    const auto has_all = [&] { return made_steps_[move * asked_.axes() + axis] == asked_.steps(move, axis); };
    while (move < asked_.size() && has_all()) { ++move; }
    return move;
}

bool JobMoves::lacks_steps_of(std::size_t axis) const { return first_move_that_lacks(axis) < asked_.size(); }

void JobMoves::know_until(std::size_t axis, Tick until) {
    for (std::size_t move = first_move_that_lacks(axis); move < asked_.size(); ++move) {
        if (made_[move].newest > until) { made_[move].is_distance_known = false; }
    }
}

std::int64_t JobMoves::moves_without_distance() const {
    return std::ranges::count(made_, false, &Made::is_distance_known);
}

void JobMoves::take_in(std::size_t move, std::size_t axis, const MeasuredStep& step) {
    if (move > current_) { begin(move); }
    ++made_steps_[move * asked_.axes() + axis];
    const bool is_lead = axis == asked_.lead(move);
    if (is_lead && made_[move].first == kNever) { made_[move].first = step.tick; }
    if (move >= details_.size()) { return; }
    Peak& peak = details_[move].peaks[axis];
    peak.steps_per_tick = std::max(peak.steps_per_tick, static_cast<float>(step.steps_per_tick));
    peak.steps_per_tick2 = std::max(peak.steps_per_tick2, static_cast<float>(step.steps_per_tick2));
    if (is_lead) { details_[move].last = step.tick; }
}

void JobMoves::Details::add(std::span<const LateStep> equally_late) {
    const Ticks amount = equally_late.front().late;
    earliest = late.empty() ? amount : std::min(earliest, amount);
    latest = late.empty() ? amount : std::max(latest, amount);
    late.add(amount, std::ssize(equally_late));
}

void JobMoves::take(std::size_t axis, LateSteps late) {
    if (asked_.size() == 0) { return; }
    MoveCursor& cursor = late_cursor_[axis];
    while (!late.steps.empty()) {
        const LateStep& first = late.steps.front();
        const bool found = cursor.find(asked_, axis, first.count - first.direction, first.direction);
        const std::size_t count = found ? steps_in_move(cursor, late.steps) : 1;
        if (found) {
            for_equally_late(late.first(count), [&](std::span<const LateStep> equal) {
                late_.add(equal.front().late, std::ssize(equal));
                if (cursor.move() < details_.size()) { details_[cursor.move()].add(equal); }
            });
        }
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
    for (std::size_t axis = 0; axis < asked_.axes(); ++axis) {
        log.axes.push_back({asked_.steps(number, axis), made_steps_[number * asked_.axes() + axis]});
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
    for (std::size_t axis = 0; axis < asked_.axes(); ++axis) {
        log.axes[axis].peak_steps_per_tick = made.peaks[axis].steps_per_tick;
        log.axes[axis].peak_steps_per_tick2 = made.peaks[axis].steps_per_tick2;
    }
}

}  // namespace lockstep::analysis
