// lockstep-grbl: its command line, and the loop that connects a sender to the machine.
#include <fmt/format.h>

#include <csignal>
#include <iostream>

#include "clients/channel/listener.hpp"
#include "clients/grbl/channel.hpp"
#include "clients/grbl/lobby.hpp"
#include "clients/grbl/machine_link.hpp"
#include "clients/supervisor/machine_choice.hpp"
#include "clients/text/output.hpp"
#include "services/arguments/argument_parser.hpp"
#include "services/network/host_name.hpp"
#include "services/runtime/clock.hpp"
#include "services/runtime/stop_signal.hpp"

namespace {

using namespace lockstep;
using namespace std::chrono_literals;

constexpr auto kSilence = 30s;  // after it, an idle sender that sends nothing gives way to another

struct Options {
    std::string machine_file;
    std::string address = "127.0.0.1";
    std::uint16_t port = 2301;
    std::string terminal;
    bool take = false;
};

/// `place`: the sender's address, or the terminal.
LeaseHolder writer_at(const std::string& place) { return {.name = "the grbl sender at " + place, .host = host_name()}; }

/// Detects that the machine was brought up again with another configuration, and that the machine's file has it.
class Renewal {
public:
    explicit Renewal(std::string machine_file) : machine_file_(std::move(machine_file)) {}
    bool is_due(const Session& session) {
        if (!session.config_differs() || session.state()->state.config_hash == tried_) { return false; }
        tried_ = session.state()->state.config_hash;
        const auto machine = choose_machine(machine_file_);
        return machine && machine->hash == tried_;
    }

private:
    std::string machine_file_;
    std::uint64_t tried_ = 0;
};

/// An answer may lead to the next request.
void carry_out(grbl::MachineLink& link, grbl::Grbl& protocol) {
    for (auto requests = protocol.take_requests(); !requests.empty(); requests = protocol.take_requests()) {
        for (grbl::Request& request : requests) { link.carry_out(std::move(request), protocol); }
    }
}

/// The places at which senders connect.
struct Doors {
    grbl::Lobby lobby;
    std::optional<grbl::Terminal> terminal;

