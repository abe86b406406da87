#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "core/kinematics/motors.hpp"
#include "tests/simulation/simtest/check/checks.hpp"
#include "tests/simulation/simtest/record/epoch_runs.hpp"

namespace lockstep::simtest {
namespace {

/// A device that loses its power turns its outputs off and notes nothing. So does one whose process is away.
bool hides_outputs(const VirtualFault& fault, std::size_t motor) {
    return fault.process == motor && (fault.kind == VirtualFault::Kind::Crash || fault.is_of_device());
}

/// Whether it is not known what the motor's device did in some of this time.
bool is_unknown(const Recording& recording, std::size_t motor, Tick from, Tick until) {
    return std::ranges::any_of(recording.faults, [&](const VirtualFault& fault) {
        return hides_outputs(fault, motor) && fault.at <= until && fault.end() >= from;
    });
}

bool has_words(const Course& course) {
    const auto has_any = [](const Stretch& stretch) { return !stretch.events.empty(); };
    return !course.last_events.empty() || std::ranges::any_of(course.stretches, has_any);
}

/// How far the known time of an event of a motor's device may be from the true one.
Ticks error_at(const Recording& recording, std::size_t motor, Tick truth) {
    const Ticks own =
        estimates_clock(recording.machine, MotorIndex{motor}) ? recording.motors[motor].bound_at(truth) : Ticks{};
    return own + Ticks{3};
}

/// What the words of a program ask of an output.
struct Asked {
    bool is_on = false;
    double share = 0;  // of full power at the feed: of an output that follows the speed

    void take(const OutputConfig& output, const ProgramEvent& event) {
        using Kind = ProgramEvent::Kind;
        const bool is_this = output.use == OutputUse::Number && event.index == output.number;
        if (output.pwm) {
            turns = event.kind == Kind::SpindleReverse || (turns && event.kind != Kind::SpindleStop);
            const bool has_value = event.kind == Kind::SpindleReverse || event.kind == Kind::SpindleSpeed;
            if (has_value) { value = event.value; }
            share = turns ? value / output.pwm->full_scale : 0;
        } else if (is_this && (event.kind == Kind::OutputOn || event.kind == Kind::OutputOff)) {
            is_on = event.kind == Kind::OutputOn;
        } else if (output.use == OutputUse::Flood && (event.kind == Kind::FloodOn || event.kind == Kind::CoolantOff)) {
            is_on = event.kind == Kind::FloodOn;
        }
    }

private:
    bool turns = false;
    double value = 0;
};

/// What a program asks of an output, by place.
class AskedAlong {
public:
    AskedAlong(const Course& course, const OutputConfig& output) {
        Asked now;
        for (const Stretch& stretch : course.stretches) {
            before_.push_back(now);
            for (const ProgramEvent& event : stretch.events) { now.take(output, event); }
            Dose dose = doses_.back();
            dose.least += now.share * std::max(0.0, stretch.feed_ticks - stretch.feed_slack_ticks);
            dose.most += now.share * (stretch.feed_ticks + stretch.feed_slack_ticks);
            doses_.push_back(dose);
        }
        before_.push_back(now);
        for (const ProgramEvent& event : course.last_events) { now.take(output, event); }
        last_ = now;
    }

    /// Whether the output may have this level somewhere in a range of places.
    bool may_be(bool is_on, const Reached& places) const {
        const double hair = 1e-6;
        const auto first = static_cast<std::size_t>(std::max(0.0, std::ceil(places.first - hair)));
        const auto last = static_cast<std::size_t>(std::max(0.0, std::floor(places.last + hair)));
        bool may = level_before(first) == is_on;
        for (std::size_t k = first; k <= last; ++k) { may = may || level_before(k + 1) == is_on; }
        return may;
    }

    /// The energy up to a place, in ticks at full power.
    struct Dose {
        double least = 0;
        double most = 0;
    };
    Dose dose_at(double place) const {
        const auto k = std::min(static_cast<std::size_t>(std::max(0.0, place)), doses_.size() - 1);
        const Dose& from = doses_[k];
        const Dose& to = doses_[std::min(k + 1, doses_.size() - 1)];
        const double part = place - static_cast<double>(k);
        return {std::lerp(from.least, to.least, part), std::lerp(from.most, to.most, part)};
    }

private:
    /// Before the events at the begin of a stretch.
    bool level_before(std::size_t stretch) const {
        return stretch < before_.size() ? before_[stretch].is_on : last_.is_on;
    }

