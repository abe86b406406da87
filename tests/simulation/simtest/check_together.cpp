#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "tests/simulation/simtest/checks.hpp"
#include "tests/simulation/simtest/epoch_runs.hpp"

namespace lockstep::simtest {
namespace {

constexpr double kRoundingSteps = 0.5 + 1e-3;

/// Where on the program an axis that has made so many steps can be: places are move + part of it, from 0 to the
/// number of moves.
class AxisPlace {
public:
    explicit AxisPlace(const AxisCourse& course) : course_(course) {
        made(0);
        may_have_made(0);
    }

    /// It has certainly made so many. steps rises by one from call to call.
    void made(std::int64_t steps) { earliest_ = first_place(static_cast<double>(steps) - kRoundingSteps); }
    /// It may have made so many, by what its clock is known to. Likewise.
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
    std::size_t low_ = 0;  // the moves in which the places were last found
    std::size_t high_ = 0;
    double earliest_ = 0;
    double latest_ = 0;
};

/// All axes' steps of a job in order of true time. A step is where its axis's clock was to put it within the bound that
/// the axis has published: it counts as made so much later for what must not be ahead, and so much earlier for what
/// must not be behind.
class TogetherCheck {
public:
    /// until: when an axis is no longer bound to the others.
    TogetherCheck(const Recording& recording, const JobRecord& job, std::vector<Tick> until)
        : recording_(recording),
          job_(job),
          until_(std::move(until)),
          made_(recording.axes.size(), 0),
          may_(recording.axes.size(), 0) {
        for (const AxisCourse& course : job.course.axes) { places_.emplace_back(course); }
    }

    void check(Violations& violations) {
        while (const auto tick = next_tick()) {
            for (std::size_t i = 0; i < made_.size(); ++i) { make_steps_at(*tick, i); }
            std::optional<std::size_t> ahead, behind;
            for (std::size_t i = 0; i < made_.size(); ++i) {
                if (*tick > until_[i]) { continue; }
                if (!ahead || places_[i].earliest() > places_[*ahead].earliest()) { ahead = i; }
                if (!behind || places_[i].latest() < places_[*behind].latest()) { behind = i; }
            }
            if (ahead && places_[*ahead].earliest() > places_[*behind].latest() + 1e-9) {
                return object(*tick, *ahead, *behind, violations);
            }
        }
    }

private:
    std::optional<Tick> next_tick() const {
        std::optional<Tick> next;
        for (std::size_t i = 0; i < made_.size(); ++i) {
            const auto steps = recording_.steps_of(job_, i);
            if (made_[i] == steps.size()) { continue; }
            const Tick certain = latest(i, steps[made_[i]]);
            if (!next || certain < *next) { next = certain; }
        }
        return next;
    }

    /// What a step may be off: the bound, what rounding in time leaves, and what it leaves here.
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

    void make_steps_at(Tick tick, std::size_t i) {
        const auto steps = recording_.steps_of(job_, i);
        while (made_[i] < steps.size() && latest(i, steps[made_[i]]) <= tick) {
            places_[i].made(static_cast<std::int64_t>(++made_[i]));
        }
        while (may_[i] < steps.size() && earliest(i, steps[may_[i]]) <= tick) {
            places_[i].may_have_made(static_cast<std::int64_t>(++may_[i]));
        }
    }

    void object(Tick tick, std::size_t ahead, std::size_t behind, Violations& violations) const {
        violations.push_back({"together", ahead, tick.value, job_.first_step[ahead] + made_[ahead] - 1,
                              "it is at move " + std::to_string(places_[ahead].earliest()) +
                                  " of the program at least, while axis " + recording_.machine.axes[behind].name +
                                  " is at " + std::to_string(places_[behind].latest()) + " at most"});
    }

    const Recording& recording_;
    const JobRecord& job_;
    std::vector<Tick> until_;
    std::vector<std::size_t> made_;
    std::vector<std::size_t> may_;
    std::vector<AxisPlace> places_;
};

/// Until pulses are told to cease; an axis that a fault may part from the others, until it has.
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
        const bool ends = fault.kind == VirtualFault::Kind::Crash && fault.process < until.size();
        if (ends && fault.at >= job.began) { until[fault.process] = std::min(until[fault.process], fault.at); }
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
