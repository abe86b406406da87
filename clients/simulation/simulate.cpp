#include "clients/simulation/simulate.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "clients/simulation/machine_recorder.hpp"
#include "clients/simulation/motion_clock.hpp"
#include "clients/simulation/program_feed.hpp"
#include "clients/simulation/sliding_rows.hpp"
#include "core/gcode/session/probe_touch.hpp"
#include "core/kinematics/axis_states.hpp"
#include "core/kinematics/kinematics.hpp"
#include "core/number_text.hpp"
#include "services/documents/machine_file.hpp"

namespace lockstep {
namespace {

constexpr Ticks kTurn{1'000'000};  // how long the machine runs between two checks
constexpr std::uint64_t kProgram = 1;

/// The output whose simulated spindle closes the input; null if there is none.
const OutputConfig* spindle_that_ends(const InputWait& wait, const MachineConfig& machine) {
    const InputConfig* const input = input_numbered(machine.inputs, InputUse::Program, wait.input);
    const auto closes = [&](const OutputConfig& output) {
        return input != nullptr && output.simulated_spin_up_s > 0 && output.at_speed == input->name;
    };
    const auto found = std::ranges::find_if(machine.outputs, closes);
    return found == machine.outputs.end() ? nullptr : &*found;
}

/// What to do about a wait that timed out.
std::string remedy_of_wait(const OutputConfig* spindle) {
    if (spindle == nullptr) { return "in a simulation the input is as wanted within milliseconds: give Q more time"; }
    return "the simulated spindle of output " + spindle->name + " takes up to " +
           number_text(spindle->simulated_spin_up_s) + " s (simulated_spin_up_s): raise its spin_up_s";
}

class Simulation {
public:
    Simulation(const MachineSetup& machine, RecordSink& sink, const SimulationHooks& hooks,
               const MakeRows& make_rows = memory_rows)
        : vm_({.machine = machine, .config_hash = config_hash(machine), .make_rows = make_rows}),
          recorder_(vm_, sink),
          hooks_(hooks) {
        vm_.observe(clock_);
    }

    std::expected<SimulationResult, std::string> run(const Program& program);
    std::expected<SimulationResult, std::string> run(ProgramText& program,
                                                     const std::function<void(std::size_t)>& make_room);

private:
    bool is(MachinePhase phase) const { return vm_.state() && vm_.state()->phase == phase; }
    bool at_rest() const { return is(MachinePhase::Idle) || is(MachinePhase::Fault) || is(MachinePhase::Paused); }
    std::expected<SimulationResult, std::string> home_and_run(const std::function<bool()>& give_program,
                                                              ProgramText* text);
    bool read_on(ProgramText* text);
    std::vector<std::int64_t> axis_counts() const;
    bool advance_while(const std::function<bool()>& busy);
    void advance_a_turn(const std::function<bool()>& busy);
    std::optional<Reply> ask(CommandKind kind, std::uint64_t program);
    bool do_job(CommandKind kind, std::uint64_t program);
    bool leave_pause();
    bool set_input(const InputWait& wait);
    bool homed() const;
    SimulatedStage stage_since(Tick tick, double computing_s) const;
    double stopwatch() const { return hooks_.stopwatch ? hooks_.stopwatch() : 0; }
    SimulationResult finish(SimulationResult result);

