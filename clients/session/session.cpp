#include "clients/session/session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <random>
#include <ranges>

#include "core/kinematics/axis_states.hpp"
#include "core/kinematics/motors.hpp"
#include "core/protocol/rules.hpp"
#include "services/documents/placement.hpp"
#include "services/documents/program_document.hpp"
#include "services/documents/values/values_trouble.hpp"
#include "services/network/host_name.hpp"
#include "services/runtime/clock.hpp"
#include "services/security/admission.hpp"
#include "services/wire/dds/dds_log.hpp"

namespace lockstep {
namespace {

using namespace std::chrono_literals;
using std::chrono::nanoseconds;

constexpr nanoseconds kReceivedPatience = 5s;   // for an axis that the coordinator receives: this process will, too
constexpr nanoseconds kAbsentPatience = 500ms;  // for an axis that the coordinator does not receive
constexpr std::size_t kRepliesKept = 64;        // that were not read
constexpr nanoseconds kDiskPatience = 15s;      // a disk may hang for seconds

static_assert(kPartBytes + 4096 <= lockstep_wire_MAX_CHUNK_BYTES);  // 4096: the last block, or the values

template <typename Bus>
std::expected<std::variant<ViewerBus, ClientBus>, std::string> open_as(const MachineConfig& machine,
                                                                       const Membership& membership) {
    auto bus = open_bus<Bus>(machine.network, machine.name, membership);
    if (!bus) { return std::unexpected(bus.error()); }
    return std::move(*bus);
}

/// After this time without a state, an axis or a standby counts as absent.
nanoseconds longest_silence(const MachineConfig& machine) {
    const ProtocolTiming& timing = machine.timing;
    return std::max<nanoseconds>(1s, std::chrono::microseconds{rules::silence_slots(timing) * timing.slot_us});
}

Identity new_identity() {
    std::random_device source;
    return Identity{source()} << 32 | source();
}

}  // namespace

Session::Session(const ChosenMachine& machine, Bus bus)
    : machine_(machine),
      bus_(std::move(bus)),
      client_(new_identity()),
      lease_(client_, {.name = "client", .host = host_name()}),
      owner_(longest_silence(machine.config) + 2s),
      kinematics_(machine.config),
      motors_(kinematics_.motors().size()),
      axes_(kinematics_.axes()),
      healths_(motors_.size()) {
    for (std::size_t i = 0; i < axes_.size(); ++i) { needed_.push_back(motors_needed_for(i, kinematics_)); }
}

std::expected<Session, Failure> Session::join(const ChosenMachine& machine, Purpose purpose) {
    forward_dds_log([](const std::string&) {});  // silent() quotes the log; only the verb writes to the terminal
    const bool looks = purpose == Purpose::Look;
    auto admission = admit(machine.config, looks ? viewer_member() : client_member());
    if (!admission) { return std::unexpected(failed(admission.error())); }
    auto bus = looks ? open_as<ViewerBus>(machine.config, admission->membership)
                     : open_as<ClientBus>(machine.config, admission->membership);
    if (!bus) { return std::unexpected(unreachable(bus.error())); }
    return Session(machine, std::move(*bus));
}

std::expected<Session, Failure> Session::open(const ChosenMachine& machine, Purpose purpose) {
    auto session = join(machine, purpose);
    if (!session) { return session; }
    if (auto reached = session->reach(); !reached) { return std::unexpected(reached.error()); }
    return session;
}

/// A commanding client also waits until its readers and writers are matched.
bool Session::is_reached() {
    if (!state()) { return false; }
    const ClientBus* bus = std::get_if<ClientBus>(&bus_);
    return bus == nullptr || (bus->commands.matched() > 0 && bus->chunks.matched() > 0 && bus->replies.matched() > 0);
}

std::expected<void, Failure> Session::reach(nanoseconds patience) {
    if (!receive_until(patience, [this] { return is_reached(); })) { return std::unexpected(silent()); }
    return {};
}

/// Also waits for states as new as the machine's: an axis's state may come later than the report that a job is done.
std::expected<void, Failure> Session::reach_axes() {
    const nanoseconds deadline = monotonic_now() + kReachPatience;
    const Slot known = state() ? state()->state.stamp : Slot{};
    for (std::size_t i = 0; i < motors_.size(); ++i) {
        const auto is_known = [&] { return motor_present(i) && motors_[i]->state.stamp >= known; };
        while (!is_known() && monotonic_now() <= deadline) { receive(50ms); }
        if (!motor_present(i)) {
            return std::unexpected(unreachable(
                fmt::format("no messages are received from {} of machine '{}'; start its lockstep-axis, or see its log",
                            kinematics_.label(i), config().name)));
        }
    }
    return {};
}

void Session::await_axes() {
    const nanoseconds begin = monotonic_now();
    const auto may_come = [&](std::size_t i) {
        const bool is_received = state() && has_axis(state()->state.axes_present, i);
        return !motor_present(i) && monotonic_now() - begin < (is_received ? kReceivedPatience : kAbsentPatience);
    };
    while (std::ranges::any_of(std::views::iota(std::size_t{0}, motors_.size()), may_come)) { receive(50ms); }
}

void Session::await_healths(nanoseconds patience) {
    const nanoseconds deadline = monotonic_now() + patience;
    for (std::size_t i = 0; i < motors_.size(); ++i) {
        while (motors_[i] && !healths_[i] && monotonic_now() < deadline) { receive(20ms); }
    }
}

std::expected<void, Failure> Session::follow_events(nanoseconds patience) {
    if (!events_) { events_.emplace(viewer_bus().participant); }
    const auto is_matched = [this] {
        return events_->matched() > 0 && events_->matched() >= viewer_bus().machine.matched();
    };
    if (receive_until(patience, is_matched)) { return {}; }
    return std::unexpected(failed("events of programs are not received from every coordinator"));
}

std::vector<PublishedEvent> Session::take_events() {
    std::vector<PublishedEvent> events;
    if (events_) {
        events_->take([&](PublishedEvent&& event) { events.push_back(event); });
    }
    return events;
}

void Session::receive(nanoseconds at_most) {
    keep_lease();
    feed_and_send();
    const nanoseconds begin = monotonic_now();
    (void)viewer_bus().arrivals->wait_for(at_most);
    owner_.look(begin, monotonic_now(), at_most);
    take_messages();
}

void Session::take_messages() {
    const nanoseconds now = monotonic_now();
    viewer_bus().machine.take([&](MachineState&& state) {
        if (state.phase == MachinePhase::Standby) {
            standby_ = {state, now};
            return;
        }
        owner_.take(state, now);
    });
    viewer_bus().states.take([&](AxisState&& state) { take(std::move(state), now); });
    viewer_bus().healths.take([&](AxisHealth&& health) {
        if (health.axis < healths_.size()) { healths_[health.axis] = health; }
    });
    viewer_bus().values.take([&](MachineValues&& values) {
        const bool is_older = values_ && values.term < values_->term;
        if (is_older) { return; }
        values_ = std::move(values);
        unsaved_since_ = values_->on_disk ? std::nullopt : std::optional(unsaved_since_.value_or(now));
    });
    if (std::holds_alternative<ClientBus>(bus_)) { take_replies(); }
}

void Session::take_replies() {
    client_bus().replies.take([&](Reply&& reply) {
        if (reply.client != client_ || lease_.take_answer(reply)) { return; }
        const bool is_of_program = sender_ && sender_->take_answer(reply);
        if (is_of_program) { answered_ = running_time(); }
        if (!is_of_program) { replies_[reply.sequence] = std::move(reply); }
        if (replies_.size() > kRepliesKept) { replies_.erase(replies_.begin()); }
    });
}

bool Session::is_recent(const std::optional<Received<AxisState>>& state) const {
    return state && monotonic_now() - state->time <= longest_silence(config());
}

std::vector<const AxisState*> Session::motor_states() const {
    std::vector<const AxisState*> states;
    for (const auto& motor : motors_) { states.push_back(motor ? &motor->state : nullptr); }
    return states;
}

double Session::axis_speed(std::size_t i) const { return axis_speed_of(i, kinematics_, motor_states()); }

/// An axis is as old as the oldest state that its place needs.
void Session::take(AxisState&& state, nanoseconds now) {
    if (state.axis >= motors_.size()) { return; }
    const std::size_t motor = state.axis;
    motors_[motor] = {std::move(state), now};
    const std::vector<const AxisState*> states = motor_states();
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        if (!has_axis(needed_[i], motor)) { continue; }
        auto axis = axis_state_of(i, kinematics_, states);
        if (!axis) { continue; }
        nanoseconds oldest = now;
        for (std::size_t m = 0; m < motors_.size(); ++m) {
            if (has_axis(needed_[i], m)) { oldest = std::min(oldest, motors_[m]->time); }
        }
        axes_[i] = {*std::move(axis), oldest};
    }
}