    std::vector<Asked> before_;  // of each stretch, and of the end
    Asked last_;
    std::vector<Dose> doses_{{}};
};

/// The levels that a digital output had, by its device's events. After a fault that hides them, the next event tells
/// it.
class Levels {
public:
    Levels(const Recording& recording, std::size_t motor, const OutputConfig& output) {
        const MotorRecord& record = recording.motors[motor];
        for (const ChannelEvent& event : record.channels) {
            if (event.kind != ChannelEvent::Kind::Digital) { continue; }
            changes_.push_back({record.truth({event.tick, 1}), (event.levels >> output.channel & 1) != 0});
        }
        for (const VirtualFault& fault : recording.faults) {
            if (hides_outputs(fault, motor)) { changes_.push_back({fault.at, std::nullopt}); }
        }
        std::ranges::stable_sort(changes_, {}, &Change::at);
    }
    /// Whether it may have had this level at some time from one tick to another.
    bool may_have_been(bool is_on, Tick from, Tick until) const { return had(is_on, from, until, is_on); }
    /// Whether it is known to have had it.
    bool was(bool is_on, Tick from, Tick until) const { return had(is_on, from, until, !is_on); }

private:
    bool had(bool is_on, Tick from, Tick until, bool if_unknown) const {
        std::optional<bool> now = false;
        for (const Change& change : changes_) {
            if (change.at > from && now.value_or(if_unknown) == is_on) { return true; }
            if (change.at > until) { return false; }
            now = change.is_on;
        }
        return now.value_or(if_unknown) == is_on;
    }

    struct Change {
        Tick at;
        std::optional<bool> is_on;  // nullopt: not known
    };
    std::vector<Change> changes_;
};

/// The energy of an analog output since power-up, in ticks at full power. It stays at its bounds, 0 and full scale.
class Energy {
public:
    Energy(const MotorRecord& motor, const OutputConfig& output) {
        for (const ChannelEvent& event : motor.channels) {
            if (event.kind != ChannelEvent::Kind::Analog || event.channel != output.channel) { continue; }
            const double scale = 0x1p-62;
            const auto at = static_cast<double>(motor.truth({event.tick, 1}).value);
            const double sum = ramps_.empty() ? 0 : ramps_.back().until(at);
            ramps_.push_back(
                {at, static_cast<double>(event.value) * scale, static_cast<double>(event.detail) * scale, sum});
        }
    }
    double until(Tick tick) const {
        const auto at = static_cast<double>(tick.value);
        const auto later = std::ranges::upper_bound(ramps_, at, {}, &Ramp::at);
        return later == ramps_.begin() ? 0 : std::prev(later)->until(at);
    }

private:
    struct Ramp {
        double at = 0;
        double value = 0;
        double slope = 0;
        double sum = 0;  // until then

        double until(double tick) const {
            const double all = tick - at;
            const double bound = slope > 0 ? (1 - value) / slope : slope < 0 ? value / -slope : all;
            const double rises = std::min(all, bound);
            const double end = value + slope * rises;
            return sum + (value + end) / 2 * rises + end * (all - rises);
        }
    };
    std::vector<Ramp> ramps_;
};

class OutputCheck {
public:
    OutputCheck(const Recording& recording, const Followings& followings, Violations& violations)
        : recording_(recording), followings_(followings), violations_(violations), epochs_(epoch_runs(recording)) {}