    VirtualMachine vm_;
    MotionClock clock_;
    MachineRecorder recorder_;
    const SimulationHooks& hooks_;
    std::optional<ProgramFeed> feed_;   // of a program that is read while it runs
    std::string trouble_;               // of the last command
    std::uint64_t program_ = kProgram;  // the newest one
    std::vector<ProbeTouch> touches_;
    Ticks motion_;  // of the parts that were run
};

/// Returns false if the caller cancelled.
bool Simulation::advance_while(const std::function<bool()>& busy) {
    while (busy()) {
        advance_a_turn(busy);
        const double progress = is(MachinePhase::Idle) || !vm_.state() ? 0 : vm_.state()->progress;
        if (hooks_.progress && !hooks_.progress(progress)) { return false; }
    }
    return true;
}

/// Feeds the program every two slots: the coordinator reads at most 200 blocks a slot, so a part of 1000 lasts longer.
void Simulation::advance_a_turn(const std::function<bool()>& busy) {
    const auto is_over = [&] { return !busy(); };
    const Ticks step = feed_ ? vm_.machine().slot_ticks() * 2 : kTurn;
    const Tick end = vm_.now() + kTurn;
    do {
        if (feed_) { feed_->tend(); }
        (void)vm_.advance_until(is_over, step);
    } while (busy() && vm_.now() < end);
}

/// Returns the reply once the machine's state shows its effect, or nullopt if the caller cancelled.
std::optional<Reply> Simulation::ask(CommandKind kind, std::uint64_t program) {
    const std::uint64_t sequence = vm_.command(kind, {}, program);
    if (!advance_while([&] { return vm_.reply_to(sequence) == nullptr; })) { return std::nullopt; }
    const Tick answered = vm_.now();
    if (!advance_while([&] { return vm_.state()->tick <= answered; })) { return std::nullopt; }
    std::optional<Reply> reply = *vm_.reply_to(sequence);
    vm_.forget_reply(sequence);
    if (reply->status == ReplyStatus::Refused) { trouble_ = reply->text; }
    return reply;
}

/// Runs to the job's end and resumes the job at each pause. Returns false if the caller cancelled.
bool Simulation::do_job(CommandKind kind, std::uint64_t program) {
    const std::optional<Reply> reply = ask(kind, program);
    if (!reply || reply->status == ReplyStatus::Refused) { return reply.has_value(); }
    const std::uint64_t job = reply->job;
    const auto ended = [&] { return clock_.last_ended() && clock_.last_ended()->job == job; };
    while (!ended()) {
        if (!advance_while([&] { return !ended() && !is(MachinePhase::Paused); })) { return false; }
        if (!ended() && !leave_pause()) { return false; }
    }
    return advance_while([&] { return !at_rest(); });
}

/// A simulated spindle closes its input by itself; nobody changes another one but the wait for it. Returns false if the
/// caller cancelled.
bool Simulation::leave_pause() {
    const Pause why = vm_.state()->pause ? vm_.state()->pause->why : Pause{};
    if (why.reason == PauseReason::InputTimeout) {
        if (!ask(CommandKind::Stop, 0)) { return false; }
        const OutputConfig* const spindle = why.wait ? spindle_that_ends(*why.wait, vm_.machine()) : nullptr;
        trouble_ = text_of(why) + "; " + remedy_of_wait(spindle);
        return true;
    }
    return why.wait ? set_input(*why.wait) : ask(CommandKind::Resume, 0).has_value();
}

/// Makes the input as wanted, and returns when the machine no longer waits. An edge needs the other level first.
bool Simulation::set_input(const InputWait& wait) {
    const auto waits = [&] {
        return is(MachinePhase::Paused) && vm_.state()->pause && vm_.state()->pause->why.reason == PauseReason::Input;
    };
    if (spindle_that_ends(wait, vm_.machine()) != nullptr) { return advance_while(waits); }
    const std::vector<InputConfig>& inputs = vm_.machine().inputs;
    const auto input = static_cast<std::size_t>(input_numbered(inputs, InputUse::Program, wait.input) - inputs.data());
    const bool is_closed = wait.mode == InputMode::Closes || wait.mode == InputMode::IsClosed;
    if (wait.mode == InputMode::Closes || wait.mode == InputMode::Opens) {
        vm_.set_input(input, !is_closed);
        const Ticks debounce{std::llround(inputs[input].debounce_ms * 1e-3 * vm_.machine().ticks_per_second())};
        const Tick seen = vm_.now() + debounce + vm_.machine().slot_ticks() * 10;
        if (!advance_while([&] { return vm_.now() < seen; })) { return false; }
    }
    vm_.set_input(input, is_closed);
    return advance_while(waits);
}

bool Simulation::homed() const {
    return clock_.last_ended() && clock_.last_ended()->outcome == JobOutcome::Done && is(MachinePhase::Idle);
}

SimulatedStage Simulation::stage_since(Tick tick, double computing_s) const {
    return {static_cast<double>((vm_.now() - tick).value) / vm_.machine().ticks_per_second(),
            stopwatch() - computing_s};
}

SimulationResult Simulation::finish(SimulationResult result) {
    recorder_.finish();
    if (const auto& state = vm_.state(); state && state->fault != FaultCode::None) {
        result.fault = state->fault;
        result.fault_motor = state->fault_motor;
    } else if (feed_ && state && state->job_fault != FaultCode::None) {
        result.fault = state->job_fault;
    }
    if (trouble_.empty() && feed_) { trouble_ = feed_->trouble(); }
    if (result.fault != FaultCode::None && trouble_.empty()) {
        const FaultText* text = find_fault(result.fault);
        trouble_ = text != nullptr ? std::string(text->cause) : "unknown fault";
    }
    result.trouble = trouble_;
    result.steps = recorder_.steps();
    result.final_counts = axis_counts();
    result.touches = touches_;
    return result;
}

std::vector<std::int64_t> Simulation::axis_counts() const {
    MotorCounts motors;
    for (const auto& motor : vm_.axis_states()) { motors.steps.append(motor ? slide_of(*motor).count() : 0); }
    const AxisCounts counts = Kinematics(vm_.machine()).axes_at(motors);
    return {counts.begin(), counts.end()};
}

std::expected<SimulationResult, std::string> Simulation::run(const Program& program) {
    return home_and_run(
        [&] {
            vm_.give_program(program_, program);
            return true;
        },
        nullptr);
}

/// Begins the program as soon as its first part has arrived.
std::expected<SimulationResult, std::string> Simulation::run(ProgramText& program,
                                                             const std::function<void(std::size_t)>& make_room) {
    return home_and_run(
        [&] {
            feed_.emplace(vm_, program_, program, make_room);
            return advance_while([&] { return !feed_->has_begun(); });
        },
        &program);
}

/// Reads on behind the probing move with which the last job ended. Returns false if there is none, or nothing follows.
bool Simulation::read_on(ProgramText* text) {
    const bool is_done = clock_.last_ended() && clock_.last_ended()->outcome == JobOutcome::Done;
    if (text == nullptr || !is_done || !text->awaits_touch() || !vm_.state()->probe) { return false; }
    const ProbeResult& probe = *vm_.state()->probe;
    std::vector<double> rest_mm;
    const std::vector<std::int64_t> counts = axis_counts();
    for (std::size_t i = 0; i < counts.size(); ++i) {
        rest_mm.push_back(to_mm(vm_.machine().axes[i], static_cast<double>(counts[i])));
    }
    ProbeTouch touch = touch_from(probe, std::move(rest_mm)).value();  // both are of this machine
    text->touched(touch);
    touches_.push_back(std::move(touch));
    if (!text->ends_before(0) || text->errors().empty()) { return !text->ends_before(0); }
    trouble_ = place_and_text(text->head().name, text->errors().front());
    return false;
}

/// `give_program` returns false if the caller cancelled. `text`: of a program that may go on behind a touch; may be
/// null.
std::expected<SimulationResult, std::string> Simulation::home_and_run(const std::function<bool()>& give_program,
                                                                      ProgramText* text) {
    const auto given_up = [] { return std::unexpected(std::string("interrupted before its end")); };
    SimulationResult result;
    const Tick power_up = vm_.now();
    double computing_s = stopwatch();
    if (!advance_while([&] { return !at_rest(); })) { return given_up(); }
    if (!do_job(CommandKind::Home, 0)) { return given_up(); }
    result.homing = stage_since(power_up, computing_s);
    if (!homed()) { return finish(std::move(result)); }

    const Tick begin = vm_.now();
    computing_s = stopwatch();
    do {
        if (!give_program() || !do_job(CommandKind::Run, program_++)) { return given_up(); }
        motion_ += clock_.motion();
    } while (trouble_.empty() && read_on(text));
    result.running = stage_since(begin, computing_s);
    if (trouble_.empty()) {
        result.job = clock_.last_ended()->job;
        result.outcome = clock_.last_ended()->outcome;
        result.motion = motion_;
    }
    return finish(std::move(result));
}

}  // namespace

std::expected<SimulationResult, std::string> simulate(const MachineSetup& machine, const Program& program,
                                                      RecordSink& sink, const SimulationHooks& hooks) {
    return Simulation(machine, sink, hooks).run(program);
}

std::expected<SimulationResult, std::string> simulate(const MachineSetup& machine, ProgramText& program,
                                                      RecordSink& sink, const SimulationHooks& hooks,
                                                      std::uint64_t kept_bytes) {
    SlidingRows* rows = nullptr;  // the coordinator's
    const auto make_rows = [&](std::size_t width) {
        const std::uint64_t most =
            std::max<std::uint64_t>(2 * ProgramFeed::kBlocks, kept_bytes / (width * sizeof(double)));
        auto made = std::make_unique<SlidingRows>(width, most);
        rows = made.get();
        return made;
    };
    Simulation simulation(machine, sink, hooks, make_rows);
    auto result = simulation.run(program, [&](std::size_t blocks) { rows->widen(blocks); });
    if (result && rows != nullptr) { result->most_blocks_kept = rows->most_kept(); }
    return result;
}

}  // namespace lockstep
