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
#include "clients/analysis/measure/distance_bound.hpp"
#include "clients/analysis/measure/lateness.hpp"
#include "clients/analysis/measure/merged_steps.hpp"
#include "clients/analysis/measure/tick_histogram.hpp"

namespace lockstep::analysis {

/// One motor in one move.
struct MotorMove {
    std::int64_t asked_steps = 0;
    std::int64_t made_steps = 0;
    std::int64_t slack_steps = 0;    // by which a correct job may differ here (AskedPath::slack)
    double peak_steps_per_tick = 0;  // from SpeedMeter; its window may reach into the previous move
    double peak_steps_per_tick2 = 0;
};

struct MoveLog {
    std::int32_t line = 0;  // of the program
    double length_mm = 0;
    Ticks planned;
    /// Total duration: from the lead motor's first step to its last, plus the planned times before and after. nullopt
    /// without steps.
    std::optional<Ticks> made;
    /// Of the place after any step from the commanded line; of machines whose motors are not their axes, after all
    /// steps of a tick. nullopt if motors moved on their own, or if steps are missing or came too late in the log.
    std::optional<double> largest_distance_mm;
    std::optional<Tick> first;      // step of the motor with the most steps
    TickHistogram late;             // of its steps, against the commanded ticks
    Ticks skew;                     // largest lateness of its steps minus the smallest
    std::vector<MotorMove> motors;  // in the order of motors_of
    bool is_whole() const;
};

/// Finds the next stroke of one motor through a place.
class MoveCursor {
public:
    /// Goes to the stroke in which a motor steps from `count` in `direction`. Returns false if none of the next kReach
    /// strokes is it.
    /// `beyond()`: steps by which a reversal may be later than planned.
    template <typename Beyond>
    bool find(const AskedPath& asked, std::size_t motor, std::int64_t count, int direction, Beyond&& beyond) {
        return is_in_stroke(count, direction) || find_next(asked, motor, count, direction, beyond());
    }
    bool is_in_stroke(std::int64_t count, int direction) const { return stroke_.has(count, direction); }
    /// The number of steps from `count` to the end of the stroke.
    std::int64_t steps_from(std::int64_t count) const { return (stroke_.to - count) * stroke_.direction(); }
    /// The number of the move.
    std::size_t move() const { return stroke_.move; }

private:
    static constexpr std::size_t kReach = 64;  // strokes searched, because steps may be missing from the log
    static constexpr std::size_t kNear = 3;    // strokes of which one is likely

    bool find_next(const AskedPath& asked, std::size_t motor, std::int64_t count, int direction, std::int64_t beyond);
    bool find_among(const AskedPath& asked, std::size_t motor, std::size_t first, std::size_t end, std::int64_t count,
                    int direction);

    std::size_t next_ = 0;      // index in the motor's strokes
    AskedPath::Stroke stroke_;  // found last
};

class JobMoves {
public:
    /// `on_a_line`: the motors move together, not each on its own.
    JobMoves(AskedPath asked, bool on_a_line);

    const AskedPath& asked() const { return asked_; }
    bool is_on_a_line() const { return on_a_line_ && asked_.size() > 0; }
    /// Call in the order of time. A step that comes late makes the distances since its move unknown.
    void take(std::size_t motor, const MeasuredStep& step) { take(motor, step, true); }
    /// nullopt for a motor that the job does not have.
    using MotorsOfLanes = std::span<const std::optional<std::size_t>>;
    /// Takes and passes the steps before `until`.
    void take(MergedSteps& steps, MotorsOfLanes motor_of_lane, Tick until);
    void take(std::size_t motor, EquallyLate late);

    /// From here on the path is planned again, behind a hold or an override.
    void plan_again() { is_planned_again_ = true; }
    /// Steps that belong to no move.
    std::int64_t unasked_steps() const { return unasked_steps_; }
    /// Whether the motor made fewer steps than commanded, because the log lacks some or the job ended earlier.
    bool lacks_steps_of(std::size_t motor) const;
    /// The log has the motor's steps only until `until`. If it lacks steps, distances after `until` are unknown.
    void know_until(std::size_t motor, Tick until);
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
    struct Details {
        Tick last;  // of the lead motor's steps
        TickHistogram late;
        Ticks earliest;  // smallest lateness of its steps
        Ticks latest;
        void add(const EquallyLate& steps);
    };
    /// Some steps of a motor that are all in its cursor's move.
    struct StepsOfMove {
        Tick first;
        Tick last;
        std::int64_t steps = 0;
        StepRates peak;
    };
    void take_in(std::size_t move, std::size_t motor, const StepsOfMove& steps);
    static StepRates peak_of(std::span<const StepRates> rates);
    Tick end_of_strokes(const MergedSteps& steps, MotorsOfLanes motor_of_lane, Tick until) const;
    void take_in_strokes(MergedSteps& steps, MotorsOfLanes motor_of_lane, Tick until);
    void take(std::size_t motor, const MeasuredStep& step, bool ends_tick);
    void measure_distances(std::span<const MergedStep> steps, MotorsOfLanes motor_of_lane);
    std::size_t note_places(std::span<const MergedStep> steps, MotorsOfLanes motor_of_lane);
    void note_block(std::span<const MergedStep, Places::kMost> steps, MotorsOfLanes motor_of_lane);
    void note_place(std::size_t number);
    void measure_places(float& largest);
    void begin(std::size_t move);
    double square_of_distance_mm2();
    void forget_distances(std::size_t from_move);
    std::int64_t slack(std::size_t move, std::size_t motor) const {
        return is_planned_again_ ? asked_.slack(move, motor) : 0;
    }
    std::size_t first_move_that_lacks(std::size_t motor) const;
    void add_details(std::size_t number, MoveLog& log) const;

    AskedPath asked_;
    bool on_a_line_;
    bool is_planned_again_ = false;
    std::vector<MoveCursor> made_cursor_;  // by motor
    std::vector<MoveCursor> late_cursor_;
    std::vector<Made> made_;                // by move
    std::vector<std::int64_t> made_steps_;  // by move and motor
    std::vector<Details> details_;          // of the first moves only
    std::vector<StepRates> peaks_;          // of these moves, by move and motor
    TickHistogram late_;
    std::size_t current_ = 0;
    Tick newest_;                       // of the steps so far
    std::vector<std::int64_t> counts_;  // of each motor, after its newest step
    AxisPlaces axes_;
    std::vector<double> at_mm_;  // of each axis, after these steps
    AskedShape shape_;           // of the current move
    DistanceBound bound_;        // of the distance from it
    Places places_;              // after the steps that are being measured
    double near_mm2_ = 0;        // the square of what a step of each motor moves the axes
    std::int64_t unasked_steps_ = 0;
};

}  // namespace lockstep::analysis
