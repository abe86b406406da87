// lockstep-grbl: the command line, and the loop between a sender and the machine.
#include <csignal>
#include <iostream>

#include <CLI/CLI.hpp>

#include "clients/grbl/channel.hpp"
#include "clients/grbl/machine_link.hpp"
#include "clients/supervisor/machine_choice.hpp"
#include "clients/text/output.hpp"
#include "services/network/host_name.hpp"
#include "services/runtime/stop_signal.hpp"

namespace {

using namespace lockstep;
using namespace std::chrono_literals;

struct Options {
    std::string machine_file;
    std::string address = "127.0.0.1";
    std::uint16_t port = 2301;
    std::string terminal;
    bool take = false;
};

/// `place`: the sender's address, or the terminal.
LeaseHolder writer_at(const std::string& place) { return {.name = "the grbl sender at " + place, .host = host_name()}; }

/// The machine was brought up again with another configuration, and its file describes it.
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

/// One sender at a time: it is served until it leaves, a signal comes, or the machine is another.
void serve(const Descriptor& sender, const Descriptor& listener, const ChosenMachine& machine, Session& session,
           const Options& options, const StopSignal& stop) {
    grbl::SettingsStore settings(machine);
    grbl::MachineLink link(session, settings, options.take);
    grbl::Grbl protocol(session.config(), LOCKSTEP_VERSION);
    protocol.see_next(settings.next());
    Renewal renewal(options.machine_file);
    link.pass(50ms, protocol);
    protocol.greet();
    while (!stop.requested()) {
        const auto bytes = read_from(sender, 2ms);
        if (!bytes) { break; }
        protocol.receive(*bytes);
        carry_out(link, protocol);
        link.pass(2ms, protocol);
        if (!write_to(sender, protocol.take_output()) || renewal.is_due(session)) { break; }
        if (const auto second = grbl::accept_from(listener)) {
            (void)write_to(*second, "[MSG:another sender is connected]\r\n");
        }
    }
    link.release();
}

/// Until a signal comes, or the machine is another.
void serve_all(const Descriptor& listener, const std::optional<grbl::Terminal>& terminal, const ChosenMachine& machine,
               Session& session, const Options& options, const StopSignal& stop) {
    Renewal renewal(options.machine_file);
    while (!stop.requested() && !renewal.is_due(session)) {
        if (const auto sender = grbl::accept_from(listener)) {
            session.write_as(writer_at(grbl::peer_of(*sender)));
            serve(*sender, listener, machine, session, options, stop);
        }
        if (terminal && terminal->is_used()) {
            session.write_as(writer_at(options.terminal));
            serve(terminal->descriptor(), listener, machine, session, options, stop);
        }
        session.receive(20ms);
    }
}

int run(const Options& options) {
    Output output(false);
    auto machine = choose_machine(options.machine_file);
    if (!machine) { return output.fail(machine.error()); }
    const auto listener = grbl::listen_at(options.address, options.port);
    if (!listener) { return output.fail(failed(listener.error())); }
    std::optional<grbl::Terminal> terminal;
    if (!options.terminal.empty()) {
        auto opened = grbl::Terminal::open(options.terminal);
        if (!opened) { return output.fail(failed(opened.error())); }
        terminal.emplace(std::move(*opened));
    }
    std::signal(SIGPIPE, SIG_IGN);
    const StopSignal stop;
    while (!stop.requested()) {
        auto session = Session::open(*machine, Purpose::Command);
        if (!session) { return output.fail(session.error()); }
        output.print("machine '" + machine->config.name + "' takes grbl's protocol at " + options.address + ", port " +
                     std::to_string(options.port) + (terminal ? ", and at " + options.terminal : ""));
        std::cout << std::flush;
        serve_all(*listener, terminal, *machine, *session, options, stop);
        machine = choose_machine(options.machine_file);
        if (!machine) { return output.fail(machine.error()); }
    }
    return kExitDone;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{
        "Lets a sender of grbl 1.1's protocol use a machine, over TCP or a pseudo-terminal, one sender at a time, "
        "until "
        "SIGTERM or SIGINT. When the sender disconnects, its jog brakes, and the lines that the machine has begun with "
        "are run."};
    Options options;
    app.add_option("--machine", options.machine_file,
                   "the machine's configuration file; else $LOCKSTEP_MACHINE, else the machine that is up on this "
                   "host, else /etc/lockstep/machine.textproto");
    app.add_option("--address", options.address,
                   "where to listen. There is no password: every sender that reaches this address can move the machine")
        ->capture_default_str();
    app.add_option("--port", options.port, "the TCP port")->capture_default_str();
    app.add_option("--pty", options.terminal, "also make a pseudo-terminal, and this symbolic link to it");
    app.add_flag(
        "--take", options.take,
        "a sender's lines, jogs and homing take the machine over from another writer; without it they are refused "
        "while there is one. lockstep status names the writer");
    app.footer(
        "Examples:\n  lockstep-grbl\n  lockstep-grbl --machine mill.textproto --port 2302 --pty /tmp/grbl\n"
        "Exit codes: 0 ended as asked, 1 failed, 2 wrong usage or configuration, 3 machine not reachable");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) { return app.exit(error) == 0 ? kExitDone : kExitBadInput; }
    return run(options);
}
