#include "clients/session/waits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <ranges>

#include "services/documents/placement.hpp"
#include "services/documents/values/values_trouble.hpp"
#include "services/network/host_name.hpp"
#include "services/runtime/clock.hpp"
#include "services/wire/dds/dds_log.hpp"

namespace lockstep {
namespace {

using namespace std::chrono_literals;
using std::chrono::nanoseconds;

constexpr nanoseconds kReceivedPatience = 5s;   // for an axis that the coordinator receives: this process will, too
constexpr nanoseconds kAbsentPatience = 500ms;  // for an axis that the coordinator does not receive

std::size_t motors_of(const Session& session) { return session.received().kinematics().motors().size(); }

std::string place_text(const MachineSetup& machine) {
    return fmt::format("machine '{}' answers on interface {}, domain {}", machine.name, machine.network.interface,
                       machine.network.domain);
}

/// The axes' processes on the network, also those that publish nothing yet.
std::string present_axes(const Session& session) {
    std::string names;
    for (const PresentProcess& process : session.present()) {
        if (!process.motor || *process.motor >= motors_of(session)) { continue; }
        const std::string& name = session.received().kinematics().motors()[*process.motor].name;
        names += (names.empty() ? "" : ", ") + name + " on " + process.host;
    }
    return names;
}

Failure interrupted() { return failed("interrupted; nothing was begun"); }

bool is_requested(const StopSignal* stop) { return stop != nullptr && stop->requested(); }

/// Waits until `done` returns true, as long as the coordinator answers.
std::expected<void, Failure> await_parts(Session& session, const std::function<bool()>& done, const StopSignal* stop) {
    while (!done()) {
        if (is_requested(stop)) { return std::unexpected(interrupted()); }
        if (is_upload_overdue(session)) { return std::unexpected(silence(session)); }
        session.receive(50ms);
        if (const auto& refusal = session.upload().sender()->refusal()) {
            return std::unexpected(failed(refusal->text));
        }
    }
    return {};
}

}  // namespace

Failure silence(const Session& session) {
    const MachineSetup& machine = session.config();
    const std::string refused = last_dds_message().empty() ? "" : " (DDS reports: " + last_dds_message() + ")";
    const std::string none = "no coordinator of " + place_text(machine) + refused;
    if (const std::string& host = machine.coordinator_host; !host.empty() && !same_host(host, host_name())) {
        const std::string waiting = present_axes(session);
        return unreachable(fmt::format("{}; it runs on {}; on that host: lockstep up{}", none, host,
                                       (waiting.empty() ? "" : "; axes that wait for it: " + waiting)));
    }
    const std::string start = "lockstep up --machine " + session.machine().file.string();
    if (const auto why = values_file_trouble(machine.name)) { return unreachable(none + "; " + *why); }
    const std::string received = session.received().names();
    if (received.empty()) { return unreachable(none + "; to start the machine: " + start); }
    return unreachable(fmt::format(
        "{}, but messages are received from its axes ({}); start lockstep-coordinator, or: lockstep down; {}", none,
        received, start));
}

std::expected<void, Failure> reach(Session& session, nanoseconds patience) {
    if (session.receive_until(patience, [&] { return session.is_reached(); })) { return {}; }
    return std::unexpected(silence(session));
}

/// Also waits for states as new as the machine's: an axis's state may come later than the report that a job is done.
std::expected<void, Failure> reach_axes(Session& session) {
    const nanoseconds deadline = monotonic_now() + kReachPatience;
    const Slot known = session.state() ? session.state()->state.stamp : Slot{};
    const ReceivedAxes& received = session.received();
    for (const MotorIndex i : motor_indices(motors_of(session))) {
        const auto is_known = [&] { return received.motor_present(i) && received.motor(i)->state.stamp >= known; };
        while (!is_known() && monotonic_now() <= deadline) { session.receive(50ms); }
        if (!received.motor_present(i)) {
            return std::unexpected(unreachable(
                fmt::format("no messages are received from {} of machine '{}'; start its lockstep-axis, or see its log",
                            received.kinematics().label(i), session.config().name)));
        }
    }
    return {};
}

void await_axes(Session& session) {
    const nanoseconds begin = monotonic_now();
    const auto may_come = [&](MotorIndex i) {
        const bool is_received = session.state() && session.state()->state.motors_present.contains(i);
        return !session.received().motor_present(i) &&
               monotonic_now() - begin < (is_received ? kReceivedPatience : kAbsentPatience);
    };
    const auto motors = std::views::iota(std::size_t{0}, motors_of(session));
    while (std::ranges::any_of(motors, [&](std::size_t m) { return may_come(MotorIndex{m}); })) {
        session.receive(50ms);
    }
}

void await_healths(Session& session, nanoseconds patience) {
    const nanoseconds deadline = monotonic_now() + patience;
    const ReceivedAxes& received = session.received();
    for (const MotorIndex i : motor_indices(motors_of(session))) {
        while (received.motor(i) && !received.health(i) && monotonic_now() < deadline) { session.receive(20ms); }
    }
}

std::expected<Reply, Failure> send_command(Session& session, const Command& command, const StopSignal* stop,
                                           nanoseconds patience) {
    for (CommandTracker tracker(command, patience);;) {
        if (is_requested(stop)) { tracker.withdraw(session.owner().running_time()); }
        const CommandStep step = session.follow(tracker);
        if (step == CommandStep::Answered) { return *tracker.reply(); }
        if (step == CommandStep::GaveUp) { return std::unexpected(silence(session)); }
        session.receive(20ms);
    }
}

void use_lease(Session& session, const LeaseUse& use) {
    session.lease().use(use, session.owner().running_time());
    session.keep_lease();
}

std::expected<Reply, Failure> take_lease(Session& session, bool takes_over, const StopSignal* stop) {
    use_lease(session, {.wants = true, .takes_over = takes_over});
    const LeaseKeeper& lease = session.lease();
    while (lease.state() == LeaseKeeper::State::Asked) {
        if (is_requested(stop)) { return std::unexpected(interrupted()); }
        session.receive(20ms);
    }
    if (lease.state() == LeaseKeeper::State::Unanswered) { return std::unexpected(silence(session)); }
    return *lease.answer();
}

void give_lease(Session& session, nanoseconds patience) {
    LeaseKeeper& lease = session.lease();
    const bool is_used = lease.is_held() || lease.state() == LeaseKeeper::State::Asked;
    lease.give();
    session.keep_lease();
    if (is_used) {
        (void)session.receive_until(patience, [&] { return lease.answer().has_value(); });
    }
}

std::expected<std::uint64_t, Failure> send_program(Session& session, const Program& program, const StopSignal* stop,
                                                   const std::optional<gcode::ProgramValues>& values) {
    std::size_t next = 0;
    const auto feed = [&](ProgramSender& sender) {
        for (std::size_t n = sender.free_blocks(); n > 0 && next < program.blocks.size(); --n) {
            sender.append(program.blocks[next++]);
        }
        if (next == program.blocks.size()) { sender.end(); }
    };
    auto id = stream_program(session, program.head(), values, feed, stop);
    if (!id) { return id; }
    const auto taken = await_parts(
        session, [&] { return session.upload().sender()->is_done(); }, stop);
    session.upload().end_feed();
    if (!taken) { return std::unexpected(taken.error()); }
    return id;
}

std::expected<std::uint64_t, Failure> stream_program(Session& session, const ProgramHead& head,
                                                     const std::optional<gcode::ProgramValues>& values,
                                                     ProgramUpload::Feed feed, const StopSignal* stop) {
    const ProgramSender& sender = session.upload().open(head, values, std::move(feed));
    const auto begun = await_parts(
        session, [&] { return sender.parts_taken() > 0; }, stop);
    if (!begun) { return std::unexpected(begun.error()); }
    return sender.program();
}

std::expected<RevisedValues, Failure> await_values(Session& session) {
    if (!session.receive_until(CommandTracker::kPatience, [&] { return session.values().has_any(); })) {
        return std::unexpected(silence(session));
    }
    auto values = session.values().read();
    if (!values) { return std::unexpected(failed("the coordinator's offsets and tools: " + values.error())); }
    return *std::move(values);
}

std::expected<void, Failure> await_kept(Session& session, std::uint64_t revision) {
    if (session.receive_until(kDiskPatience, [&] { return session.values().is_kept(revision); })) { return {}; }
    return std::unexpected(
        failed("the coordinator has not reported that the offsets and tools are on its disk; they may be lost "
               "when the coordinator ends; its log names the reason"));
}

}  // namespace lockstep