    void check(const OutputConfig& output) {
        const std::size_t motor = motor_named(recording_.machine, output.motor).value();
        const Levels levels(recording_, motor, output);
        const Energy energy(recording_.motors[motor], output);
        for (std::size_t k = 0; k < recording_.jobs.size(); ++k) {
            const JobRecord& job = recording_.jobs[k];
            if (job.homing || !has_words(job.course)) { continue; }  // a jog leaves outputs as they are
            if (is_unknown(recording_, motor, job.began, job.ended)) { continue; }
            const AskedAlong asked(job.course, output);
            each_step(k, motor, [&](std::size_t axis, std::size_t step, Tick at, Ticks error, const Reached& places) {
                const bool holds = output.pwm ? has_dose(job, energy, asked, at, error, places)
                                              : has_level(levels, asked, at, error, places);
                if (!holds) { object(output, axis, at, job.first_step[axis] + step, places); }
                return holds;
            });
            check_rest(output, levels, energy, k, motor);
        }
    }

private:
    /// Calls visit(axis, step, time, error of the time, places) until it returns false, for each step of a job in which
    /// both its motor and the output's one were bound to the others.
    template <typename Visit>
    void each_step(std::size_t k, std::size_t motor, Visit visit) const {
        const JobRecord& job = recording_.jobs[k];
        const std::vector<Tick> until = bound_until(recording_, epochs_, job);
        for (std::size_t i = 0; i < recording_.motors.size(); ++i) {
            const std::span<const StepEdge> steps = recording_.steps_of(job, i);
            for (std::size_t n = 0; n < steps.size(); ++n) {
                const Tick at = recording_.motors[i].truth(steps[n]);
                const Ticks error = error_at(recording_, i, at) + error_at(recording_, motor, at);
                if (at + error > std::min(until[i], until[motor])) { break; }
                if (!visit(i, n, at, error, followings_[k]->at_step[i][n])) { return; }
            }
        }
    }

    static bool has_level(const Levels& levels, const AskedAlong& asked, Tick at, Ticks error, const Reached& places) {
        return (levels.may_have_been(true, at - error, at + error) && asked.may_be(true, places)) ||
               (levels.may_have_been(false, at - error, at + error) && asked.may_be(false, places));
    }
    /// Its value is rounded to 2^-12 of full scale.
    static bool has_dose(const JobRecord& job, const Energy& energy, const AskedAlong& asked, Tick at, Ticks error,
                         const Reached& places) {
        const double begin = energy.until(job.began);
        const double rounding = 0x1p-11 * static_cast<double>((at - job.began).value) + 4;
        const double least = energy.until(at - error) - begin - rounding;
        const double most = energy.until(at + error) - begin + rounding;
        return most >= asked.dose_at(places.first).least && least <= asked.dose_at(places.last).most;
    }

    /// After a job that ended early, what may not stay is off before the next one.
    void check_rest(const OutputConfig& output, const Levels& levels, const Energy& energy, std::size_t k,
                    std::size_t motor) {
        const JobRecord& job = recording_.jobs[k];
        const Tick next = k + 1 < recording_.jobs.size() ? recording_.jobs[k + 1].began : recording_.ended;
        const Tick at = job.ended + recording_.machine.slot_ticks() * (recording_.lossy() ? 100 : 30);
        if (job.outcome == JobOutcome::Done || at >= next || is_unknown(recording_, motor, job.began, next)) { return; }
        const bool is_failure = job.outcome == JobOutcome::Failed;
        const bool may_stay = output.stays_at_interruption && (output.stays_at_fault || !is_failure);
        const bool is_on = output.pwm ? energy.until(at) < energy.until(next) : levels.was(true, at, next);
        if (is_on && (output.pwm || !may_stay)) {
            violations_.push_back(
                {"outputs", motor, at.value, {}, output.name + " is on after a job that ended early"});
        }
    }

    void object(const OutputConfig& output, std::size_t axis, Tick at, std::size_t step, const Reached& places) {
        violations_.push_back({"outputs", axis, at.value, step,
                               output.name + " is not as the program says from move " + std::to_string(places.first) +
                                   " to " + std::to_string(places.last)});
    }

    const Recording& recording_;
    const Followings& followings_;
    Violations& violations_;
    std::map<Epoch, EpochRuns> epochs_;
};

}  // namespace

Violations check_outputs(const Recording& recording, const Followings& followings) {
    Violations violations;
    if (recording.machine.outputs.empty()) { return violations; }
    OutputCheck check(recording, followings, violations);
    for (const OutputConfig& output : recording.machine.outputs) {
        if (!output.makes_pulses()) { check.check(output); }
    }
    return violations;
}

}  // namespace lockstep::simtest