    bool has_next() { return lobby.has_speaker() || (terminal && terminal->is_used()); }
};

/// Call when a sender has left. Waits until the machine has run the lines that it has begun, and spindle and coolant
/// are switched off. Returns true if the next sender came before they were switched off.
bool see_off(grbl::MachineLink& link, grbl::Grbl& protocol, Doors& doors, const StopSignal& stop) {
    protocol.leave();
    link.leave();
    const auto begin = monotonic_now();
    const auto may_wait = [&] { return !stop.requested() || monotonic_now() - begin < 3s; };
    while (protocol.is_to_switch_off() || !link.is_idle()) {
        if (link.is_stuck() || doors.has_next() || !may_wait()) { break; }
        link.pass(5ms, protocol);
        carry_out(link, protocol);
        (void)protocol.take_output();
    }
    link.release();
    return protocol.is_to_switch_off() && doors.has_next();
}

/// Serves one sender until it leaves, a signal comes, or the machine's configuration changes. `is_to_switch_off`: the
/// previous sender left spindle or coolant on. Returns whether this sender did.
bool serve(const Descriptor& sender, bool is_greeted, Doors& doors, bool is_to_switch_off, const ChosenMachine& machine,
           Session& session, const Options& options, const StopSignal& stop) {
    grbl::SettingsStore settings(machine);
    grbl::MachineLink link(session, settings, options.take);
    grbl::Grbl protocol(session.config(), LOCKSTEP_VERSION);
    protocol.see_next(settings.next());
    if (is_to_switch_off) { protocol.switch_off_at_rest(); }
    Renewal renewal(options.machine_file);
    link.pass(50ms, protocol);
    is_greeted ? protocol.begin() : protocol.greet();
    auto heard = monotonic_now();
    while (!stop.requested()) {
        const auto bytes = read_from(sender, 2ms);
        if (!bytes) { break; }
        if (!bytes->empty()) { heard = monotonic_now(); }
        protocol.receive(*bytes);
        carry_out(link, protocol);
        link.pass(2ms, protocol);
        if (!write_to(sender, protocol.take_output()) || renewal.is_due(session)) { break; }
        if (monotonic_now() - heard < kSilence || !link.is_idle()) {
            doors.lobby.turn_away("[MSG:another sender is connected]\r\n");
        } else if (doors.lobby.has_speaker()) {
            (void)write_to(sender, "[MSG:another sender has connected while this one was silent]\r\n");
            break;
        }
    }
    return see_off(link, protocol, doors, stop);
}

/// Serves senders one after another until a signal comes or the machine's configuration changes.
void serve_all(Doors& doors, const ChosenMachine& machine, Session& session, const Options& options,
               const StopSignal& stop) {
    Renewal renewal(options.machine_file);
    bool is_to_switch_off = false;
    while (!stop.requested() && !renewal.is_due(session)) {
        if (const auto sender = doors.lobby.take_speaker()) {
            session.lease().write_as(writer_at(grbl::peer_of(*sender)));
            is_to_switch_off = serve(*sender, true, doors, is_to_switch_off, machine, session, options, stop);
        }
        if (doors.terminal && doors.terminal->is_used()) {
            session.lease().write_as(writer_at(options.terminal));
            is_to_switch_off =
                serve(doors.terminal->descriptor(), false, doors, is_to_switch_off, machine, session, options, stop);
        }
        session.receive(20ms);
    }
}

int run(const Options& options) {
    Output output(false);
    auto machine = choose_machine(options.machine_file);
    if (!machine) { return output.fail(machine.error()); }
    const auto listener = listen_at(options.address, options.port);
    if (!listener) { return output.fail(failed(listener.error())); }
    Doors doors{.lobby = grbl::Lobby(Descriptor(listener->socket)), .terminal = {}};
    if (!options.terminal.empty()) {
        auto opened = grbl::Terminal::open(options.terminal);
        if (!opened) { return output.fail(failed(opened.error())); }
        doors.terminal.emplace(std::move(*opened));
    }
    std::signal(SIGPIPE, SIG_IGN);
    const StopSignal stop;
    while (!stop.requested()) {
        auto session = Session::open(*machine, Purpose::Command);
        if (!session) { return output.fail(session.error()); }
        output.print(fmt::format("machine '{}' accepts grbl's protocol at {}, port {}{}", machine->config.name,
                                 options.address, options.port, doors.terminal ? ", and at " + options.terminal : ""));
        std::cout << std::flush;
        serve_all(doors, *machine, *session, options, stop);
        machine = choose_machine(options.machine_file);
        if (!machine) { return output.fail(machine.error()); }
    }
    return kExitDone;
}

}  // namespace

int main(int argc, char** argv) {
    ArgumentParser parser(
        "Lets a sender of grbl 1.1's protocol use a machine, over TCP or a pseudo-terminal, one sender at a time, "
        "until "
        "SIGTERM or SIGINT. When the sender disconnects, its jog brakes, the lines that have begun are run "
        "to their end, and then spindle and coolant are switched off.");
    Options options;
    parser.add_option("--machine", options.machine_file, kMachineHelp);
    parser
        .add_option(
            "--address", options.address,
            "where to listen. There is no password: every sender that reaches this address can move the machine")
        .with_default();
    parser.add_option("--port", options.port, "the TCP port").with_default();
    parser.add_option("--pty", options.terminal, "also create a pseudo-terminal, and this symbolic link to it");
    parser.add_flag(
        "--take", options.take,
        "a sender's lines, jogs and homing take over the machine from another writer; without --take they are refused "
        "while there is another writer. lockstep status names the writer");
    parser.footer(
        "Examples:\n  lockstep-grbl\n  lockstep-grbl --machine mill.textproto --port 2311 --pty /tmp/grbl\n"
        "Exit codes: 0 ended as asked, 1 failed, 2 wrong usage or configuration, 3 machine not reachable");
    parser.action([&] { return run(options); });
    return parser.run(argc, argv);
}
