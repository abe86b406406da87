// lockstep simulate
#include <fmt/format.h>

#include <algorithm>
#include <expected>
#include <functional>
#include <memory>

#include "clients/lockstep/live_options.hpp"
#include "clients/lockstep/offline/program_input.hpp"
#include "clients/lockstep/verb.hpp"
#include "clients/planning/program_text.hpp"
#include "clients/session/control/probe_touch.hpp"
#include "clients/session/reports.hpp"
#include "clients/simulation/simulate.hpp"
#include "clients/supervisor/machine_choice.hpp"
#include "clients/text/format.hpp"
#include "clients/text/notes.hpp"
#include "clients/text/output.hpp"
#include "core/coordinator/path/coordination.hpp"
#include "core/kinematics/motors.hpp"
#include "core/protocol/names.hpp"
#include "services/documents/program_file.hpp"
#include "services/record/new_log_file.hpp"
#include "services/runtime/clock.hpp"
#include "services/runtime/stop_signal.hpp"

namespace lockstep {
namespace {

struct SimulateOptions : ProgramOptions {
    std::string log;
    bool force = false;
    bool speed_report = false;
};

double seconds_now() { return static_cast<double>(monotonic_now().count()) * 1e-9; }

std::string outcome_of(const SimulationResult& result) {
    return result.job == 0 ? "failed" : std::string(name_of(result.outcome));
}

proto::RunReport run_report(const PlannedFile& input, const SimulationResult& result) {
    proto::RunReport report;
    report.set_job(result.job);
    report.set_kind("run");
    report.set_name(input.plan.program);
    report.set_outcome(outcome_of(result));
    report.set_planned_s(input.plan.duration_s);
    report.set_real_s(static_cast<double>(result.motion.value) / input.machine.ticks_per_second());
    if (result.fault != FaultCode::None) {
        *report.mutable_fault() = result.fault_motor
                                      ? motor_fault(result.fault, Kinematics(input.machine), *result.fault_motor)
                                      : fault_report(result.fault, "");
    }
    for (const ProbeTouch& touch : result.touches) { *report.add_probes() = probe_report(input.machine, touch); }
    for (std::size_t i = 0; i < result.final_counts.size(); ++i) {
        proto::FinalPosition& place = *report.add_final_positions();
        place.set_name(input.machine.axes[i].name);
        place.set_position_steps(result.final_counts[i]);
        place.set_position_mm(to_mm(input.machine.axes[i], static_cast<double>(result.final_counts[i])));
    }
    return report;
}

std::string speed_row(const std::string& name, const SimulatedStage& stage) {
    return fmt::format("\n  {}{} s of machine time in {} s, {} times real time", name, fixed(stage.machine_s, 3),
                       fixed(stage.computing_s, 3), fixed(stage.times_real_time(), 0));
}

std::string in_words(const SimulateOptions& options, const PlannedFile& input, const SimulationResult& result) {
    const SimulatedStage all{result.homing.machine_s + result.running.machine_s,
                             result.homing.computing_s + result.running.computing_s};
    std::string text = fmt::format("{}: {}, {} steps recorded in {}; {} times real time", input.plan.program,
                                   outcome_of(result), result.steps, options.log, fixed(all.times_real_time(), 0));
    if (!options.speed_report) { return text; }
    text += speed_row("homing   ", result.homing) + speed_row("program  ", result.running);
    return text + "\n  " + fixed(static_cast<double>(result.steps) / std::max(all.computing_s, 1e-9) / 1000, 0) +
           " thousand steps a second";
}

using Simulate = std::function<std::expected<SimulationResult, std::string>(RecordSink&, const SimulationHooks&)>;

ExitCode record_simulation(const SimulateOptions& options, const PlannedFile& input, const Simulate& run,
                           Output& output) {
    warn_of(input.notes, output);
    auto log = NewLogFile::begin(options.log, options.force);
    if (!log) { return output.fail(bad_input(log.error())); }
    const StopSignal stop;
    const auto show = output.percent_on_terminal("simulating");
    const auto progress = [&](double done) {
        if (show) { show(done); }
        return !stop.requested();
    };
    const auto result = run(log->sink(), {.progress = progress, .stopwatch = seconds_now});
    if (!result) { return output.fail(failed(result.error() + "; no log was written")); }
    if (auto kept = log->keep(); !kept) { return output.fail(failed(kept.error())); }
    const proto::RunReport report = run_report(input, *result);
    for (const proto::ProbeReport& probe : report.probes()) { output.print(report.name() + ": " + text_of(probe)); }
    output.print(in_words(options, input, *result));
    output.report(report);
    if (!result->trouble.empty()) { output.warn(result->trouble); }
    return result->job != 0 && result->outcome == JobOutcome::Done ? kExitDone : kExitFailed;
}

GcodeSetup awaiting_touches(GcodeSetup setup) {
    setup.awaits_touches = true;
    return setup;
}

ExitCode simulate_lines(const SimulateOptions& options, const PlannedFile& input, LineReader lines, Output& output) {
    ProgramText text(std::move(lines), awaiting_touches(input.setup));
    const auto run = [&](RecordSink& sink, const SimulationHooks& hooks) {
        return simulate(input.machine, text, sink, hooks);
    };
    return record_simulation(options, input, run, output);
}

ExitCode simulate_short_file(const SimulateOptions& options) {
    Output output(options.json);
    auto lines = LineReader::open(options.file);
    const auto input = read_program(options);
    if (!input) { return output.fail(input.error()); }
    if (lines && does_probe(input->program)) { return simulate_lines(options, *input, *std::move(lines), output); }
    const auto run = [&](RecordSink& sink, const SimulationHooks& hooks) {
        return simulate(input->machine, input->program, sink, hooks);
    };
    return record_simulation(options, *input, run, output);
}

/// Reads the file twice: first to check it, then to run it. It is opened before the check, so that a file that replaces
/// it in the meantime is not run.
ExitCode simulate_long_file(const SimulateOptions& options) {
    Output output(options.json);
    auto lines = LineReader::open(options.file);
    if (!lines) { return output.fail(bad_file(options.file, {{.message = lines.error()}})); }
    const auto input = plan_file(options, output);
    if (!input) { return output.fail(input.error()); }
    return simulate_lines(options, *input, *std::move(lines), output);
}

/// Whether the file is read while it runs.
bool is_streamed(const SimulateOptions& options) {
    if (!is_long_program(options.file)) { return false; }
    const auto machine = choose_machine(options.machine_file);
    return machine && !coordination_of(machine->config).plans_whole;
}

}  // namespace

void add_simulate(Verb command) {
    const Verb verb =
        command.add_verb("simulate",
                         "run a G-code file on a simulated machine, and write its log\n"
                         "The simulated machine is homed first, does not pause, and writes the same log as a "
                         "live run.");
    const auto options = std::make_shared<SimulateOptions>();
    add_program_options(verb, *options);
    verb.add_option("--log", options->log, "the LCM log to write; a log of that name is replaced").required();
    verb.add_flag("--force", options->force, "replace the file even if it is not a log");
    verb.add_flag("--speed-report", options->speed_report, "report how fast each stage was simulated");
    verb.footer(
        footer("  lockstep simulate plate.gcode --machine mill.textproto --log plate.lcm\n"
               "  lockstep verify plate.lcm\n"));
    verb.action(
        [options] { return is_streamed(*options) ? simulate_long_file(*options) : simulate_short_file(*options); });
}

}  // namespace lockstep
