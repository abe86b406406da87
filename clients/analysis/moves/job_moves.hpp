// Compares the moves of a job as they were made, step by step, with the commanded ones.
//
// A motor makes exactly the steps of its moves, in order, also across holds and resumptions. The move of a step
// therefore follows from the motor's position, not from a clock: it is the next stroke through this position. Where a
// joined path was planned again behind a hold or an override, a reversal may be a step away from its planned place.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "clients/analysis/asked/asked_path.hpp"
#include "clients/analysis/measure/lateness.hpp"
#include "clients/analysis/measure/merged_steps.hpp"
#include "clients/analysis/measure/tick_histogram.hpp"
#include "clients/analysis/moves/move_cursor.hpp"
#include "clients/analysis/moves/move_details.hpp"
#include "clients/analysis/moves/move_log.hpp"
#include "clients/analysis/moves/path_distance.hpp"

namespace lockstep::analysis {

class JobMoves {
public:
    /// `on_a_line`: the motors move together, not each on its own.
    JobMoves(AskedPath asked, bool on_a_line);

    const AskedPath& asked() const { return asked_; }
    bool is_on_a_line() const { return on_a_line_ && asked_.size() > 0; }
    /// Call in the order of time. A step that comes late makes the distances since its move unknown. `ends_tick`: no
    /// other motor makes a step in this tick.
    void take(MotorIndex motor, const MeasuredStep& step, bool ends_tick = true);
    /// Takes and passes the steps before `until`.
    void take(MergedSteps& steps, MotorsOfLanes motor_of_lane, Tick until);
    void take(MotorIndex motor, EquallyLate late);

    /// From here on the path is planned again, behind a hold or an override.
    void plan_again() { is_planned_again_ = true; }
    /// Steps that belong to no move.
    std::int64_t unasked_steps() const { return unasked_steps_; }
    /// Whether the motor made fewer steps than commanded, because the log lacks some or the job ended earlier.
    bool lacks_steps_of(MotorIndex motor) const;
    /// The log has the motor's steps only until `until`. If it lacks steps, distances after `until` are unknown.
    void know_until(MotorIndex motor, Tick until);
    /// The number of moves with an unknown distance from the line.
    std::int64_t moves_without_distance() const;
    /// The program's line in motion at `tick`; nullopt before the first.
    std::optional<std::int32_t> line_at(Tick tick) const;
    /// How late the steps of all moves were, against the commanded ticks.
    const TickHistogram& late() const { return late_; }
    /// For moves without details, returns only the line, the steps of each motor and the distance.
    MoveLog move(std::size_t number) const;

private:
    static constexpr Tick kNever{std::numeric_limits<std::int64_t>::max()};

    struct Made {
        Tick first = kNever;            // of the lead motor's steps
        Tick newest;                    // of all motors' steps
        float largest_square_mm2 = 0;   // of the distance from the line
        bool is_distance_known = true;  // false if steps came late or are missing
    };
    /// Some steps of a motor that are all in its cursor's move.
    struct StepsOfMove {
        Tick first;
        Tick last;
        std::int64_t steps = 0;
        std::span<const StepRates> rates;
    };
    void take_in(std::size_t move, MotorIndex motor, const StepsOfMove& steps);
    Tick end_of_strokes(const MergedSteps& steps, MotorsOfLanes motor_of_lane, Tick until) const;
    void take_in_strokes(MergedSteps& steps, MotorsOfLanes motor_of_lane, Tick until);
    void begin(std::size_t move);
    void forget_distances(std::size_t from_move);
    std::int64_t slack(std::size_t move, MotorIndex motor) const {
        return is_planned_again_ ? asked_.slack(move, motor) : 0;
    }
    std::size_t first_move_that_lacks(MotorIndex motor) const;

    AskedPath asked_;
    bool on_a_line_;
    bool is_planned_again_ = false;
    std::vector<MoveCursor> made_cursor_;  // by motor
    std::vector<MoveCursor> late_cursor_;
    std::vector<Made> made_;                // by move
    std::vector<std::int64_t> made_steps_;  // by move and motor
    MoveDetails details_;
    TickHistogram late_;
    std::size_t current_ = 0;
    Tick newest_;  // of the steps so far
    PathDistance distance_;
    std::int64_t unasked_steps_ = 0;
};

}  // namespace lockstep::analysis
