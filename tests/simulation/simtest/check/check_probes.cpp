#include <algorithm>
#include <cmath>

#include "tests/simulation/simtest/check/checks.hpp"

namespace lockstep::simtest {
namespace {

constexpr Ticks kSeen{2};  // between the change of a pin and the next reading of it, with rounding

std::string text(double value) { return std::to_string(value); }

class ProbeCheck {
public:
    ProbeCheck(const Recording& recording, const JobRecord& job)
        : recording_(recording), job_(job), probe_(*job.probe) {}

    Violations check() {
        if (!probe_.result.touched) {
            check_unnoticed();
            return std::move(violations_);
        }
        for (std::size_t m = 0; m < probe_.places.size(); ++m) { check_place(m); }
        if (is_device_at_fault()) { return std::move(violations_); }
        check_time();
        if (probe_.went_on_mm > probe_.most_mm) {
            object("went on for " + text(probe_.went_on_mm) + " mm behind the touch; at most " + text(probe_.most_mm) +
                   " were announced");
        }
        return std::move(violations_);
    }

private:
    /// By how much the times of two motors may differ.
    Ticks error_between(std::size_t a, std::size_t b) const {
        const Tick at = probe_.result.tick;
        return recording_.motors[a].bound_at(at) + recording_.motors[b].bound_at(at);
    }

    /// Some place that the motor had at the touch, within the error of the clocks, is the reported one.
    void check_place(std::size_t m) {
        const Ticks error = error_between(m, probe_.motor);
        std::int64_t count = probe_.from[m];
        std::int64_t least = count, most = count;
        for (const StepEdge& step : recording_.steps_of(job_, m)) {
            const Tick at = recording_.motors[m].truth(step);
            if (at > probe_.result.tick + error) { break; }
            count += step.direction;
            const bool is_before = at <= probe_.result.tick - error;
            least = is_before ? count : std::min(least, count);
            most = is_before ? count : std::max(most, count);
        }
        const double place = probe_.places[m];
        const double within = probe_.within[m];
        if (place >= static_cast<double>(least) - within && place <= static_cast<double>(most) + within) { return; }
        violations_.push_back({"probe",
                               m,
                               probe_.result.tick.value,
                               {},
                               "is reported at " + text(place) + " at the touch; its steps lead to " +
                                   std::to_string(least) + " to " + std::to_string(most)});
    }

    /// A device that stood still when its probe touched sees the touch later, or as if it had been earlier.
    bool is_device_at_fault() const {
        return std::ranges::any_of(recording_.faults, [&](const VirtualFault& fault) {
            const bool is_then = probe_.pressed && fault.at <= *probe_.pressed + probe_.debounce + kSeen &&
                                 fault.end() >= *probe_.pressed;
            return fault.process == probe_.motor && fault.is_of_device() && is_then;
        });
    }

    bool has_steps_between(Tick from, Tick to) const {
        for (std::size_t m = 0; m < recording_.motors.size(); ++m) {
            for (const StepEdge& step : recording_.steps_of(job_, m)) {
                const Tick at = recording_.motors[m].truth(step);
                if (at > from && at <= to) { return true; }
            }
        }
        return false;
    }

    /// A probe that touches at rest may be reported when the motion is about to begin.
    void check_time() {
        if (!probe_.pressed) { return object("a touch is reported, but nothing touched"); }
        const Tick reported = probe_.result.tick;
        const Ticks most = error_between(probe_.motor, probe_.motor) + kSeen;
        if (reported > *probe_.pressed + most && !has_steps_between(*probe_.pressed, reported)) { return; }
        const Ticks off = reported - *probe_.pressed;
        if (off > most || off < Ticks{} - most) {
            object("the touch is reported " + std::to_string(off.value) + " ticks off; the clocks are within " +
                   std::to_string(most.value));
        }
    }

    /// The probe touched while the machine still moved afterwards, and no fault explains why that was missed.
    void check_unnoticed() {
        if (!probe_.pressed || !probe_.is_undisturbed) { return; }
        for (std::size_t m = 0; m < recording_.motors.size(); ++m) {
            const auto steps = recording_.steps_of(job_, m);
            if (steps.empty() || recording_.motors[m].truth(steps.back()) <= *probe_.pressed + probe_.debounce) {
                continue;
            }
            return object("the touch was not noticed");
        }
    }

    void object(std::string what) {
        violations_.push_back({"probe", {}, probe_.result.tick.value, {}, std::move(what)});
    }

    const Recording& recording_;
    const JobRecord& job_;
    const ProbeRecord& probe_;
    Violations violations_;
};

}  // namespace

Violations check_probes(const Recording& recording) {
    Violations violations;
    for (const JobRecord& job : recording.jobs) {
        if (job.probe) { append(violations, ProbeCheck(recording, job).check()); }
    }
    return violations;
}

}  // namespace lockstep::simtest
