// lockstep jog
#include <fmt/format.h>
#include <unistd.h>

#include "clients/lockstep/job/final_positions.hpp"
#include "clients/lockstep/job/hang_up.hpp"
#include "clients/lockstep/jog/jog_screen.hpp"
#include "clients/lockstep/jog/jog_words.hpp"
#include "clients/lockstep/live_options.hpp"
#include "clients/lockstep/verb.hpp"
#include "clients/session/control/jog_link.hpp"
#include "clients/session/control/lease_turn.hpp"
#include "clients/session/refusal.hpp"
#include "clients/session/reports.hpp"
#include "clients/session/status_text.hpp"
#include "clients/session/waits.hpp"
#include "clients/supervisor/machine_choice.hpp"
#include "clients/text/format.hpp"
#include "core/coordinator/jogs/jogs.hpp"
#include "services/runtime/clock.hpp"
#include "services/runtime/stop_signal.hpp"

namespace lockstep {
namespace {

using namespace std::chrono_literals;
using std::chrono::nanoseconds;

constexpr nanoseconds kBrakePatience = 10s;  // from the release to the end of the jog

struct JogVerbOptions : LiveOptions {
    JogOptions jog;
};

void warn_of_unhomed(const Session& session, const std::vector<JogAxis>& jogs, Output& output) {
    for (const JogAxis& jog : jogs) {
        const AxisConfig& axis = session.config().axes[jog.axis];
        const auto& received = session.received().axis(jog.axis);
        if (!received || received->state.homed || !axis.unhomed_jog_mm_s) { continue; }
        output.warn(
            fmt::format("axis {} is not homed: it jogs at {} mm/s at most, and only a limit switch ends the jog",
                        axis.name, fixed(*axis.unhomed_jog_mm_s, 2)));
    }
}

/// Whether each axis has reached the position where its jog ends by itself.
class Arrival {
public:
    Arrival(const Session& session, const std::vector<JogAxis>& jogs) : jogs_(jogs) {
        for (const JogAxis& jog : jogs) {
            const AxisState& state = session.received().axis(jog.axis)->state;
            targets_.push_back(jog_target(jog, session.config().axes[jog.axis], state.position.count(), state.homed));
        }
    }
    bool is_complete(const Session& session) const {
        for (std::size_t i = 0; i < jogs_.size(); ++i) {
            const auto& received = session.received().axis(jogs_[i].axis);
            // Where the jog began and ends, motors rest on whole steps of their own.
            const std::int64_t rests = 2 * session.received().kinematics().rest_steps(jogs_[i].axis);
            if (!received || std::abs(received->state.position.count() - targets_[i]) > rests) { return false; }
        }
        return true;
    }

private:
    std::vector<JogAxis> jogs_;
    std::vector<std::int64_t> targets_;
};

/// Renews the jog until it is over, or until a signal ends this process. Returns true if it released the jog early.
std::expected<bool, Failure> hold(Session& session, JogLink& link) {
    const StopSignal stop;
    const HangUp hang_up;
    while (!link.is_over() && !stop.requested() && !hang_up.came()) {
        link.pass(monotonic_now() + 20ms);
        if (session.is_silent()) { return std::unexpected(silence(session)); }
    }
    const bool is_released = !link.is_over();
    link.release();
    for (const nanoseconds end = session.owner().running_time() + kBrakePatience;
         session.owner().running_time() < end;) {
        link.pass(monotonic_now() + 20ms);
        const MachinePhase phase = session.state()->state.phase;
        if (phase != MachinePhase::Jogging && phase != MachinePhase::Stopping) { break; }
    }
    return is_released;
}

ExitCode finish(Session& session, const Arrival& arrival, bool is_released, proto::RunReport& report, Output& output) {
    add_final_positions(session, report);
    report.set_outcome(is_released ? "released" : arrival.is_complete(session) ? "done" : "stopped");
    if (auto fault = fault_of(session.state()->state, session.config())) {
        report.set_outcome("failed");
        *report.mutable_fault() = *std::move(fault);
    }
    output.report(report);
    output.print(fmt::format("jog {}: {}; at {}", report.name(), report.outcome(), places_text(report)));
    if (report.has_fault()) { output.print(fault_text(report.fault())); }
    return report.outcome() == "done" || report.outcome() == "released" ? kExitDone : kExitFailed;
}

ExitCode jog_by_words(Session& session, const JogOptions& options, const std::vector<JogAxis>& jogs, Output& output) {
    if (auto axes = reach_axes(session); !axes) { return output.fail(axes.error()); }
    warn_of_unhomed(session, jogs, output);
    const Arrival arrival(session, jogs);
    proto::RunReport report;
    report.set_kind("jog");
    report.set_name(fmt::format("{}", fmt::join(options.words, " ")));
    JogLink link(session);
    link.press(jogs);
    while (link.reply() == nullptr) {
        if (link.is_unanswered()) { return output.fail(silence(session)); }
        link.pass(monotonic_now() + 5ms);
    }
    if (link.reply()->status == ReplyStatus::Refused) {
        return print_refusal("jog " + report.name(), *link.reply(), report, output);
    }
    report.set_job(link.reply()->job);
    const auto released = hold(session, link);
    if (!released) { return output.fail(released.error()); }
    return finish(session, arrival, *released, report, output);
}

ExitCode jog(const JogVerbOptions& options) {
    Output output(options.json);
    const auto machine = choose_machine(options.machine_file);
    if (!machine) { return output.fail(machine.error()); }
    const auto jogs = jog_axes(machine->config, options.jog);
    if (!jogs) { return output.fail(bad_input(jogs.error())); }
    const bool has_keys = isatty(STDIN_FILENO) == 1 && output.is_terminal() && !options.json;
    if (jogs->empty() && !has_keys) {
        return output.fail(bad_input("without an axis, jog takes keys from a terminal; name axes: lockstep jog X+"));
    }
    auto session = Session::open(*machine, Purpose::Command);
    if (!session) { return output.fail(session.error()); }
    if (session->config_differs()) {
        output.warn("the coordinator runs another configuration than this command reads");
    }
    const LeaseTurn turn(*session, options.take);
    if (!turn.answer()) { return output.fail(turn.answer().error()); }
    if (turn.is_refused()) { return print_refusal(*turn.answer(), output); }
    if (!jogs->empty()) { return jog_by_words(*session, options.jog, *jogs, output); }
    await_axes(*session);
    return jog_by_keys(*session, options.jog.distance_mm, output);
}

}  // namespace

void add_jog(Verb command) {
    const Verb verb =
        command.add_verb("jog",
                         "move axes while this command runs\n"
                         "Without axes, the keys of the terminal move them. Named axes move until the end of "
                         "--distance or of their travel, or until Ctrl-C. Each axis moves independently of the "
                         "others, not on a straight line, unless their motors must move together. When the command "
                         "ends for any reason, the axes brake.");
    const auto options = std::make_shared<JogVerbOptions>();
    verb.add_option("axes", options->jog.words, "an axis and a direction: X+ Y-; default: the keys of the terminal");
    verb.add_option("--speed", options->jog.speed_mm_s,
                    "the speed of each axis, mm/s; default: 10, or the axis's maximum if that is less");
    verb.add_option(
        "--distance", options->jog.distance_mm,
        "how far each axis moves, mm; default: to the end of its travel. With keys: how far each press moves");
    add_take(verb, *options);
    add_live_options(verb, *options);
    verb.footer(
        footer("  lockstep jog\n  lockstep jog X+\n  lockstep jog X+ Y- --speed 25\n"
               "  lockstep jog Z- --speed 2 --distance 0.5\n"));
    verb.action([options] { return jog(*options); });
}

}  // namespace lockstep