/// The owner may have been the standby before; then its old state does not count.
bool Session::has_standby() const {
    const bool is_owner = standby_ && state() && standby_->state.term.coordinator == state()->state.term.coordinator;
    return standby_ && !is_owner && monotonic_now() - standby_->time <= longest_silence(config());
}

std::vector<PresentProcess> Session::present() const {
    return std::visit([](const ViewerBus& bus) { return present_processes(bus.participant); }, bus_);
}

std::string Session::place_text() const {
    return fmt::format("machine '{}' answers on interface {}, domain {}", config().name, config().network.interface,
                       config().network.domain);
}

std::string Session::received_axes() const {
    std::string names;
    for (std::size_t i = 0; i < motors_.size(); ++i) {
        if (motor_present(i)) { names += (names.empty() ? "" : ", ") + motor_name(config(), i); }
    }
    return names;
}

std::string Session::present_axes() const {
    std::string names;
    for (const PresentProcess& process : present()) {
        if (!process.axis || *process.axis >= motors_.size()) { continue; }
        names += (names.empty() ? "" : ", ") + motor_name(config(), *process.axis) + " on " + process.host;
    }
    return names;
}

Failure Session::silent() const {
    const std::string refused = last_dds_message().empty() ? "" : " (DDS reports: " + last_dds_message() + ")";
    const std::string none = "no coordinator of " + place_text() + refused;
    if (const std::string& host = config().coordinator_host; !host.empty() && !same_host(host, host_name())) {
        const std::string waiting = present_axes();
        return unreachable(fmt::format("{}; it runs on {}; on that host: lockstep up{}", none, host,
                                       (waiting.empty() ? "" : "; axes that wait for it: " + waiting)));
    }
    const std::string start = "lockstep up --machine " + machine_.file.string();
    if (const auto why = values_file_trouble(config().name)) { return unreachable(none + "; " + *why); }
    const std::string received = received_axes();
    if (received.empty()) { return unreachable(none + "; to start the machine: " + start); }
    return unreachable(fmt::format(
        "{}, but messages are received from its axes ({}); start lockstep-coordinator, or: lockstep down; {}", none,
        received, start));
}

