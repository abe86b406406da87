// lockstep hold, resume, stop, estop, reset
#include <array>

#include <CLI/CLI.hpp>

#include "clients/lockstep/live/live_options.hpp"
#include "clients/lockstep/live/refusal.hpp"
#include "clients/lockstep/live/session.hpp"
#include "clients/lockstep/live/voice.hpp"
#include "clients/lockstep/live/words.hpp"
#include "clients/lockstep/verb.hpp"
#include "idl/proto/report.pb.h"
#include "services/runtime/clock.hpp"

namespace lockstep {
namespace {

using namespace std::chrono_literals;

struct Interrupt {
    const char* name;
    CommandKind command;
    const char* what;
    bool (*is_settled)(MachinePhase);  // what the verb waits for, once accepted
    const char* then;                  // what a person may do next
};

bool is_at_rest(MachinePhase phase) { return phase != MachinePhase::Running && phase != MachinePhase::Stopping; }
bool is_ready(MachinePhase phase) { return phase == MachinePhase::Idle || phase == MachinePhase::Fault; }
bool is_anything(MachinePhase) { return true; }

constexpr std::array kInterrupts{
    Interrupt{"hold", CommandKind::Hold, "bring the machine to rest on its path, to be resumed", is_at_rest,
              "go on with: lockstep resume; end the job with: lockstep stop"},
    Interrupt{"resume", CommandKind::Resume, "go on with a job that is held or paused", is_anything,
              "watch it with: lockstep watch"},
    Interrupt{"stop", CommandKind::Stop, "bring the machine to rest on its path and drop the job", is_at_rest, ""},
    Interrupt{"estop", CommandKind::EmergencyStop,
              "cease all pulses at once, also without a coordinator; positions are kept, homing is suspect",
              is_anything, "when it is safe: lockstep reset, lockstep home"},
    Interrupt{"reset", CommandKind::Reset, "leave Fault, once its cause is gone", is_ready, ""},
};

constexpr std::chrono::seconds kSettlePatience{10};
constexpr std::chrono::seconds kStopPatience{3};

/// Waits for states said after the reply; a machine that takes longer is left to itself.
void settle(Session& session, const Interrupt& interrupt) {
    const auto replied = monotonic_now();
    const auto is_settled = [&] {
        const auto& heard = session.state();
        const auto slot = std::chrono::microseconds{session.config().timing.slot_us};
        return heard && heard->time > replied + slot && interrupt.is_settled(heard->state.phase);
    };
    while (!is_settled() && monotonic_now() - replied < kSettlePatience) { session.listen(50ms); }
}

ExitCode say_outcome(Session& session, const Interrupt& interrupt, const Reply& reply, Voice& voice) {
    proto::CommandReport report;
    report.set_accepted(reply.status == ReplyStatus::Accepted);
    if (!report.accepted()) { return say_refusal(reply, voice); }
    settle(session, interrupt);
    report.set_text(session.state() ? "the machine is " + std::string(name_of(session.state()->state.phase))
                                    : "the machine has not said its state yet");
    voice.report(report);
    const std::string then = interrupt.then;
    voice.say(std::string(interrupt.name) + ": accepted; " + report.text() + (then.empty() ? "" : "\n" + then));
    return kExitDone;
}

ExitCode interrupt_machine(const LiveOptions& options, const Interrupt& interrupt) {
    Voice voice(options.json);
    const auto machine = choose_machine(options.machine_file);
    if (!machine) { return voice.fail(machine.error()); }
    auto session = Session::open(*machine, Purpose::Command);
    if (!session) { return voice.fail(session.error()); }
    const auto reply = session->command({.kind = interrupt.command});
    if (!reply) { return voice.fail(reply.error()); }
    return say_outcome(*session, interrupt, *reply, voice);
}

/// Which axes stand and which do not, where nobody speaks for the machine.
ExitCode say_axes(const Session& session, Voice& voice) {
    std::string at_rest;
    std::string other;
    for (std::size_t i = 0; i < session.config().axes.size(); ++i) {
        const bool rests = session.axis_present(i) && session.axis(i)->state.at_rest;
        std::string& list = rests ? at_rest : other;
        list += (list.empty() ? "" : ", ") + session.config().axes[i].name;
    }
    if (at_rest.empty()) { return voice.fail(session.silent()); }
    proto::CommandReport report;
    report.set_accepted(other.empty());
    report.set_text("no coordinator answers; at rest by themselves: " + at_rest +
                    (other.empty() ? "" : "; in motion or not heard: " + other));
    voice.report(report);
    voice.say("estop: " + report.text() + "\nsee: lockstep status; take the machine down: lockstep down");
    return other.empty() ? kExitDone : kExitFailed;
}

/// The axes hear it themselves: it needs no coordinator.
ExitCode stop_at_once(const LiveOptions& options, const Interrupt& interrupt) {
    Voice voice(options.json);
    const auto machine = choose_machine(options.machine_file);
    if (!machine) { return voice.fail(machine.error()); }
    auto session = Session::join(*machine, Purpose::Command);
    if (!session) { return voice.fail(session.error()); }
    const auto reply = session->stop_at_once(kStopPatience);
    return reply ? say_outcome(*session, interrupt, *reply, voice) : say_axes(*session, voice);
}

}  // namespace

void add_interrupts(CLI::App& app, Action& action) {
    for (const Interrupt& interrupt : kInterrupts) {
        CLI::App* verb = app.add_subcommand(interrupt.name, interrupt.what);
        const auto options = std::make_shared<LiveOptions>();
        add_live_options(*verb, *options);
        verb->footer(footer(std::string("  lockstep ") + interrupt.name + "\n"));
        verb->callback([&action, &interrupt, options] {
            action = [&interrupt, options] {
                const bool at_once = interrupt.command == CommandKind::EmergencyStop;
                return at_once ? stop_at_once(*options, interrupt) : interrupt_machine(*options, interrupt);
            };
        });
    }
}

}  // namespace lockstep
