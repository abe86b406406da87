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
        if (!probe_.result.touched()) {
            check_unnoticed();
            return std::move(violations_);
        }
        for (std::size_t m = 0; m < probe_.places.size(); ++m) { check_place(m); }
        if (is_device_at_fault()) { return std::move(violations_); }
        check_time();
        check_ceased();
        if (probe_.went_on_mm > probe_.most_mm) {
            object("went on for " + text(probe_.went_on_mm) + " mm behind the touch; at most " + text(probe_.most_mm) +
                   " were announced");
        }
        return std::move(violations_);
    }

private:
    /// The bound of the error of a motor's time at the touch.
    Ticks error_of(std::size_t motor) const { return recording_.motors[motor].bound_at(probe_.result.tick); }

    /// The greatest such bound of the motors whose devices have touched.
    Ticks error_of_touches() const {
        Ticks error;
        for (const TouchRecord& touch : probe_.touches) { error = std::max(error, error_of(touch.motor)); }
        return error;
    }

    /// Some place that the motor had at the touch, within the error of the clocks, is the reported one.
    void check_place(std::size_t m) {
        const Ticks error = error_of(m) + error_of_touches();
        std::int64_t count = probe_.from[m];
        std::int64_t least = count, most = count;
        const auto steps = recording_.steps_of(job_, m);
        const auto ways = recording_.slide_ways(job_, m);
        for (std::size_t n = 0; n < steps.size(); ++n) {
            const Tick at = recording_.motors[m].truth(steps[n]);
            if (at > probe_.result.tick + error) { break; }
            count += ways[n];
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

    /// A device that stood still when its input touched sees the touch later, or as if it had been earlier.
    bool is_device_at_fault() const {
        return std::ranges::any_of(recording_.faults, [&](const VirtualFault& fault) {
            return fault.is_of_device() && std::ranges::any_of(probe_.touches, [&](const TouchRecord& touch) {
                       const bool is_then = fault.at <= touch.pressed + touch.bounce + touch.debounce + kSeen &&
                                            fault.end() >= touch.pressed;
                       return fault.process == touch.motor && is_then;
                   });
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

    /// For how long the inputs bounce that have touched.
    Ticks bounce_of_touches() const {
        Ticks bounce;
        for (const TouchRecord& touch : probe_.touches) { bounce = std::max(bounce, touch.bounce); }
        return bounce;
    }

    /// The first touch counts. It is when the pin has last changed before it kept its level. A probe that touches at
    /// rest may be reported when the motion is about to begin.
    void check_time() {
        if (probe_.touches.empty()) { return object("a touch is reported, but nothing touched"); }
        const Tick pressed = probe_.touches.front().pressed;
        const Tick reported = probe_.result.tick;
        const Ticks most = error_of_touches() + error_of_touches() + bounce_of_touches() + kSeen;
        if (reported > pressed + most && !has_steps_between(pressed, reported)) { return; }
        const Ticks off = reported - pressed;
        if (off > most || off < Ticks{} - most) {
            object("the touch is reported " + std::to_string(off.value) + " ticks off; the clocks are within " +
                   std::to_string(most.value));
        }
        check_input(pressed + most);
    }

    /// The reported input is one that touched first. `latest`: for the first touch, as the clocks know it. Of inputs
    /// that touch before anything moves any may be reported: one that is closed when the move begins is known since
    /// then.
    void check_input(Tick latest) {
        const bool is_first = std::ranges::any_of(probe_.touches, [&](const TouchRecord& touch) {
            const bool is_in_time =
                touch.pressed <= latest || !has_steps_between(probe_.touches.front().pressed, touch.pressed);
            return touch.input == *probe_.result.input && is_in_time;
        });
        if (!is_first) {
            object("input " + std::to_string(*probe_.result.input) + " is reported, but it did not touch first");
        }
    }

    /// The epoch in motion at a tick; null if none was begun.
    const SentEpoch* epoch_at(Tick tick) const {
        const SentEpoch* found = nullptr;
        for (const auto& [number, epoch] : recording_.epochs) {
            if (epoch.frames.begin()->second.start <= tick) { found = &epoch; }
        }
        return found;
    }

    /// If pulses cease at the touch, no motor makes any after its input has followed the pin.
    void check_ceased() {
        const SentEpoch* const epoch = epoch_at(probe_.result.tick);
        if (!probe_.is_undisturbed || probe_.touches.empty() || epoch == nullptr || epoch->ceases.empty()) { return; }
        const TouchRecord& touch = probe_.touches.front();
        const Ticks rates{touch.debounce.value / 1000};  // the clocks' rates differ by less than a thousandth
        for (const MotorIndex m : motor_indices(probe_.places.size())) {
            const Ticks error = error_of(m) + error_of_touches() + rates;
            const Tick ceased = touch.pressed + touch.bounce + touch.debounce + error + kSeen;
            const auto steps = recording_.steps_of(job_, m);
            if (steps.empty() || recording_.motors[m].truth(steps.back()) <= ceased) { continue; }
            violations_.push_back({"probe", m, probe_.result.tick.value, {}, "makes pulses behind the touch"});
        }
    }

    /// The probe touched while the machine still moved afterwards, and no fault explains why that was missed.
    void check_unnoticed() {
        if (probe_.touches.empty() || !probe_.is_undisturbed) { return; }
        const auto known_by = [](const TouchRecord& touch) { return touch.pressed + touch.bounce + touch.debounce; };
        Tick known = known_by(probe_.touches.front());
        for (const TouchRecord& touch : probe_.touches) { known = std::min(known, known_by(touch)); }
        for (std::size_t m = 0; m < recording_.motors.size(); ++m) {
            const auto steps = recording_.steps_of(job_, m);
            if (steps.empty() || recording_.motors[m].truth(steps.back()) <= known) { continue; }
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