CommandStep Session::follow(CommandTracker& tracker) {
    if (!tracker.is_numbered()) { tracker.number(client_, ++sequence_, lease_.writer().id); }
    const Command& command = tracker.command();
    const auto reply = replies_.find(command.sequence);
    const CommandStep step = tracker.pass(reply == replies_.end() ? nullptr : &reply->second, sight(), running_time());
    if (reply != replies_.end()) { replies_.erase(reply); }
    if (step == CommandStep::Send) { write(command); }
    return step;
}

std::expected<Reply, Failure> Session::command(const Command& command, const StopSignal* stop, nanoseconds patience) {
    for (CommandTracker tracker(command, patience);;) {
        if (stop != nullptr && stop->requested()) { tracker.withdraw(running_time()); }
        const CommandStep step = follow(tracker);
        if (step == CommandStep::Answered) { return *tracker.reply(); }
        if (step == CommandStep::GaveUp) { return std::unexpected(silent()); }
        receive(20ms);
    }
}

void Session::use_lease(const LeaseUse& use) {
    lease_.use(use, running_time());
    keep_lease();
}

std::expected<Reply, Failure> Session::take_lease(bool takes_over, const StopSignal* stop) {
    use_lease({.wants = true, .takes_over = takes_over});
    while (lease_.state() == LeaseKeeper::State::Asked) {
        if (stop != nullptr && stop->requested()) { return std::unexpected(failed("interrupted; nothing was begun")); }
        receive(20ms);
    }
    if (lease_.state() == LeaseKeeper::State::Unanswered) { return std::unexpected(silent()); }
    return *lease_.answer();
}

