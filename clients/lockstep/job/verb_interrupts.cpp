// lockstep hold, resume, stop, estop, reset
#include <array>

#include "clients/lockstep/job/confirm.hpp"
#include "clients/lockstep/live_options.hpp"
#include "clients/lockstep/verb.hpp"
#include "clients/session/command_effect.hpp"
#include "clients/session/control/lease_turn.hpp"
#include "clients/session/refusal.hpp"
#include "clients/session/reports.hpp"
#include "clients/session/session.hpp"
#include "clients/session/status_text.hpp"
#include "clients/session/waits.hpp"
#include "clients/supervisor/machine_choice.hpp"
#include "clients/text/format.hpp"
#include "clients/text/output.hpp"
#include "core/coordinator/path/return_way.hpp"
#include "core/kinematics/motors.hpp"
#include "core/protocol/names.hpp"
#include "idl/proto/report.pb.h"

namespace lockstep {
namespace {

struct InterruptOptions : LiveOptions {
    bool yes = false;  // resume: return without asking
};

struct Interrupt {
    const char* name;
    CommandKind command;
    const char* what;
    const char* then;  // the next command for the user
};

constexpr std::array kInterrupts{
    Interrupt{"hold", CommandKind::Hold, "bring the machine to rest on its path; the job can be resumed",
              "continue with: lockstep resume; end the job with: lockstep stop"},
    Interrupt{"resume", CommandKind::Resume,
              "continue a job that is held or paused\n"
              "Axes that were jogged in the pause return first.",
              "watch it with: lockstep watch"},
    Interrupt{"stop", CommandKind::Stop, "bring the machine to rest on its path, and end the job", ""},
    Interrupt{"estop", CommandKind::EmergencyStop,
              "stop all pulses at once, also without a coordinator\n"
              "Axes that were in motion must then be homed again.",
              "when it is safe: lockstep reset; lockstep status shows which axes to home"},
    Interrupt{"reset", CommandKind::Reset, "leave Fault after its cause is removed", ""},
};

/// Whether it needs no lease, because it only makes the machine safer.
bool is_everybodys(const Interrupt& interrupt) {
    return interrupt.command != CommandKind::Resume && interrupt.command != CommandKind::Reset;
}

/// The next command for the user. After a hold that ended homing there is none, since homing cannot be resumed.
std::string next_text(const Session& session, const Interrupt& interrupt, MachinePhase phase) {
    if (interrupt.command != CommandKind::Hold || phase == MachinePhase::Holding || phase == MachinePhase::Paused) {
        return interrupt.then;
    }
    return unhomed_text(status_report(session));
}

ExitCode report_outcome(Session& session, const Interrupt& interrupt, const Reply& reply, Output& output) {
    if (reply.status == ReplyStatus::Refused) { return print_refusal(reply, output); }
    const auto phase = await_effect(session, interrupt.command);
    if (!phase) { return output.fail(failed(std::string(interrupt.name) + ": accepted, but " + phase.error())); }
    proto::CommandReport report;
    report.set_accepted(true);
    report.set_text("the machine is " + std::string(name_of(*phase)));
    output.report(report);
    const std::string then = next_text(session, interrupt, *phase);
    output.print(std::string(interrupt.name) + ": accepted; " + report.text() + (then.empty() ? "" : "\n" + then));
    return kExitDone;
}

/// Axes that were jogged in a pause first return to its place. A person must confirm the way, or a script pass --yes.
std::expected<bool, Failure> confirm_return(const InterruptOptions& options, Session& session, Output& output) {
    await_axes(session);
    const auto way = way_back(session);
    if (!way) { return false; }
    output.print("axes were moved in the pause; the machine first returns to its place: " + text_of_way(*way));
    if (options.yes) { return true; }
    const auto confirmed = confirm_motion(options.json, output,
                                          "axes were moved in the pause, and without a terminal resume cannot ask "
                                          "whether the machine may return to its place (" +
                                              text_of_way(*way) + "): check the way, then add --yes");
    return confirmed ? std::expected<bool, Failure>(true) : std::unexpected(confirmed.error());
}

ExitCode interrupt_machine(const InterruptOptions& options, const Interrupt& interrupt) {
    Output output(options.json);
    const auto machine = choose_machine(options.machine_file);
    if (!machine) { return output.fail(machine.error()); }
    auto session = Session::open(*machine, Purpose::Command);
    if (!session) { return output.fail(session.error()); }
    std::optional<LeaseTurn> turn;
    if (!is_everybodys(interrupt)) { turn.emplace(*session, options.take); }
    if (turn && !turn->answer()) { return output.fail(turn->answer().error()); }
    if (turn && turn->is_refused()) { return print_refusal(*turn->answer(), output); }
    Command command{.kind = interrupt.command};
    if (interrupt.command == CommandKind::Resume) {
        const auto returns = confirm_return(options, *session, output);
        if (!returns) { return output.fail(returns.error()); }
        command.returns = *returns;
    }
    const auto reply = send_command(*session, command);
    if (!reply) { return output.fail(reply.error()); }
    return report_outcome(*session, interrupt, *reply, output);
}

/// Whether the axis is at rest with a fault, so that nothing moves it before a reset.
bool is_stopped(const Session& session, MotorIndex motor) {
    const bool is_known = session.received().motor_present(motor);
    return is_known && session.received().motor(motor)->state.at_rest &&
           session.received().motor(motor)->state.fault != FaultCode::None;
}

/// Reports which axes have stopped by themselves, if no coordinator replies.
ExitCode report_axes(const Session& session, Output& output) {
    std::string stopped;
    std::string other;
    for (const MotorIndex i : motor_indices(session.received().kinematics().motors().size())) {
        std::string& list = is_stopped(session, i) ? stopped : other;
        list += (list.empty() ? "" : ", ") + motor_name(session.config(), i);
    }
    if (stopped.empty()) { return output.fail(silence(session)); }
    proto::CommandReport report;
    report.set_accepted(other.empty());
    report.set_text("no coordinator answers; these axes have stopped by themselves until a reset: " + stopped +
                    (other.empty() ? "" : "; these axes may not have stopped: " + other));
    output.report(report);
    output.print("estop: " + report.text() + "\nsee: lockstep status; take the machine down: lockstep down");
    return other.empty() ? kExitDone : kExitFailed;
}

/// Axes receive an emergency stop directly, so it needs no coordinator.
ExitCode stop_at_once(const LiveOptions& options, const Interrupt& interrupt) {
    Output output(options.json);
    const auto machine = choose_machine(options.machine_file);
    if (!machine) { return output.fail(machine.error()); }
    auto session = Session::join(*machine, Purpose::Command);
    if (!session) { return output.fail(session.error()); }
    const auto reply = send_command(*session, {.kind = interrupt.command});
    return reply ? report_outcome(*session, interrupt, *reply, output) : report_axes(*session, output);
}

}  // namespace

void add_interrupts(Verb command) {
    for (const Interrupt& interrupt : kInterrupts) {
        const Verb verb = command.add_verb(interrupt.name, interrupt.what);
        const auto options = std::make_shared<InterruptOptions>();
        if (interrupt.command == CommandKind::Resume) {
            verb.add_flag("--yes", options->yes,
                          "if axes were moved in the pause: let the machine return to its place without asking");
        }
        if (!is_everybodys(interrupt)) { add_take(verb, *options); }
        add_live_options(verb, *options);
        verb.footer(footer(std::string("  lockstep ") + interrupt.name + "\n"));
        verb.action([&interrupt, options] {
            const bool at_once = interrupt.command == CommandKind::EmergencyStop;
            return at_once ? stop_at_once(*options, interrupt) : interrupt_machine(*options, interrupt);
        });
    }
}

}  // namespace lockstep
