// The moves of a job as they were made, step by step, compared with the commanded ones.
//
// An axis makes the steps of its moves in their order and no others, whatever holds and resumptions lie between. So
// the move of a step follows from the axis's position, not from any clock: it is the next move that leads through
// there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "clients/analysis/measure/asked_path.hpp"
#include "clients/analysis/measure/lateness.hpp"
#include "clients/analysis/measure/measured_step.hpp"
#include "clients/analysis/measure/tick_histogram.hpp"

namespace lockstep::analysis {

/// One axis in one move.
struct AxisMove {
    std::int64_t asked_steps = 0;
    std::int64_t made_steps = 0;
    double peak_steps_per_tick = 0;  // from SpeedMeter: a window may reach into the move before
    double peak_steps_per_tick2 = 0;
};

struct MoveLog {
    std::int32_t line = 0;  // of the program
    double length_mm = 0;
    Ticks planned;
    /// Total duration: between its first step and its last, plus the planned times before and after. None: no steps.
    std::optional<Ticks> made;
    /// Of any step from the commanded line. None if axes moved on their own, or steps came too late in the log.
    std::optional<double> largest_distance_mm;
    std::optional<Tick> first;   // of the steps of the axis that has the most
    TickHistogram late;          // of its steps, against the commanded ticks
    Ticks skew;                  // from its earliest step to its latest, relative to these
    std::vector<AxisMove> axes;  // in the machine's order
    bool is_dwell = false;
    bool is_whole() const;
};

/// Finds the next move through a place, of one axis.
class MoveCursor {
public:
    /// Goes to the move in which an axis steps from `count` in `direction`. False: no such move is near.
    bool find(const AskedPath& asked, std::size_t axis, std::int64_t count, int direction) {
        return is_in_move(count, direction) || find_next(asked, axis, count, direction);
    }
    bool is_in_move(std::int64_t count, int direction) const {
        return direction == direction_ && low_ <= count && count < high_;
    }
    /// The steps from `count` on to the end of the move that leads through there.
    std::int64_t steps_from(std::int64_t count) const { return direction_ > 0 ? high_ - count : count - low_ + 1; }
    /// Its number.
    std::size_t move() const { return move_; }

private:
    static constexpr std::size_t kReach = 64;  // moves that may be missing from the log

    bool find_next(const AskedPath& asked, std::size_t axis, std::int64_t count, int direction);

    std::size_t next_ = 0;  // of the axis's moves
    std::size_t move_ = 0;  // the one found last: it leads through counts from low_ up to high_, exclusive
    int direction_ = 0;
    std::int64_t low_ = 0;
    std::int64_t high_ = 0;
};

class JobMoves {
public:
    /// `on_a_line`: axes move together, not each on its own.
    JobMoves(AskedPath asked, bool on_a_line);

    const AskedPath& asked() const { return asked_; }
    bool is_on_a_line() const { return on_a_line_ && asked_.size() > 0; }
    /// In the order of time. A step that comes late makes the distances since its move unknown.
    void take(std::size_t axis, const MeasuredStep& step);
    void take(std::size_t axis, LateSteps late);

    /// Steps that belong to no move.
    std::int64_t unasked_steps() const { return unasked_steps_; }
    /// The axis made fewer steps than commanded: the log lacks some, or the job ended before they were made.
    bool lacks_steps_of(std::size_t axis) const;
    /// The log has the axis's steps until then and no further: if it lacks steps, distances since then are unknown.
    void know_until(std::size_t axis, Tick until);
    /// Moves whose distance from the line is unknown.
    std::int64_t moves_without_distance() const;
    /// The program's line in motion; none before the first.
    std::optional<std::int32_t> line_at(Tick tick) const;
    /// How late the steps of all moves were, against the commanded ticks.
    const TickHistogram& late() const { return late_; }
    /// Of moves without details it has the line, the steps of each axis and the distance only.
    MoveLog move(std::size_t number) const;

private:
    static constexpr Tick kNever{std::numeric_limits<std::int64_t>::max()};

    struct Made {
        Tick first = kNever;            // of the lead axis's steps
        Tick newest;                    // of all axes' steps
        float largest_square_mm2 = 0;   // of the distance from its line...
        bool is_distance_known = true;  // ...but for steps that came late
    };
    struct Peak {
        float steps_per_tick = 0;
        float steps_per_tick2 = 0;
    };
    struct Details {
        Tick last;  // of the lead axis's steps
        TickHistogram late;
        Ticks earliest;  // of how late its steps were
        Ticks latest;
        std::vector<Peak> peaks;  // by axis
        void add(std::span<const LateStep> equally_late);
    };
    /// One axis's part in the current move's line, and where the axis is.
    struct Part {
        std::int64_t count = 0;
        double from_mm = 0;
        double direction = 0;  // of all axes together of length 1
        double at_mm = 0;
        double off_mm = 0;    // from from_mm
        double along_mm = 0;  // its share of the way along the line
    };

    void take_in(std::size_t move, std::size_t axis, const MeasuredStep& step);
    void begin(std::size_t move);
    void stand(Part& part, double at_mm);
    double square_of_distance_mm2() const;
    void forget_distances(std::size_t from_move);
    std::size_t first_move_that_lacks(std::size_t axis) const;
    void add_details(std::size_t number, MoveLog& log) const;

    AskedPath asked_;
    bool on_a_line_;
    std::vector<MoveCursor> made_cursor_;  // by axis
    std::vector<MoveCursor> late_cursor_;
    std::vector<Made> made_;                // by move
    std::vector<std::int64_t> made_steps_;  // by move and axis
    std::vector<Details> details_;          // of the first moves
    TickHistogram late_;
    std::size_t current_ = 0;
    Tick newest_;             // of the steps taken
    std::vector<Part> line_;  // of the current move, by axis
    double line_length_mm_ = 0;
    std::int64_t unasked_steps_ = 0;
};

}  // namespace lockstep::analysis
