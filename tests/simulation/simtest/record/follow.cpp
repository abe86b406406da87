#include "tests/simulation/simtest/record/follow.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/simulation/simtest/record/explain.hpp"

namespace lockstep::simtest {
namespace {

constexpr Tick kNever{std::numeric_limits<std::int64_t>::max()};
constexpr double kHair = 1e-9;

/// The counts that an axis may have; nullopt: any count.
using Range = std::optional<std::pair<double, double>>;

/// The part of a stretch, from 0 to 1, that fits an axis's counts. The axis's place is linear in this part.
Reached part_that_fits(double from, double to, const Range& counts, double within) {
    if (!counts) { return {0, 1}; }
    const double low = counts->first - within - from;
    const double high = counts->second + within - from;
    const double way = to - from;
    if (std::abs(way) < kHair) { return low <= kHair && high >= -kHair ? Reached{0, 1} : Reached{1, 0}; }
    const double a = low / way;
    const double b = high / way;
    return {std::max(0.0, std::min(a, b)), std::min(1.0, std::max(a, b))};
}

class ReachedPlaces {
public:
    explicit ReachedPlaces(const Course& course) : course_(course) {}

    /// To be called when more counts are possible.
    void widen(const std::vector<Range>& counts) { reached_ = extended(reached_, counts); }
    /// To be called when fewer counts are possible. Returns false, and changes nothing, if no place is left.
    bool narrow(const std::vector<Range>& counts) {
        std::vector<Reached> left;
        for (const Reached& places : reached_) { cut(places, counts, left); }
        if (left.empty()) { return false; }
        fitting_ = {left.front().first, left.back().last};
        reached_ = extended(left, counts);
        return true;
    }
    /// The places that fit right after the counts were narrowed.
    const Reached& fitting() const { return fitting_; }
    Reached reached() const { return {reached_.front().first, reached_.back().last}; }

private:
    Reached part(std::size_t stretch, const std::vector<Range>& counts) const {
        Reached part{0, 1};
        const Stretch& here = course_.stretches[stretch];
        for (std::size_t i = 0; i < counts.size(); ++i) {
            const Reached its = part_that_fits(course_.at(stretch, i), here.to[i], counts[i], here.within);
            part = {std::max(part.first, its.first), std::min(part.last, its.last)};
        }
        const auto number = static_cast<double>(stretch);
        return {number + part.first, number + part.last};
    }

    static void join(const Reached& places, std::vector<Reached>& all) {
        if (!all.empty() && all.back().last >= places.first - kHair) {
            all.back().last = std::max(all.back().last, places.last);
        } else {
            all.push_back(places);
        }
    }

    /// A place at a joint is also the end of the previous stretch.
    void cut(const Reached& places, const std::vector<Range>& counts, std::vector<Reached>& left) const {
        auto k = static_cast<std::size_t>(std::max(0.0, std::floor(places.first - kHair)));
        for (; k < course_.stretches.size() && static_cast<double>(k) <= places.last + kHair; ++k) {
            const Reached fits = part(k, counts);
            const Reached both{std::max(fits.first, places.first), std::min(fits.last, places.last)};
            if (both.first <= both.last + kHair) { join(both, left); }
        }
    }

    std::vector<Reached> extended(const std::vector<Reached>& places, const std::vector<Range>& counts) const {
        std::vector<Reached> all;
        for (const Reached& some : places) {
            join(some, all);
            all.back().last = furthest(all.back().last, counts);
        }
        return all;
    }
    double furthest(double place, const std::vector<Range>& counts) const {
        for (auto k = static_cast<std::size_t>(place + kHair); k < course_.stretches.size(); ++k) {
            const Reached fits = part(k, counts);
            if (fits.first > place + kHair || fits.last < place - kHair) { break; }
            place = std::max(place, fits.last);
            if (place < static_cast<double>(k + 1) - kHair) { break; }
        }
        return place;
    }

    const Course& course_;
    std::vector<Reached> reached_{{0, 0}};  // separate ranges, in order
    Reached fitting_;
};

/// Follows all steps of a job in order of true time.
class Follower {
public:
    Follower(const Recording& recording, const JobRecord& job, const std::vector<Tick>& until)
        : recording_(recording), places_(job.course), counts_(recording.motors.size()) {
        for (std::size_t i = 0; i < recording.motors.size(); ++i) {
            Axis axis{
                .index = i, .steps = recording.steps_of(job, i), .until = until[i], .counts = {job.course.from[i]}};
            for (const std::int64_t way : recording.slide_ways(job, i)) {
                axis.counts.push_back(axis.counts.back() + way);
            }
            for (const StepEdge& step : axis.steps) { axis.times.push_back(times_of(i, step)); }
            look_ahead(axis);
            axes_.push_back(std::move(axis));
            following_.at_step.emplace_back(axes_.back().steps.size(), Reached{0, job.course.end()});
            counts_[i] = range(axes_.back());
        }
        places_.widen(counts_);
    }

    Following take() {
        for (Tick tick = next_tick(); tick != kNever && !following_.departure; tick = next_tick()) { advance(tick); }
        following_.end = places_.reached();
        return std::move(following_);
    }

private:
    struct StepTimes {
        Tick earliest;
        Tick latest;
    };
    struct Axis {
        std::size_t index = 0;
        std::span<const StepEdge> steps;
        Tick until;
        std::vector<std::int64_t> counts;  // of its slide, after each number of steps
        std::vector<StepTimes> times{};
        std::size_t made = 0;      // steps certainly made
        std::size_t may_have = 0;  // steps possibly made
        Tick next_made = kNever;   // latest time of the next step
        Tick next_may = kNever;
        double earliest = 0;  // earliest place of its next step; it stays once the axis is not bound
    };