void Session::keep_lease() {
    while (const auto command = lease_.due(sight(), running_time())) { write(*command); }
}

void Session::give_lease(nanoseconds patience) {
    const bool is_used = lease_.is_held() || lease_.state() == LeaseKeeper::State::Asked;
    lease_.give();
    keep_lease();
    if (is_used) {
        (void)receive_until(patience, [this] { return lease_.answer().has_value(); });
    }
}

std::expected<std::uint64_t, Failure> Session::send(const Program& program, const StopSignal* stop,
                                                    const std::optional<gcode::ProgramValues>& values) {
    std::size_t next = 0;
    const auto feed = [&](ProgramSender& sender) {
        for (std::size_t n = sender.free_blocks(); n > 0 && next < program.blocks.size(); --n) {
            sender.append(program.blocks[next++]);
        }
        if (next == program.blocks.size()) { sender.end(); }
    };
    auto id = stream(program.head(), values, feed, stop);
    if (!id) { return id; }
    const auto taken = await_parts([this] { return sender_->is_done(); }, stop);
    feed_ = {};
    if (!taken) { return std::unexpected(taken.error()); }
    return id;
}

std::expected<std::uint64_t, Failure> Session::stream(const ProgramHead& head,
                                                      const std::optional<gcode::ProgramValues>& values, Feed feed,
                                                      const StopSignal* stop) {
    const std::uint64_t id = begin_stream(head, values, std::move(feed));
    const auto begun = await_parts([this] { return sender_->parts_taken() > 0; }, stop);
    if (!begun) { return std::unexpected(begun.error()); }
    return id;
}

std::uint64_t Session::begin_stream(const ProgramHead& head, const std::optional<gcode::ProgramValues>& values,
                                    Feed feed) {
    const std::uint64_t id = open_stream(head, values).program();
    feed_ = std::move(feed);
    return id;
}

ProgramSender& Session::open_stream(const ProgramHead& head, const std::optional<gcode::ProgramValues>& values) {
    const std::uint64_t id = new_identity() | 1;  // never 0, which means none
    feed_ = {};
    return sender_.emplace(client_, ++programs_, id, head, values);
}

void Session::close_stream() {
    feed_ = {};
    sender_.reset();
}

/// Waits until `done` returns true.
std::expected<void, Failure> Session::await_parts(const std::function<bool()>& done, const StopSignal* stop) {
    answered_ = running_time();
    while (!done()) {
        if (stop != nullptr && stop->requested()) { return std::unexpected(failed("interrupted; nothing was begun")); }
        if (running_time() - *answered_ > CommandTracker::kPlanPatience) { return std::unexpected(silent()); }
        receive(50ms);
        if (const auto& refusal = sender_->refusal()) { return std::unexpected(failed(refusal->text)); }
    }
    return {};
}

void Session::feed_and_send() {
    if (!sender_) { return; }
    if (feed_ && !sender_->is_ended() && sender_->free_blocks() > 0) { feed_(*sender_); }
    for (ProgramChunk& chunk : sender_->due(monotonic_now())) {
        chunk.writer = lease_.writer().id;
        (void)client_bus().chunks.write(chunk);
    }
}

void Session::await_values(nanoseconds patience) {
    (void)receive_until(patience, [this] { return values_.has_value(); });
}

std::expected<RevisedValues, Failure> Session::values() {
    if (!receive_until(CommandTracker::kPatience, [this] { return values_.has_value(); })) {
        return std::unexpected(silent());
    }
    auto values = values_from_bytes(values_->bytes);
    if (!values) { return std::unexpected(failed("the coordinator's offsets and tools: " + values.error())); }
    return *std::move(values);
}

std::optional<RevisedValues> Session::newest_values() const {
    if (!values_) { return std::nullopt; }
    auto values = values_from_bytes(values_->bytes);
    return values ? std::optional(*std::move(values)) : std::nullopt;
}

std::expected<void, Failure> Session::await_kept(std::uint64_t revision) {
    if (receive_until(kDiskPatience, [&] { return is_kept(revision); })) { return {}; }
    return std::unexpected(
        failed("the coordinator has not reported that the offsets and tools are on its disk; they may be lost "
               "when the coordinator ends; its log names the reason"));
}

}  // namespace lockstep
