#include "tests/simulation/simtest/run/bench.hpp"

#include <algorithm>
#include <cmath>

#include "core/clock/clock_asker.hpp"
#include "tests/simulation/simtest/draw/draw_bounces.hpp"
#include "tests/simulation/simtest/record/explain.hpp"

namespace lockstep::simtest {

namespace {

/// The longest stop from top speed, with only the motor's or the axis's own limit.
double longest_stop_seconds(const MachineConfig& machine) {
    double longest = 0;
    const auto take = [&](const Moving auto& part) {
        longest = std::max(longest, part.max_velocity_mm_s / part.max_decel_mm_s2);
    };
    for (const AxisConfig& axis : machine.axes) { take(axis); }
    for (const MotorConfig& motor : motors_of(machine)) { take(motor); }
    return longest;
}

/// The total time of everything planned, plus the time until all peers receive each other again after each outage.
double outage_seconds(const Scenario& scenario) {
    const ProtocolTiming& t = scenario.machine.timing;
    double slots = 0;
    double stops_s = 0;
    const auto add = [&](const std::vector<PlannedFault>& faults) {
        for (const PlannedFault& planned : faults) {
            slots += static_cast<double>(planned.fault.lasts.value) /
                     static_cast<double>(scenario.machine.slot_ticks().value);
            slots += 4 * static_cast<double>(rules::silence_slots(t));
            stops_s += longest_stop_seconds(scenario.machine);
        }
    };
    add(scenario.homing_faults);
    for (const Task& task : scenario.tasks) { add(task.faults); }
    const double asking_s =
        scenario.clocks.empty() ? 0 : 4 * ClockAsker::kPeriod_s;  // time requests; the first ones get no answer
    return slots * static_cast<double>(t.slot_us) * 1e-6 + stops_s + asking_s;
}

}  // namespace

Bench::Bench(const Scenario& scenario, Played& played)
    : scenario_(scenario),
      kinematics_(scenario.machine),
      map_(scenario.machine),
      played_(played),
      vm_({.machine = MachineSetup{scenario.machine},
           .seed = scenario.seed,
           .network = scenario.network,
           .start = scenario.power_up,
           .on_takeover = scenario.on_takeover,
           .coordinators = scenario.coordinators,
           .clocks = scenario.clocks,
           .links = scenario.links,
           .devices = scenario.devices}),
      recorder_(played.recording),
      watch_(vm_, scenario.on_takeover),
      placer_(vm_),
      claims_(vm_, played.recording),
      coverage_(scenario.machine, played.coverage),
      outage_s_(outage_seconds(scenario)),
      by_hand_(kinematics_.motors().size()),
      slipped_(kinematics_.motors().size()) {
    const std::initializer_list<VirtualObserver*> all{&recorder_, &watch_, &placer_, &claims_, &coverage_};
    for (VirtualObserver* observer : all) { vm_.observe(*observer); }
}

Counts Bench::axes_at(const Counts& motors) const {
    MotorCounts counts;
    for (const std::int64_t count : motors) { counts.steps.append(count); }
    const AxisCounts axes = kinematics_.axes_at(counts);
    return {axes.begin(), axes.end()};
}

double Bench::protocol_seconds() const {
    const ProtocolTiming& t = machine().timing;
    const double rests = lossy() ? 60 : 6;
    return rests * slot_s() * (2 * t.send_ahead_slots + 3 * t.frame_slots + 20);
}

void Bench::object(const std::string& rule, const std::string& text) {
    played_.violations.push_back({rule, {}, vm_.now().value, {}, text});
    over_ = true;
}

void Bench::move_by_hand(std::size_t motor, std::int64_t steps) {
    vm_.device(motor).plant().push(steps);
    by_hand_[motor] += steps;
    played_.recording.was_moved_by_hand = played_.recording.was_moved_by_hand || steps != 0;
}

void Bench::slip(const Slip& slip) {
    vm_.device(slip.motor).plant().push(slip.steps);
    by_hand_[slip.motor] += slip.steps;
    slipped_[slip.motor] += slip.steps;
}

void Bench::advance() {
    if (stream_) { stream_->tend(); }
    vm_.advance();
}

bool Bench::advance_until(const std::function<bool()>& done, Ticks limit) {
    const auto tended = [&] {
        if (stream_) { stream_->tend(); }
        return done();
    };
    return vm_.advance_until(tended, limit);
}

bool Bench::await(const std::function<bool()>& done, double seconds, const std::string& what) {
    if (over_) { return false; }
    const Ticks limit{static_cast<std::int64_t>(std::ceil((seconds + outage_s_) * machine().ticks_per_second()))};
    const bool in_time = advance_until([&] { return done() || faulted(); }, limit);
    if (done()) { return true; }
    if (faulted() && !explains(played_.recording, watch_.fault())) {
        object("fault", "while " + what + ": " + std::string(name_of(watch_.fault())));
    } else if (!faulted() && !in_time) {
        object("liveness", what + " took longer than " + std::to_string(seconds + outage_s_) + " s");
    }
    return false;
}

void Bench::wait(double seconds) {
    const Tick until = vm_.now() + Ticks{static_cast<std::int64_t>(seconds * machine().ticks_per_second())};
    while (vm_.now() < until) { advance(); }
}

/// Acts as an impatient operator. An axis or a device may still be missing; the machine must do nothing then.
void Bench::reset_early() {
    constexpr std::uint64_t kNeverSent = 0;
    (void)ask(CommandKind::Reset);
    const Reply* reply = ask(CommandKind::Run, kNeverSent);
    if (reply != nullptr && reply->status == ReplyStatus::Accepted) {
        object("refusal", "a program never sent is run");
    }
}

void Bench::settle(double seconds) {
    if (over_) { return; }
    vm_.withdraw_faults();
    if (scenario_.resets_early && faulted()) { reset_early(); }
    if (over_) { return; }
    const ProtocolTiming& t = machine().timing;
    const Ticks rest = machine().slot_ticks() * (t.send_ahead_slots + 2 * t.frame_slots);
    const Tick from = vm_.now();
    const Ticks limit{static_cast<std::int64_t>(std::ceil((seconds + outage_s_) * machine().ticks_per_second()))};
    // The recording knows what a device did without its axis only after the axis uses the device again.
    const auto has_device = [](const AxisState& axis) { return axis.unproved != FaultCode::DeviceMissing; };
    const auto is_over = [&](const VirtualFault& fault) { return !fault.is_of_device() || fault.end() < vm_.now(); };
    const auto settled = [&] {
        return !vm_.faults_pending() && std::ranges::all_of(played_.recording.faults, is_over) &&
               std::ranges::all_of(watch_.motors(), has_device) && vm_.now() - from > rest &&
               vm_.now() - watch_.moved() > rest;
    };
    if (!advance_until(settled, limit + rest)) { object("liveness", "the machine did not come to rest"); }
    if (watch_.is_taking_over()) {
        (void)advance_until([&] { return !watch_.is_taking_over(); }, limit);
    }
}

const Reply* Bench::ask(CommandKind kind, std::uint64_t program) {
    return over_ ? nullptr : await_reply(vm_.command(kind, {}, program));
}

const Reply* Bench::ask_in_time(CommandKind kind, std::uint64_t program) {
    constexpr double kLearning_s = 10;
    const Tick patience = vm_.now() + Ticks{std::llround(kLearning_s * machine().ticks_per_second())};
    const auto is_too_soon = [](const Reply& reply) {
        return reply.status == ReplyStatus::Refused && reply.fault == FaultCode::ClockUncertain;
    };
    const Reply* reply = ask(kind, program);
    while (reply != nullptr && is_too_soon(*reply) && vm_.now() < patience) {
        wait(0.5);
        reply = ask(kind, program);
    }
    return reply;
}

const Reply* Bench::set_overrides(const Overrides& overrides) {
    return over_ ? nullptr : await_reply(vm_.set_overrides(overrides));
}

double Bench::most_feed() const {
    double most = 1;
    for (const Task& task : scenario_.tasks) {
        for (const Interrupt& interrupt : task.interrupts) { most = std::max(most, interrupt.overrides.feed()); }
    }
    return most;
}

/// A restarted coordinator answers when the axes rest and follow it. A tail along a path can be long. A fault that
/// comes after a command can also lose the command or its answer.
const Reply* Bench::await_reply(std::uint64_t sequence) {
    constexpr int kMostRepeats = 20;
    const auto is_answered = [&] { return vm_.reply_to(sequence) != nullptr; };
    const Tick asked = vm_.now();
    const Ticks patience{static_cast<std::int64_t>(outage_s_ * machine().ticks_per_second())};
    for (int tries = 0; !is_answered(); ++tries) {
        bool may_be_lost = may_lose();
        if (may_be_lost) {
            if (tries > kMostRepeats && vm_.now() > std::max(asked, watch_.moved()) + patience) { break; }
            wait_slots(kAnswerSlots);
        } else {
            const Tick deadline = vm_.now() + machine().slot_ticks() * static_cast<std::int64_t>(kAnswerSlots);
            while (!is_answered() && vm_.now() < deadline) {
                advance();
                may_be_lost = may_be_lost || may_lose();
            }
            if (!may_be_lost) { break; }
        }
        if (!is_answered()) { vm_.repeat_command(); }
    }
    if (!is_answered()) { object("liveness", "no answer to a command"); }
    return vm_.reply_to(sequence);
}

std::uint64_t Bench::send_program(Program program) {
    vm_.give_program(++programs_, std::move(program));
    return programs_;
}

std::uint64_t Bench::stream_program(Program program, const std::vector<SentPart>& parts) {
    stream_.emplace(vm_, ++programs_, std::move(program), parts);
    const Tick asked = vm_.now();
    (void)await([&] { return stream_->may_run() || stream_->refusal() || disturbed_since(asked); }, 10,
                "the first part of a program");
    if (stream_->refusal() && !disturbed_since(asked)) { object("stream", "refused: " + stream_->refusal()->text); }
    return programs_;
}

std::vector<std::size_t> Bench::steps_made() const {
    std::vector<std::size_t> made;
    for (const MotorRecord& axis : played_.recording.motors) { made.push_back(axis.steps.size()); }
    return made;
}

double Bench::input_seconds(std::size_t input) const {
    constexpr double kSlots = 12;
    constexpr double kLossySlots = 40;
    const double late =
        static_cast<double>(scenario_.lateness(motor_named(machine(), machine().inputs[input].motor).value()).value);
    const double settles_s = machine().inputs[input].debounce_ms * 1e-3 + bounce_seconds(machine().inputs[input]);
    return settles_s + (lossy() ? kLossySlots : kSlots) * slot_s() + 2 * late / machine().ticks_per_second();
}

}  // namespace lockstep::simtest