    Tick next_tick() const { return std::ranges::min_element(axes_, {}, &Axis::next_made)->next_made; }

    static Range range(const Axis& axis) {
        const auto [low, high] =
            std::minmax_element(axis.counts.begin() + static_cast<std::ptrdiff_t>(axis.made),
                                axis.counts.begin() + static_cast<std::ptrdiff_t>(axis.may_have) + 1);
        return std::pair{static_cast<double>(*low), static_cast<double>(*high)};
    }

    void advance(Tick tick) {
        for (Axis& axis : axes_) { make_possible(tick, axis); }
        places_.widen(counts_);
        std::size_t last = 0;
        for (Axis& axis : axes_) {
            if (axis.next_made <= tick) { last = axis.index; }
            make_certain(tick, axis);
        }
        if (!places_.narrow(counts_)) {
            following_.departure = {last, tick, axes_[last].made - 1, places_.reached()};
            return;
        }
        for (Axis& axis : axes_) {
            for (std::size_t n = axis.made; n > 0 && axis.times[n - 1].latest == tick; --n) {
                if (tick <= axis.until) { following_.at_step[axis.index][n - 1].last = places_.fitting().last; }
            }
        }
    }

    void make_possible(Tick tick, Axis& axis) {
        while (axis.next_may <= tick) {
            if (tick <= axis.until) { axis.earliest = places_.reached().first; }
            following_.at_step[axis.index][axis.may_have++].first = axis.earliest;
            look_ahead(axis);
        }
        counts_[axis.index] = tick > axis.until ? Range{} : range(axis);
    }
    void make_certain(Tick tick, Axis& axis) {
        while (axis.next_made <= tick) {
            ++axis.made;
            look_ahead(axis);
        }
        counts_[axis.index] = tick > axis.until ? Range{} : range(axis);
    }

    /// The time error of a step: the clock error bound, the rounding in time, and the rounding in this check.
    Ticks error_at(std::size_t i, Tick truth) const {
        return estimates_clock(recording_.machine, MotorIndex{i}) ? recording_.motors[i].bound_at(truth) + Ticks{3}
                                                                  : Ticks{};
    }
    StepTimes times_of(std::size_t i, const StepEdge& step) const {
        const Tick truth = recording_.motors[i].truth(step);
        const Ticks error = error_at(i, truth);
        return {truth - error, truth + error};
    }
    static void look_ahead(Axis& axis) {
        axis.next_made = axis.made < axis.steps.size() ? axis.times[axis.made].latest : kNever;
        axis.next_may = axis.may_have < axis.steps.size() ? axis.times[axis.may_have].earliest : kNever;
    }

    const Recording& recording_;
    ReachedPlaces places_;
    std::vector<Axis> axes_;
    std::vector<Range> counts_;
    Following following_;
};

}  // namespace

Following follow(const Recording& recording, const JobRecord& job, const std::vector<Tick>& until) {
    return Follower(recording, job, until).take();
}

std::vector<Tick> bound_until(const Recording& recording, const std::map<Epoch, EpochRuns>& epochs,
                              const JobRecord& job) {
    std::vector<Tick> until(recording.motors.size(), job.emergency.value_or(job.ended));
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

namespace {

/// A new owner may know the program only up to the end of a move. The machine then rests there on whole steps. Makes
/// this move lead to these steps. Returns false if no move ends there.
bool leads_to_rest(const Recording& recording, JobRecord& job) {
    std::vector<double> rest;
    for (std::size_t i = 0; i < recording.motors.size(); ++i) {
        std::int64_t count = job.course.from[i];
        for (const std::int64_t way : recording.slide_ways(job, i)) { count += way; }
        rest.push_back(static_cast<double>(count));
    }
    const auto is_its_end = [&rest](const Stretch& stretch) {
        return std::ranges::equal(stretch.to, rest,
                                  [](double place, double at) { return std::abs(place - at) <= 0.57; });
    };
    std::vector<Stretch>& stretches = job.course.stretches;
    for (std::size_t k = 0; k < stretches.size(); ++k) {
        if (job.course.last_part(k) != k || !is_its_end(stretches[k])) { continue; }
        stretches[k].to = rest;
        return true;
    }
    return false;
}

Following follow(const Recording& recording, const JobRecord& job, const std::map<Epoch, EpochRuns>& epochs) {
    const std::vector<Tick> until = bound_until(recording, epochs, job);
    Following following = follow(recording, job, until);
    if (!following.departure || job.is_whole()) { return following; }
    JobRecord cut = job;
    if (!leads_to_rest(recording, cut)) { return following; }
    Following to_rest = follow(recording, cut, until);
    return to_rest.departure ? following : to_rest;
}

}  // namespace

Followings follow_all(const Recording& recording) {
    const auto epochs = epoch_runs(recording);
    Followings all;
    for (const JobRecord& job : recording.jobs) {
        all.emplace_back();
        if (!job.homing) { all.back() = follow(recording, job, epochs); }
    }
    return all;
}

}  // namespace lockstep::simtest
