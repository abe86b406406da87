#include "clients/simulation/simulate.hpp"

#include "clients/simulation/machine_recorder.hpp"
#include "clients/simulation/motion_clock.hpp"
#include "services/documents/machine_file.hpp"

namespace lockstep {
namespace {

constexpr Ticks kTurn{1'000'000};  // how far the machine runs between two checks of it
constexpr std::uint64_t kProgram = 1;

class Simulation {
public:
    Simulation(const MachineConfig& machine, RecordSink& sink, const SimulationHooks& hooks)
        : vm_({.machine = machine, .config_hash = config_hash(machine)}), recorder_(vm_, sink), hooks_(hooks) {
        vm_.observe(clock_);
    }

    std::expected<SimulationResult, std::string> run(const Program& program);

private:
    bool is(MachinePhase phase) const { return vm_.state() && vm_.state()->phase == phase; }
    bool at_rest() const { return is(MachinePhase::Idle) || is(MachinePhase::Fault) || is(MachinePhase::Paused); }
    bool advance_while(const std::function<bool()>& busy);
    const Reply* ask(CommandKind kind, std::uint64_t program);
    bool do_job(CommandKind kind, std::uint64_t program);
    bool homed() const;
    SimulatedStage stage_since(Tick tick, double computing_s) const;
    double stopwatch() const { return hooks_.stopwatch ? hooks_.stopwatch() : 0; }
    SimulationResult finish(SimulationResult result);

    VirtualMachine vm_;
    MotionClock clock_;
    MachineRecorder recorder_;
    const SimulationHooks& hooks_;
    std::string trouble_;  // of the last command
};

/// False: the caller cancelled.
bool Simulation::advance_while(const std::function<bool()>& busy) {
    while (busy()) {
        vm_.advance_until([&] { return !busy(); }, kTurn);
        const double progress = is(MachinePhase::Idle) || !vm_.state() ? 0 : vm_.state()->progress;
        if (hooks_.progress && !hooks_.progress(progress)) { return false; }
    }
    return true;
}

/// The reply, once the machine's state shows its effect; null: the caller cancelled.
const Reply* Simulation::ask(CommandKind kind, std::uint64_t program) {
    const std::uint64_t sequence = vm_.command(kind, 0, program);
    if (!advance_while([&] { return vm_.reply_to(sequence) == nullptr; })) { return nullptr; }
    const Tick answered = vm_.now();
    if (!advance_while([&] { return vm_.state()->tick <= answered; })) { return nullptr; }
    const Reply* reply = vm_.reply_to(sequence);
    if (reply->status == ReplyStatus::Refused) { trouble_ = reply->text; }
    return reply;
}

/// Runs to the job's end, resuming it at each pause. False: the caller cancelled.
bool Simulation::do_job(CommandKind kind, std::uint64_t program) {
    const Reply* reply = ask(kind, program);
    if (reply == nullptr || reply->status == ReplyStatus::Refused) { return reply != nullptr; }
    const std::uint64_t job = reply->job;
    const auto ended = [&] { return clock_.last_ended() && clock_.last_ended()->job == job; };
    while (!ended()) {
        if (!advance_while([&] { return !ended() && !is(MachinePhase::Paused); })) { return false; }
        if (!ended() && ask(CommandKind::Resume, 0) == nullptr) { return false; }
    }
    return advance_while([&] { return !at_rest(); });
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
    if (const auto& state = vm_.state(); state && state->fault != 0) {
        result.fault = static_cast<FaultCode>(state->fault);
        result.fault_axis = state->fault_axis;
    }
    if (result.fault != FaultCode::None && trouble_.empty()) {
        const FaultText* text = find_fault(result.fault);
        trouble_ = text != nullptr ? std::string(text->cause) : "unknown fault";
    }
    result.trouble = trouble_;
    result.steps = recorder_.steps();
    for (const auto& axis : vm_.axis_states()) { result.final_counts.push_back(axis ? axis->position.count() : 0); }
    return result;
}

std::expected<SimulationResult, std::string> Simulation::run(const Program& program) {
    const auto given_up = [] { return std::unexpected(std::string("cancelled before its end")); };
    SimulationResult result;
    const Tick power_up = vm_.now();
    double computing_s = stopwatch();
    if (!advance_while([&] { return !at_rest(); })) { return given_up(); }
    if (!do_job(CommandKind::Home, 0)) { return given_up(); }
    result.homing = stage_since(power_up, computing_s);
    if (!homed()) { return finish(std::move(result)); }

    const Tick begin = vm_.now();
    computing_s = stopwatch();
    vm_.give_program(kProgram, program);
    if (!do_job(CommandKind::Run, kProgram)) { return given_up(); }
    result.running = stage_since(begin, computing_s);
    if (trouble_.empty()) {
        result.job = clock_.last_ended()->job;
        result.outcome = clock_.last_ended()->outcome;
        result.motion = clock_.motion();
    }
    return finish(std::move(result));
}

}  // namespace

std::expected<SimulationResult, std::string> simulate(const MachineConfig& machine, const Program& program,
                                                      RecordSink& sink, const SimulationHooks& hooks) {
    return Simulation(machine, sink, hooks).run(program);
}

}  // namespace lockstep
