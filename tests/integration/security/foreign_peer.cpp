// A foreign peer that tries to move the machine, on its network and with the given keys:
//   integration_security_foreign_peer DOMAIN MACHINE PARTITION KEYS MEMBER [READERS]
// PARTITION: that of an axis by its number, or -. KEYS: a directory, or - for none; MEMBER: the owner of the keys.
// READERS: for a proper member, the number of readers that it must match; its tries count from then on.
//   integration_security_foreign_peer DOMAIN MACHINE protocol NUMBER -     a process of the machine, of another version
// Tries for a while to write every topic that moves something, and to read; prints the results, a line each.
#include <chrono>
#include <iostream>
#include <memory>
#include <string>
#include <thread>

#include "services/security/key_directory.hpp"
#include "services/wire/bus/bus.hpp"
#include "services/wire/dds/dds_log.hpp"
#include "services/wire/dds/protocol_version.hpp"

namespace lockstep {
namespace {

using namespace std::chrono_literals;

constexpr int kTries = 150;
constexpr int kPatience = 1000;  // further tries of a peer that must be matched: a busy host needs time
constexpr auto kBetween = 20ms;

/// Writes one message repeatedly.
template <typename T>
class RepeatedMessage {
public:
    RepeatedMessage(Participant& participant, T message) : writer_(participant), message_(std::move(message)) {}
    std::uint32_t write() {
        (void)writer_.write(message_);
        return writer_.matched();
    }

private:
    Writer<T> writer_;
    T message_;
};

Command home() { return {.client = 7, .sequence = 1, .kind = CommandKind::Home}; }

Frame sudden_frame() {
    Frame frame{.term = {~std::uint64_t{0} >> 2, 1}, .epoch = 1, .number = 1, .ticks = {230'000}, .last = true};
    frame.axes.resize(2);
    for (AxisTrack& axis : frame.axes) { (void)axis.body.push_back({{230'000}, {std::int64_t{1} << 50}, {0}}); }
    return frame;
}

AxisCommand own_move() {
    return {.term = {~std::uint64_t{0} >> 2, 1}, .sequence = 1, .kind = AxisCommandKind::MoveOwn, .target_steps = 8000};
}

/// A state of axis 0, with a fault that it does not have.
AxisState false_state() {
    return {.identity = 1, .axis = 0, .stamp = 1, .phase = AxisPhase::Fault, .fault = FaultCode::LimitHit};
}

struct Outcome {
    std::uint32_t matched = 0;  // the maximum of matched readers
    std::size_t received = 0;   // states
};

Outcome try_all(Participant& participant, std::uint32_t readers) {
    RepeatedMessage<Command> commands(participant, home());
    RepeatedMessage<Frame> frames(participant, sudden_frame());
    RepeatedMessage<AxisCommand> orders(participant, own_move());
    RepeatedMessage<AxisState> states(participant, false_state());
    Reader<AxisState> axes(participant);
    Reader<MachineState> machine(participant);
    Outcome outcome;
    int left = participant.failure() ? kTries / 4 : kTries;  // a peer that is refused at once needs few tries
    int patience = readers > 0 ? kPatience : 0;
    while (left > 0) {
        const bool is_in = outcome.matched >= readers && outcome.received > 0;
        --(is_in || patience == 0 ? left : patience);
        outcome.matched =
            std::max(outcome.matched, commands.write() + frames.write() + orders.write() + states.write());
        outcome.received += axes.take([](AxisState&&) {}) + machine.take([](MachineState&&) {});
        std::this_thread::sleep_for(kBetween);
    }
    return outcome;
}

/// Joins with another protocol number, until it is killed.
int run_another_protocol(const std::vector<std::string>& words) {
    const dds_domainid_t domain = static_cast<dds_domainid_t>(std::stoul(words[0]));
    const auto profile = dds_profile({.domain = domain});
    if (!profile || dds_create_domain(domain, profile->c_str()) < 0) { return 1; }
    const std::unique_ptr<dds_qos_t, decltype(&dds_delete_qos)> qos(dds_create_qos(), &dds_delete_qos);
    announce_version(*qos, std::stoi(words[3]), words[1]);
    if (dds_create_participant(domain, qos.get(), nullptr) < 0) { return 1; }
    for (;;) { std::this_thread::sleep_for(1s); }
}

int try_to_interfere(const std::vector<std::string>& words) {
    forward_dds_log([](const std::string& text) { std::cout << "dds: " << text << std::endl; });
    const NetworkConfig network{.domain = static_cast<std::uint32_t>(std::stoul(words[0]))};
    Membership membership;
    if (words[2] != "-") { membership.axis = static_cast<std::uint32_t>(std::stoul(words[2])); }
    if (words[3] != "-") { membership.credentials = credentials_in(words[3], {.name = words[4]}); }
    auto participant = Participant::open(network, words[1], membership);
    if (!participant) {
        std::cout << "refused: " << participant.error() << std::endl;
        return 0;
    }
    const std::uint32_t readers = words.size() == 6 ? static_cast<std::uint32_t>(std::stoul(words[5])) : 0;
    const Outcome outcome = try_all(*participant, readers);
    if (participant->failure()) { std::cout << "refused: " << *participant->failure() << std::endl; }
    std::cout << "matched " << outcome.matched << "\nreceived " << outcome.received << std::endl;
    return 0;
}

}  // namespace
}  // namespace lockstep

int main(int argc, char** argv) {
    const std::vector<std::string> words(argv + 1, argv + argc);
    if (words.size() < 5 || words.size() > 6) { return 2; }
    return words[2] == "protocol" ? lockstep::run_another_protocol(words) : lockstep::try_to_interfere(words);
}
