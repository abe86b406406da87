#include "tests/simulation/simtest/run/play/play_job.hpp"

#include <algorithm>
#include <cmath>

#include "tests/simulation/simtest/draw/draw_bounces.hpp"
#include "tests/simulation/simtest/draw/draw_inputs.hpp"
#include "tests/simulation/simtest/record/motor_course.hpp"
#include "tests/simulation/simtest/run/homing_time.hpp"
#include "tests/simulation/simtest/run/play/move_slides.hpp"
#include "tests/simulation/simtest/run/play/play_correction.hpp"
#include "tests/simulation/simtest/run/probe_record.hpp"

namespace lockstep::simtest {
namespace {

MotorCounts counts_of(const Counts& motors) {
    MotorCounts counts;
    for (const std::int64_t count : motors) { counts.steps.append(count); }
    return counts;
}

/// Homing must come before any program: motors of one axis are at different places, or motors that share axes did not
/// come to rest together, so that an axis is outside its travel.
bool must_home(const Bench& bench, const Counts& motors) {
    if (bench.map().is_direct()) { return false; }
    if (bench.kinematics().astray(counts_of(motors))) { return true; }
    const Counts axes = bench.axes_at(motors);
    for (std::size_t i = 0; i < axes.size(); ++i) {
        const AxisConfig& axis = bench.machine().axes[i];
        const std::int64_t rests = bench.kinematics().rest_steps(AxisIndex{i});
        if (axes[i] < nearest_step(axis, axis.position_min_mm) - rests) { return true; }
        if (axes[i] > nearest_step(axis, axis.position_max_mm) + rests) { return true; }
    }
    return false;
}

/// The program with the current positions of the axes as its start.
Program starting_at(const Bench& bench, const Counts& motors, Program program) {
    if (!program.start_mm.empty()) { return program; }
    const MachineConfig& machine = bench.machine();
    const Counts at = bench.axes_at(motors);
    for (const std::string& name : program.axes) {
        const auto axis = std::ranges::find(machine.axes, name, &AxisConfig::name);
        const bool known = axis != machine.axes.end();
        const auto i = static_cast<std::size_t>(axis - machine.axes.begin());
        program.start_mm.push_back(known ? static_cast<double>(at[i]) / axis->steps_per_mm : 0);
    }
    return program;
}

void end_record(Bench& bench, JobRecord& job) {
    job.ended = bench.vm().now();
    for (Emergency& emergency : bench.recording().emergencies) {
        if (job.emergency && emergency.asked >= *job.emergency) { emergency.rests = job.ended; }
    }
    bench.recording().jobs.push_back(std::move(job));
}

std::string answer_text(const Reply& reply) {
    return std::string(reply.status == ReplyStatus::Accepted ? "accepted" : "refused: ") +
           (reply.fault == FaultCode::None ? "" : std::string(name_of(reply.fault))) + " " + reply.text;
}

bool is_refusal(const Reply& reply, FaultCode why) {
    return reply.status == ReplyStatus::Refused && reply.fault == why;
}

/// A machine in Fault accepts nothing before a reset. With a standby another owner may not know of the fault, and obey.
void ask_in_fault(Bench& bench) {
    const auto before = bench.steps_made();
    const Reply* reply = bench.ask_in_time(CommandKind::Home);
    if (reply == nullptr) { return; }
    const bool moves = bench.faulted() && bench.steps_made() != before;
    if (moves || reply->status != ReplyStatus::Refused) { bench.object("refusal", "in Fault: " + answer_text(*reply)); }
}

/// The park position, on a whole step of each axis. A motor that lost its coordinator on the way, with its zero set,
/// rests where it reports; check_slides() compares that with the true place of the slide.
std::int64_t place_after_homing(const Bench& bench, MotorIndex motor, JobOutcome outcome) {
    const AxisState& state = bench.watch().motors()[motor];
    if (outcome != JobOutcome::Done && state.homed && state.at_rest) {
        return state.position.count() - state.play_steps;
    }
    if (bench.kinematics().motors()[motor].is_board()) { return 0; }
    Places park;
    for (const AxisConfig& axis : bench.machine().axes) {
        park.push_back(std::round(axis.homing.park_mm * axis.steps_per_mm));
    }
    return std::llround(bench.map().place(motor, park));
}

/// How often the machine is homed or reset until it must be ready. Motors of one axis that lost their places far apart
/// come nearer by max_skew_mm with each homing, and each of these may need a reset.
int most_tries(const Bench& bench) {
    if (bench.map().is_direct()) { return 6; }
    double homings = 100;
    for (const AxisConfig& axis : bench.machine().axes) {
        if (!axis.max_skew_mm) { continue; }
        homings = std::max(homings, 2 * (axis.position_max_mm - axis.position_min_mm) / *axis.max_skew_mm);
    }
    return static_cast<int>(2 * std::ceil(homings));
}

/// Ends the homing at rest. The homing may have ended before the command arrives.
void play_homing_stop(Bench& bench, CommandKind kind, double seconds, JobRecord& job) {
    if (kind == CommandKind::EmergencyStop) {
        job.emergency = play_emergency(bench);
        return;
    }
    const auto ended = [&] { return bench.watch().outcome().has_value(); };
    const Reply* reply = bench.ask(CommandKind::Stop);
    if (reply == nullptr || ended()) { return; }
    if (reply->status != ReplyStatus::Accepted && !bench.disturbed_since(job.began)) {
        bench.object("stop of a homing", answer_text(*reply));
    }
    (void)bench.await(ended, seconds, "the stop of a homing");
}

/// A device that was lost while its emergency stop was released has not told so yet.
void reset(Bench& bench) {
    const Reply* reply = bench.ask(CommandKind::Reset);
    const bool was_lost = std::ranges::any_of(bench.recording().faults, &VirtualFault::is_of_device);
    if (reply != nullptr && was_lost && is_refusal(*reply, FaultCode::EmergencyStopInput)) {
        bench.wait(bench.input_seconds(kStopInput));
        reply = bench.ask(CommandKind::Reset);
    }
    if (reply != nullptr && reply->status != ReplyStatus::Accepted) { bench.object("reset", answer_text(*reply)); }
}

}  // namespace

void play_refusal(Bench& bench, const WrongCommand& wrong, const Counts& at) {
    const auto before = bench.steps_made();
    const Tick asked = bench.vm().now();
    std::uint64_t program = 0;
    if (wrong.program) { program = bench.send_program(starting_at(bench, at, *wrong.program)); }
    const Reply* reply = bench.ask_in_time(wrong.kind, program);
    if (reply == nullptr) { return; }
    const bool otherwise = reply->status == ReplyStatus::Refused && bench.disturbed_since(asked);
    if (!otherwise && !is_refusal(*reply, wrong.refusal)) {
        return bench.object("refusal", "expected " + std::string(name_of(wrong.refusal)) + ", " + answer_text(*reply));
    }
    bench.wait_slots(3);
    if (bench.watch().phase() != MachinePhase::Idle || bench.steps_made() != before) {
        bench.object("refusal", "a refused command had an effect");
    }
}

Tick play_emergency(Bench& bench) {
    const Tick asked = bench.vm().now();
    bench.recording().emergencies.push_back({asked, asked});
    const Reply* reply = bench.ask(CommandKind::EmergencyStop);
    if (reply != nullptr && reply->status != ReplyStatus::Accepted) { bench.object("emergency", answer_text(*reply)); }
    // A coordinator that ended in the meantime does not know of the command.
    const auto lost = [&] { return bench.disturbed_since(asked); };
    (void)bench.await(lost, bench.protocol_seconds(), "an emergency stop");
    return asked;
}

void play_homing(Bench& bench, Counts& at, const std::optional<HomingStop>& stop) {
    move_slides_before_homing(bench);
    if (bench.faulted()) { return; }
    JobRecord job{.homing = true, .course = {}, .first_step = bench.steps_made(), .began = bench.vm().now()};
    const double seconds = homing_seconds(bench);
    const Reply* reply = bench.ask_in_time(CommandKind::Home);
    if (reply == nullptr) { return; }
    const bool accepted = reply->status == ReplyStatus::Accepted;
    if (!accepted && !bench.disturbed_since(job.began)) { return bench.object("homing", answer_text(*reply)); }
    const auto ended = [&] { return bench.watch().outcome().has_value(); };
    if (accepted && stop) {
        const Tick due =
            bench.vm().now() + Ticks{static_cast<std::int64_t>(stop->after_s * bench.machine().ticks_per_second())};
        (void)bench.await([&] { return ended() || bench.vm().now() >= due; }, seconds, "homing");
        if (!bench.over() && !ended()) { play_homing_stop(bench, stop->kind, seconds, job); }
    } else if (accepted) {
        (void)bench.await(ended, seconds, "homing");
    }
    const bool undisturbed = !stop && !job.emergency && !bench.faulted() && !bench.disturbed_since(job.began) &&
                             !bench.vm().faults_pending();
    if (!undisturbed) { bench.settle(seconds); }
    job.end_step = bench.steps_made();
    job.outcome = bench.watch().outcome().value_or(JobOutcome::Failed);
    for (const MotorIndex i : motor_indices(at.size())) {
        const bool searches = row_of(bench.kinematics().motors()[i].homing.way).searches;
        const bool in_place = !searches && bench.watch().motors()[i].homed;
        if (job.end_step[i] == job.first_step[i] && !in_place) { continue; }  // it was not reached
        at[i] = place_after_homing(bench, i, job.outcome);
        bench.forget_slips(i);
    }
    end_record(bench, job);
}

void make_ready(Bench& bench, Counts& at) {
    const int most = most_tries(bench);
    const auto in = [&](MachinePhase phase) { return bench.watch().phase() == phase; };
    const auto homed = [&] { return std::ranges::all_of(bench.watch().motors(), &AxisState::homed); };
    for (int tries = 0; tries < most && !bench.over(); ++tries) {
        if (in(MachinePhase::Idle) && homed() && !must_home(bench, at)) { return; }
        if (in(MachinePhase::Idle)) {
            play_homing(bench, at);
        } else if (bench.faulted()) {
            if (bench.asks_in_fault() && !bench.has_standby()) { ask_in_fault(bench); }
            reset(bench);
        }
        (void)bench.await([&] { return in(MachinePhase::Idle); }, bench.protocol_seconds(), "becoming ready");
    }
    if (!bench.over()) { bench.object("liveness", "the machine cannot be made ready again"); }
}

void JobPlayer::play() {
    job_.began = bench_.vm().now();
    if (!start()) { return; }
    const double seconds =
        ample_seconds() + bench_.protocol_seconds() * static_cast<double>(task_.interrupts.size() + job_.course.pauses);
    const Tick deadline =
        bench_.vm().now() + Ticks{static_cast<std::int64_t>(seconds * bench_.machine().ticks_per_second())};
    do {
        while (goes_on()) {
            go_on();
            if (bench_.vm().now() > deadline && !disturbed()) {
                bench_.object("liveness", "a job took longer than " + std::to_string(seconds) + " s");
            }
        }
        if (bench_.faulted() || disturbed() || bench_.vm().faults_pending()) {
            bench_.settle(ample_seconds());
        } else {
            (void)bench_.await([this] { return in(MachinePhase::Idle); }, bench_.protocol_seconds(), "becoming idle");
        }
    } while (goes_on());  // a new owner continues the job after the fault
    record();
}

/// The place of the axes is one from which the motors rest where they are.
bool JobPlayer::is_at(const Counts& axes) const {
    constexpr double kHalf_steps = 0.5 + 1e-6;
    const Places places(axes.begin(), axes.end());
    for (std::size_t m = 0; m < at_.size(); ++m) {
        if (std::abs(bench_.map().place(m, places) - static_cast<double>(at_[m])) > kHalf_steps) { return false; }
    }
    return true;
}

bool JobPlayer::start() {
    for (const Slip& slip : task_.slips) { bench_.slip(slip); }
    if (!task_.slips.empty()) { bench_.wait_slots(bench_.lossy() ? 40 : 6); }
    if (const auto& before = bench_.vm().state()->probe) { probed_before_ = before->job; }
    const Counts axes = bench_.axes_at(at_);
    if (!is_at(axes)) { bench_.object("place", "no place of the axes belongs to those of the motors"); }
    Course of_axes = course_of(task_.program, bench_.machine(), axes, bench_.most_feed());
    job_.course = course_of_motors(std::move(of_axes), bench_.map(), bench_.machine(), at_);
    job_.first_step = bench_.steps_made();
    Program whole = starting_at(bench_, at_, task_.program);
    const std::uint64_t program = task_.parts.empty() ? bench_.send_program(std::move(whole))
                                                      : bench_.stream_program(std::move(whole), task_.parts);
    CorrectionPlayer correction(bench_);
    const Reply* reply = bench_.ask_in_time(CommandKind::Run, program);
    if (reply == nullptr) { return false; }
    begun_ = reply->status == ReplyStatus::Accepted;
    if (!begun_) { refused("refusal", *reply); }
    if (begun_) { correction.play(job_, at_, streamed_seconds()); }
    moving_since_ = bench_.vm().now();
    return !bench_.over();
}

/// An upper bound of the job's duration without interrupts. Each part may find the machine at rest.
double JobPlayer::ample_seconds() const {
    return 2 * job_.course.seconds + bench_.protocol_seconds() + streamed_seconds();
}

/// How long the parts of a streamed program may take to come.
double JobPlayer::streamed_seconds() const {
    double seconds = bench_.protocol_seconds() * static_cast<double>(task_.parts.size());
    for (const SentPart& part : task_.parts) { seconds += part.after_s; }
    return seconds;
}

/// Records a refusal that an undisturbed machine must not give. An owner may be replaced by a fault that began before.
void JobPlayer::refused(const char* what, const Reply& reply) {
    const auto& claims = bench_.recording().claims;
    const bool has_new_owner =
        reply.fault == FaultCode::CoordinatorChanged && !claims.empty() && claims.back().at >= job_.began;
    if (!disturbed() && !has_new_owner) { bench_.object(what, "it was " + answer_text(reply)); }
}

/// Continues to the next event, planned or not. A hold that one coordinator refused may be obeyed by another later.
void JobPlayer::go_on() {
    const auto is_held = [this] { return in(MachinePhase::Paused) || in(MachinePhase::Holding); };
    if (is_held()) { return resume(); }
    const bool more = next_ < task_.interrupts.size();
    const double after_s = more ? task_.interrupts[next_].after_s : 0;
    const Tick due = moving_since_ + Ticks{static_cast<std::int64_t>(after_s * bench_.machine().ticks_per_second())};
    (void)bench_.await([&] { return ended() || is_held() || (more && bench_.vm().now() >= due); }, ample_seconds(),
                       "a motion");
    if (!bench_.over() && more && in(MachinePhase::Running) && bench_.vm().now() >= due) {
        interrupt(task_.interrupts[next_++]);
    }
}

void JobPlayer::interrupt(const Interrupt& interrupt) {
    switch (interrupt.kind) {
        case Interrupt::Kind::HoldAndResume:
        case Interrupt::Kind::HoldAndStop: return hold(interrupt);
        case Interrupt::Kind::Stop: return stop();
        case Interrupt::Kind::EmergencyStop: return stop_at_once();
        case Interrupt::Kind::WrongCommand: return give(interrupt.wrong);
        case Interrupt::Kind::Override: return set_overrides(interrupt.overrides);
        case Interrupt::Kind::StopInput: return press_stop();
        case Interrupt::Kind::Door: return open_door(interrupt);
        case Interrupt::Kind::Touch: return touch(interrupt);
        case Interrupt::Kind::Slip: return bench_.slip(interrupt.slip);
    }
}

/// Has no effect if it was sent just before the end of the motion.
void JobPlayer::hold(const Interrupt& interrupt) {
    const Reply* reply = bench_.ask(CommandKind::Hold);
    if (reply == nullptr) { return; }
    if (reply->status != ReplyStatus::Accepted) {
        if (bench_.watch().was_moving_at(reply->sequence)) { refused("hold", *reply); }
        return;
    }
    const auto rests = [this] { return in(MachinePhase::Holding) || in(MachinePhase::Paused) || ended(); };
    if (!bench_.await(rests, 2 * bench_.protocol_seconds() + job_.course.seconds, "coming to rest") || ended()) {
        return;
    }
    const auto before = bench_.steps_made();
    bench_.wait(interrupt.rest_s);
    if (bench_.steps_made() != before) { return bench_.object("hold", "steps occur while the machine is held"); }
    interrupt.kind == Interrupt::Kind::HoldAndStop ? stop() : resume();
}

void JobPlayer::stop() {
    const Reply* reply = bench_.ask(CommandKind::Stop);
    if (reply == nullptr) { return; }
    if (reply->status != ReplyStatus::Accepted) {
        if (bench_.watch().was_moving_at(reply->sequence)) { refused("stop", *reply); }
        return;
    }
    (void)bench_.await([this] { return ended(); }, 2 * bench_.protocol_seconds() + job_.course.seconds, "a stop");
}

void JobPlayer::set_overrides(const Overrides& overrides) {
    const Reply* reply = bench_.set_overrides(overrides);
    const bool has_none = bench_.machine().coordination == StepMethod::Lai;
    if (reply != nullptr && reply->status != ReplyStatus::Accepted && !has_none) { refused("override", *reply); }
}

/// While the stop is pressed, a reset is refused. It is released for the reset that makes the machine ready.
void JobPlayer::press_stop() {
    const InputConfig& input = bench_.machine().inputs[kStopInput];
    const double ticks_per_second = bench_.machine().ticks_per_second();
    const Tick pressed = bench_.vm().now();
    job_.emergency = job_.emergency.value_or(pressed);  // a frozen coordinator may not know of an earlier one
    bench_.recording().emergencies.push_back(
        {.asked = pressed,
         .rests = pressed,
         .by_input = motor_named(bench_.machine(), input.motor),
         .debounce = {std::llround((input.debounce_ms * 1e-3 + bounce_seconds(input)) * ticks_per_second)}});
    bench_.set_input(kStopInput, true);
    (void)bench_.await([&] { return disturbed(); }, bench_.protocol_seconds(), "an emergency stop by an input");
    bench_.wait(bench_.input_seconds(kStopInput));  // a disturbed machine may need as long to notice it
    if (!bench_.over() && bench_.faulted() && !disturbed()) {
        const Reply* reply = bench_.ask(CommandKind::Reset);
        if (reply != nullptr && !is_refusal(*reply, FaultCode::EmergencyStopInput) && !disturbed()) {
            bench_.object("reset", "while the emergency stop is pressed: " + answer_text(*reply));
        }
    }
    bench_.set_input(kStopInput, false);
    bench_.wait(bench_.input_seconds(kStopInput));
}

/// The machine comes to rest on its path and stays there, until the door is closed and the job is resumed.
void JobPlayer::open_door(const Interrupt& interrupt) {
    bench_.set_input(kDoorInput, true);
    const auto rests = [this] { return in(MachinePhase::Holding) || in(MachinePhase::Paused) || ended(); };
    const double seconds = 2 * bench_.protocol_seconds() + job_.course.seconds;
    if (bench_.await([&] { return rests() || disturbed(); }, seconds, "the hold by a door") && rests() && !ended()) {
        const auto before = bench_.steps_made();
        const InputConfig& door = bench_.machine().inputs[kDoorInput];
        bench_.wait(interrupt.rest_s + (bounce_seconds(door) > 0 ? bench_.input_seconds(kDoorInput) : 0));
        const Reply* reply = bench_.ask(CommandKind::Resume);
        if (reply != nullptr && !is_refusal(*reply, FaultCode::DoorOpen) && !disturbed()) {
            bench_.object("door", "a resume while it is open: " + answer_text(*reply));
        }
        if (bench_.steps_made() != before && !disturbed()) { bench_.object("door", "steps occur while it is open"); }
    }
    bench_.set_input(kDoorInput, false);
    bench_.wait(bench_.input_seconds(kDoorInput));
}

/// The machine comes to rest and the job ends.
void JobPlayer::touch(const Interrupt& interrupt) {
    const std::vector<std::size_t> inputs = probe_inputs(bench_.machine());
    const auto press = [&](std::size_t input) {
        touches_.push_back(touch_record(bench_.machine(), input, bench_.vm().now()));
        bench_.set_input(input, true);
    };
    const std::size_t first = inputs[interrupt.touched];
    press(first);
    for (const std::size_t input : inputs) {
        const std::string& wire = bench_.machine().inputs[input].wire;
        if (input != first && !wire.empty() && wire == bench_.machine().inputs[first].wire) { press(input); }
    }
    if (interrupt.next_after_s) {
        if (*interrupt.next_after_s > 0) { bench_.wait(*interrupt.next_after_s); }
        press(inputs[1 - interrupt.touched]);
    }
    const double seconds = 2 * bench_.protocol_seconds() + job_.course.seconds;
    (void)bench_.await([&] { return ended() || disturbed() || in(MachinePhase::Holding); }, seconds, "a touch");
}

void JobPlayer::stop_at_once() {
    const Tick asked = play_emergency(bench_);
    job_.emergency = job_.emergency.value_or(asked);
}

/// Gives a command that is refused while the machine moves. Home would be accepted at the job's end, so it is sent long
/// before that or never.
void JobPlayer::give(const WrongCommand& wrong) {
    const double long_s = (bench_.lossy() ? 400 : 40) * bench_.slot_s();
    if (wrong.kind == CommandKind::Home && !(bench_.vm().state()->remaining_s > long_s)) { return; }
    std::uint64_t program = 0;
    if (wrong.program) { program = bench_.send_program(*wrong.program); }
    const Reply* reply = bench_.ask(wrong.kind, program);
    if (reply == nullptr) { return; }
    if (bench_.watch().was_moving_at(reply->sequence) && !disturbed() && !is_refusal(*reply, wrong.refusal)) {
        bench_.object("refusal", "expected " + std::string(name_of(wrong.refusal)) + ", " + answer_text(*reply));
    }
}

void JobPlayer::resume() {
    if (ended()) { return; }
    const Reply* reply = bench_.ask_in_time(CommandKind::Resume);
    if (reply == nullptr) { return; }
    if (reply->status != ReplyStatus::Accepted) { return refused("resume", *reply); }
    moving_since_ = bench_.vm().now();
}

void JobPlayer::record() {
    bench_.end_stream();
    job_.end_step = bench_.steps_made();
    job_.outcome = begun_ ? bench_.watch().outcome().value_or(JobOutcome::Failed) : JobOutcome::Failed;
    for (std::size_t i = 0; i < at_.size(); ++i) {
        for (const std::int64_t way : bench_.recording().slide_ways(job_, i)) { at_[i] += way; }
    }
    record_probe();
    end_record(bench_, job_);
}

/// Takes the result of this job's probing move, if it has one.
void JobPlayer::record_probe() {
    if (!is_probing(task_.program)) { return; }
    job_.may_have_touched = !touches_.empty();
    if (job_.may_have_touched) {
        double seconds = 0;
        for (const std::size_t input : probe_inputs(bench_.machine())) {
            bench_.set_input(input, false);
            seconds = std::max(seconds, bench_.input_seconds(input));
        }
        bench_.wait(seconds);
    }
    const auto& result = bench_.vm().state()->probe;
    if (!begun_ || !result || result->job == probed_before_) { return; }
    if (result->job != bench_.vm().state()->job) { return; }  // a new owner reports the result of an earlier job
    job_.may_have_touched = result->touched();
    job_.probe = probe_record(bench_, task_.program, job_, at_);
    job_.probe->touches = touches_;
    job_.probe->is_undisturbed = !disturbed() && !job_.emergency;
}

}  // namespace lockstep::simtest
