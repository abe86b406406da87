#include <algorithm>
#include <limits>

#include "tests/simulation/simtest/checks.hpp"

namespace lockstep::simtest {
namespace {

constexpr double kRoundingSteps = 0.5 + 1e-3;

/// Where on the program an axis that has made so many steps can be: places are move + part of it, from 0 to the
/// number of moves.
class AxisPlace {
public:
    explicit AxisPlace(const AxisCourse& course) : course_(course) { made(0); }

    /// steps rises by one from call to call.
    void made(std::int64_t steps) {
        const auto n = static_cast<double>(steps);
        earliest_ = first_place(n - kRoundingSteps);
        latest_ = last_place(n + kRoundingSteps);
    }
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

/// All axes' steps of a job in order of time.
class TogetherCheck {
public:
    TogetherCheck(const Recording& recording, const JobRecord& job)
        : recording_(recording), job_(job), made_(recording.axes.size(), 0) {
        for (const AxisCourse& course : job.course.axes) { places_.emplace_back(course); }
    }

    void check(Violations& violations) {
        while (const auto tick = next_tick()) {
            for (std::size_t i = 0; i < made_.size(); ++i) { make_steps_at(*tick, i); }
            const auto latest_start = std::ranges::max_element(places_, {}, &AxisPlace::earliest);
            const auto earliest_end = std::ranges::min_element(places_, {}, &AxisPlace::latest);
            if (latest_start->earliest() > earliest_end->latest() + 1e-9) {
                return object(*tick, static_cast<std::size_t>(latest_start - places_.begin()),
                              static_cast<std::size_t>(earliest_end - places_.begin()), violations);
            }
        }
    }

private:
    std::optional<Tick> next_tick() const {
        std::optional<Tick> next;
        for (std::size_t i = 0; i < made_.size(); ++i) {
            const auto steps = recording_.steps_of(job_, i);
            if (made_[i] < steps.size() && (!next || steps[made_[i]].tick < *next)) { next = steps[made_[i]].tick; }
        }
        return next;
    }

    void make_steps_at(Tick tick, std::size_t i) {
        const auto steps = recording_.steps_of(job_, i);
        while (made_[i] < steps.size() && steps[made_[i]].tick <= tick) {
            places_[i].made(static_cast<std::int64_t>(++made_[i]));
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
    std::vector<std::size_t> made_;
    std::vector<AxisPlace> places_;
};

}  // namespace

Violations check_together(const Recording& recording) {
    Violations violations;
    for (const JobRecord& job : recording.jobs) {
        if (!job.homing) { TogetherCheck(recording, job).check(violations); }
    }
    return violations;
}

}  // namespace lockstep::simtest
