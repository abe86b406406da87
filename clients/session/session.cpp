#include "clients/session/session.hpp"

#include "clients/session/follow/random_identity.hpp"
#include "clients/session/waits.hpp"
#include "services/documents/program_document.hpp"
#include "services/network/host_name.hpp"
#include "services/runtime/clock.hpp"
#include "services/security/admission.hpp"
#include "services/wire/dds/dds_log.hpp"

namespace lockstep {
namespace {

using namespace std::chrono_literals;
using std::chrono::nanoseconds;

constexpr std::size_t kRepliesKept = 64;  // that were not read

static_assert(kPartBytes + 4096 <= lockstep_wire_MAX_CHUNK_BYTES);  // 4096: the last block, or the values

template <typename Bus>
std::expected<std::variant<ViewerBus, ClientBus>, std::string> open_as(const MachineSetup& machine,
                                                                       const Membership& membership) {
    auto bus = open_bus<Bus>(machine.network, machine.name, membership);
    if (!bus) { return std::unexpected(bus.error()); }
    return std::move(*bus);
}

}  // namespace

Session::Session(const ChosenMachine& machine, Bus bus)
    : machine_(machine),
      bus_(std::move(bus)),
      client_(random_identity()),
      lease_(client_, {.name = "client", .host = host_name()}),
      upload_(client_),
      owner_(longest_silence(machine.config) + 2s),
      received_(machine.config) {}

std::expected<Session, Failure> Session::join(const ChosenMachine& machine, Purpose purpose) {
    forward_dds_log([](const std::string&) {});  // silence() quotes the log; only the verb writes to the terminal
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
    if (auto reached = reach(*session); !reached) { return std::unexpected(reached.error()); }
    return session;
}

bool Session::is_reached() const {
    if (!state()) { return false; }
    const ClientBus* bus = std::get_if<ClientBus>(&bus_);
    return bus == nullptr || (bus->commands.matched() > 0 && bus->chunks.matched() > 0 && bus->replies.matched() > 0);
}

bool Session::follow_events() {
    if (!events_) { events_.emplace(viewer_bus().participant); }
    return events_->matched() > 0 && events_->matched() >= viewer_bus().machine.matched();
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
    send_program();
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
    viewer_bus().states.take([&](AxisState&& state) { received_.take(std::move(state), now); });
    viewer_bus().healths.take([&](AxisHealth&& health) { received_.take(std::move(health)); });
    viewer_bus().values.take([&](MachineValues&& values) { values_.take(std::move(values), now); });
    if (std::holds_alternative<ClientBus>(bus_)) { take_replies(); }
}

void Session::take_replies() {
    client_bus().replies.take([&](Reply&& reply) {
        if (reply.client != client_ || lease_.take_answer(reply)) { return; }
        if (upload_.take_answer(reply, owner_.running_time())) { return; }
        replies_[reply.sequence] = std::move(reply);
        if (replies_.size() > kRepliesKept) { replies_.erase(replies_.begin()); }
    });
}

/// The owner may have been the standby before; then its old state does not count.
bool Session::has_standby() const {
    const bool is_owner = standby_ && state() && standby_->state.term.coordinator == state()->state.term.coordinator;
    return standby_ && !is_owner && monotonic_now() - standby_->time <= longest_silence(config());
}

std::vector<PresentProcess> Session::present() const {
    return std::visit([](const ViewerBus& bus) { return present_processes(bus.participant); }, bus_);
}

CommandStep Session::follow(CommandTracker& tracker) {
    if (!tracker.is_numbered()) { tracker.number(client_, ++sequence_, lease_.writer().id); }
    const Command& command = tracker.command();
    const auto reply = replies_.find(command.sequence);
    const CommandStep step =
        tracker.pass(reply == replies_.end() ? nullptr : &reply->second, owner_.sight(), owner_.running_time());
    if (reply != replies_.end()) { replies_.erase(reply); }
    if (step == CommandStep::Send) { (void)client_bus().commands.write(command); }
    return step;
}

void Session::keep_lease() {
    while (const auto command = lease_.due(owner_.sight(), owner_.running_time())) {
        (void)client_bus().commands.write(*command);
    }
}

void Session::send_program() {
    for (ProgramChunk& chunk : upload_.due(monotonic_now())) {
        chunk.writer = lease_.writer().id;
        (void)client_bus().chunks.write(chunk);
    }
}

}  // namespace lockstep
