#include <algorithm>
#include <limits>
#include <span>
#include <vector>

#include "tests/simulation/simtest/check/checks.hpp"
#include "tests/simulation/simtest/record/epoch_runs.hpp"
#include "tests/simulation/simtest/record/explain.hpp"

namespace lockstep::simtest {
namespace {

constexpr double kRoundingSteps = 0.5 + 1e-3;

/// Where on the program an axis with this number of steps can be. A place is move + part of it, from 0 to the
/// number of moves.
class AxisPlace {
public:
    explicit AxisPlace(const AxisCourse& course) : course_(course) {
        made(0);
        may_have_made(0);
    }

    /// The axis has certainly made this number of steps. `steps` increases by one from call to call.
    void made(std::int64_t steps) { earliest_ = first_place(static_cast<double>(steps) - kRoundingSteps); }
    /// The axis may have made this number of steps, given its clock error. `steps` increases as above.
    void may_have_made(std::int64_t steps) { latest_ = last_place(static_cast<double>(steps) + kRoundingSteps); }
    double earliest() const { return earliest_; }
    double latest() const { return latest_; }

private:
    double travelled(std::size_t move) const { return static_cast<double>(course_.travelled[move]); }
    std::size_t moves() const { return course_.direction.size(); }
    double part(std::size_t move, double steps) const {
        return static_cast<double>(move) + (steps - travelled(move)) / (travelled(move + 1) - travelled(move));
    }

    double first_place(double steps) {
        if (steps <= 0) { return 0; }
        while (low_ < moves() && travelled(low_ + 1) < steps) { ++low_; }
        return low_ == moves() ? std::numeric_limits<double>::infinity() : part(low_, steps);
    }
    double last_place(double steps) {
        while (high_ < moves() && travelled(high_ + 1) <= steps) { ++high_; }
        return high_ == moves() ? static_cast<double>(moves()) : part(high_, steps);
    }

    const AxisCourse& course_;
    std::size_t low_ = 0;  // the moves that contained the last places
    std::size_t high_ = 0;
    double earliest_ = 0;
    double latest_ = 0;
};

/// All steps of a job in order of true time. A step can differ from its intended time by the clock error bound that
/// its axis has published. The check therefore counts it this much later for the axis that must not be ahead, and this
/// much earlier for the axis that must not be behind.
class TogetherCheck {
public:
    /// until: the time after which an axis is no longer bound to the others.
    TogetherCheck(const Recording& recording, const JobRecord& job, const std::vector<Tick>& until)
        : recording_(recording), job_(job) {
        for (std::size_t i = 0; i < recording.axes.size(); ++i) {
            axes_.push_back({i, recording.steps_of(job, i), until[i], AxisPlace(job.course.axes[i])});
            look_ahead(axes_.back());
        }
    }

    void check(Violations& violations) {
        for (Tick tick = next_tick(); tick != kNever; tick = next_tick()) {
            for (Axis& axis : axes_) { make_steps_until(tick, axis); }
            const Axis* ahead = nullptr;
            const Axis* behind = nullptr;
            for (const Axis& axis : axes_) {
                if (tick > axis.until) { continue; }
                if (ahead == nullptr || axis.place.earliest() > ahead->place.earliest()) { ahead = &axis; }
                if (behind == nullptr || axis.place.latest() < behind->place.latest()) { behind = &axis; }
            }
            if (ahead != nullptr && ahead->place.earliest() > behind->place.latest() + 1e-9) {
                return object(tick, *ahead, *behind, violations);
            }
        }
    }

private:
    static constexpr Tick kNever{std::numeric_limits<std::int64_t>::max()};

    struct Axis {
        std::size_t index = 0;
        std::span<const StepEdge> steps;
        Tick until;
        AxisPlace place;
        std::size_t made = 0;      // steps certainly made
        std::size_t may_have = 0;  // steps possibly made
        Tick next_made = kNever;   // latest time of the next step
        Tick next_may = kNever;
    };

    Tick next_tick() const { return std::ranges::min_element(axes_, {}, &Axis::next_made)->next_made; }

    /// The time error of a step: the clock error bound, the rounding in time, and the rounding in this check.
    Ticks error_at(std::size_t i, Tick truth) const {
        const bool own_clocks = recording_.machine.timing.time_source == TimeSource::Network;
        return own_clocks ? recording_.axes[i].bound_at(truth) + Ticks{3} : Ticks{};
    }
    Tick latest(std::size_t i, const StepEdge& step) const {
        const Tick truth = recording_.axes[i].truth(step);
        return truth + error_at(i, truth);
    }
    Tick earliest(std::size_t i, const StepEdge& step) const {
        const Tick truth = recording_.axes[i].truth(step);
        return truth - error_at(i, truth);
    }

    void look_ahead(Axis& axis) const {
        axis.next_made = axis.made < axis.steps.size() ? latest(axis.index, axis.steps[axis.made]) : kNever;
        axis.next_may = axis.may_have < axis.steps.size() ? earliest(axis.index, axis.steps[axis.may_have]) : kNever;
    }

    void make_steps_until(Tick tick, Axis& axis) const {
        while (axis.next_made <= tick) {
            axis.place.made(static_cast<std::int64_t>(++axis.made));
            look_ahead(axis);
        }
        while (axis.next_may <= tick) {
            axis.place.may_have_made(static_cast<std::int64_t>(++axis.may_have));
            look_ahead(axis);
        }
    }

    void object(Tick tick, const Axis& ahead, const Axis& behind, Violations& violations) const {
        violations.push_back({"together", ahead.index, tick.value, job_.first_step[ahead.index] + ahead.made - 1,
                              "it is at least at move " + std::to_string(ahead.place.earliest()) +
                                  " of the program, while axis " + recording_.machine.axes[behind.index].name +
                                  " is at most at " + std::to_string(behind.place.latest())});
    }

    const Recording& recording_;
    const JobRecord& job_;
    std::vector<Axis> axes_;
};

/// An axis is bound until an emergency stop; one that a fault may separate from the others, until that fault;
/// one that a switch may stop, until that stop.
std::vector<Tick> bound_until(const Recording& recording, const std::map<Epoch, EpochRuns>& epochs,
                              const JobRecord& job) {
    std::vector<Tick> until(recording.axes.size(), job.emergency.value_or(job.ended));
    for (const auto& [number, runs] : epochs) {
        if (!runs.apart || *runs.parted < job.began || *runs.parted > job.ended) { continue; }
        for (std::size_t i = 0; i < until.size(); ++i) {
            if (runs.may_differ[i]) { until[i] = std::min(until[i], *runs.parted); }
        }
    }
    for (const VirtualFault& fault : recording.faults) {
        const bool ends =
            (fault.kind == VirtualFault::Kind::Crash || fault.is_of_plant()) && fault.process < until.size();
        const bool in_job = fault.is_of_device() ? fault.end() >= job.began : fault.at >= job.began;
        if (!ends || !in_job) { continue; }
        until[fault.process] = std::min(until[fault.process], unread_from(fault, recording));
    }
    return until;
}

}  // namespace

Violations check_together(const Recording& recording) {
    Violations violations;
    const auto epochs = epoch_runs(recording);
    for (const JobRecord& job : recording.jobs) {
        if (!job.homing) { TogetherCheck(recording, job, bound_until(recording, epochs, job)).check(violations); }
    }
    return violations;
}

}  // namespace lockstep::simtest
