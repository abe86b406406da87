// lockstep doctor
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "clients/doctor/probes.hpp"
#include "clients/lockstep/live/boards_report.hpp"
#include "clients/lockstep/live/keys_report.hpp"
#include "clients/lockstep/live/timing_report.hpp"
#include "clients/lockstep/live_options.hpp"
#include "clients/lockstep/verb.hpp"
#include "clients/session/session.hpp"
#include "clients/supervisor/machine_choice.hpp"
#include "clients/text/output.hpp"
#include "core/enumeration.hpp"
#include "core/kinematics/motors.hpp"
#include "idl/proto/report.pb.h"
#include "services/axis/device_window.hpp"
#include "services/axis/window_port.hpp"
#include "services/documents/placement.hpp"
#include "services/files/directories.hpp"
#include "services/network/host_name.hpp"
#include "services/network/multicast.hpp"
#include "services/runtime/clock.hpp"
#include "services/security/rights.hpp"
#include "services/wire/dds/peer_discovery.hpp"
#include "services/wire/shared/state_board.hpp"

namespace lockstep {
namespace {

using namespace std::chrono_literals;
using doctor::Finding;
using doctor::Findings;
using doctor::Rating;

constexpr auto kListening = 1500ms;

struct DoctorOptions : LiveOptions {
    double seconds = 3;
    bool timing = false;
};

/// The file of the axes' states, or the reason why it cannot be created; empty without network.one_host.
std::expected<std::string, std::string> shared_states(const MachineSetup& machine) {
    if (!machine.network.one_host) { return ""; }
    const auto board = StateBoardReader::open(shared_states_file(machine.name, machine.network.domain), std::nullopt);
    if (!board) { return std::unexpected(board.error()); }
    return board->path().string();
}

void examine_network(const MachineSetup& machine, Findings& findings) {
    const NetworkConfig& network = machine.network;
    const auto facts = doctor::look_at_interface(network.interface);
    findings.push_back(doctor::rate_interface(network, facts));
    const auto route = check_multicast(network);
    const auto received = route ? doctor::receives_own_message(network.lcm_url) : std::nullopt;
    findings.push_back(doctor::rate_route(network, route, received));
    const auto asked = doctor::buffer_asked(network.lcm_url);
    if (asked) { findings.push_back(doctor::rate_buffer(*asked, doctor::receive_buffer_given(*asked))); }
    findings.push_back(doctor::rate_states(machine, shared_states(machine)));
    if (network.peers.empty()) { return; }
    const std::int64_t needed = peer_send_buffer(network.peers.size());
    findings.push_back(doctor::rate_send_buffer(needed, doctor::send_buffer_given(needed)));
}

void examine_host(const MachineSetup& machine, double seconds, Output& output, Findings& findings) {
    const auto real_time = doctor::look_at_real_time();
    findings.push_back(doctor::rate_scheduler(machine.real_time, real_time));
    findings.push_back(doctor::rate_memory(machine.real_time, real_time));
    findings.push_back(doctor::rate_clock(machine.timing.time_source, doctor::look_at_clock()));
    findings.push_back(doctor::rate_stalls(machine.timing, watch_for_stalls(machine.timing.slot_us, seconds, output)));
}

std::expected<void, std::string> try_device(const MachineSetup& machine, const MotorConfig& motor) {
    const auto window = open_window(motor.device, machine);
    if (!window) { return std::unexpected(window.error()); }
    const auto driver = find_device(*window, machine, motor);
    return driver ? std::expected<void, std::string>{} : std::unexpected(driver.error());
}

void examine_board(const MachineSetup& machine, const BoardLinkConfig& board, Findings& findings) {
    const proto::BoardReport report = check_board(machine, board);
    std::vector<std::string> lacks;
    if (report.has_lack()) { lacks.push_back(report.lack()); }
    for (const proto::BoardMotorReport& motor : report.motors()) {
        if (motor.has_lack()) { lacks.push_back(fmt::format("its motor {}: {}", motor.number(), motor.lack())); }
    }
    findings.push_back(doctor::rate_board(board, lacks));
}

void examine_parts_here(const MachineSetup& machine, Findings& findings) {
    const Placement here = placed_on(machine, host_name());
    std::set<std::string> boards;  // with a link, that motors here use
    for (const MotorIndex i : here.axes) {
        const MotorConfig axis = motors_of(machine)[i];
        if (axis.device.kind == DeviceName::Kind::Linked) {
            boards.insert(axis.device.place);
        } else if (axis.device.kind != DeviceName::Kind::Simulated) {
            findings.push_back(doctor::rate_device(axis, try_device(machine, axis)));
        }
    }
    for (const BoardLinkConfig& board : machine.board_links) {
        if (boards.contains(board.name)) { examine_board(machine, board, findings); }
    }
    if (here.empty() || !machine.record.own_logs) { return; }
    const std::string directory =
        machine.record.directory.empty() ? record_directory(machine.name).string() : machine.record.directory;
    findings.push_back(doctor::rate_directory("own logs", directory, doctor::why_not_writable(directory)));
}

/// The keys of the parts on this host, and of other members with keys here.
void examine_keys(const MachineSetup& machine, Findings& findings) {
    if (!machine.security.enabled()) { return; }
    const Placement here = placed_on(machine, host_name());
    std::set<std::string> needed;
    if (here.coordinator) { needed.insert(coordinator_member().name); }
    for (const MotorIndex i : here.axes) { needed.insert(axis_member(machine, i).name); }
    const proto::KeysReport keys = keys_report(machine, machine.security.directory);
    for (const proto::MemberKeys& member : keys.members()) {
        if (!member.here() && !needed.contains(member.name())) { continue; }
        const auto& wrong = member.problems().empty() ? member.warnings() : member.problems();
        findings.push_back(doctor::rate_keys({.member = member.name(),
                                              .here = member.here(),
                                              .is_out = !member.problems().empty(),
                                              .trouble = wrong.empty() ? "" : wrong[0],
                                              .days_left = member.days_left()}));
    }
}

void examine_processes(const ChosenMachine& machine, Findings& findings) {
    auto session = Session::join(machine, Purpose::Look);
    if (!session) {
        findings.push_back({Rating::Bad, "DDS", session.error().errors.front().message, "see: interface"});
        return;
    }
    for (const auto until = monotonic_now() + kListening; monotonic_now() < until;) { session->receive(100ms); }
    const std::vector<PresentProcess> present = session->present();
    const auto add_process = [&](const std::string& name, std::optional<MotorIndex> part, bool received,
                                 std::uint64_t hash) {
        doctor::ProcessFacts facts{name, received, hash, {}, !part};
        for (const PresentProcess& process : present) {
            if (process.motor == part && !process.host.empty()) { facts.hosts.push_back(process.host); }
        }
        findings.push_back(doctor::rate_process(facts, machine.hash));
    };
    const auto& owner = session->state();
    add_process("coordinator", std::nullopt, owner.has_value(), owner ? owner->state.config_hash : 0);
    for (const MotorIndex i : motor_indices(motor_count(machine.config))) {
        const auto& axis = session->received().motor(i);
        add_process(session->received().kinematics().label(i), i, axis.has_value(), axis ? axis->state.config_hash : 0);
    }
}

std::string_view name_of(Rating rating) { return pick_name({"good", "doubtful", "bad"}, rating); }

proto::DoctorReport report_of(const Findings& findings, bool well) {
    proto::DoctorReport report;
    report.set_well(well);
    for (const Finding& finding : findings) {
        auto& message = *report.add_findings();
        message.set_verdict(std::string(name_of(finding.rating)));
        message.set_what(finding.what);
        message.set_found(finding.found);
        if (!finding.remedy.empty()) { message.set_remedy(finding.remedy); }
    }
    return report;
}

void print(const Finding& finding, Output& output) {
    constexpr std::size_t kColumn = 16;
    const std::string mark = finding.rating == Rating::Good  ? "ok   "
                             : finding.rating == Rating::Bad ? "BAD  "
                                                             : "?    ";
    std::string what = finding.what;
    what.resize(std::max(what.size() + 1, kColumn), ' ');
    output.print(mark + what + finding.found);
    if (!finding.remedy.empty()) { output.print("     " + std::string(kColumn, ' ') + "do: " + finding.remedy); }
}

ExitCode propose(const ProtocolTiming& today, double seconds, Output& output) {
    const doctor::StallFacts facts = watch_for_stalls(today.slot_us, seconds, output);
    const ProtocolTiming proposed = doctor::timing_for(facts, today);
    print_timing(facts, proposed, today, output);
    output.print("do: lockstep timing apply --stall-ms STALL, with the longest stall of all hosts");
    output.report(timing_report(facts, proposed));
    return kExitDone;
}

ExitCode examine(const DoctorOptions& options) {
    Output output(options.json);
    const auto machine = choose_machine(options.machine_file);
    if (!machine) { return output.fail(machine.error()); }
    if (options.timing) { return propose(machine->config.timing, options.seconds, output); }
    Findings findings;
    examine_network(machine->config, findings);
    examine_host(machine->config, options.seconds, output, findings);
    examine_parts_here(machine->config, findings);
    examine_keys(machine->config, findings);
    for (Finding& finding : findings) { finding.host = host_name(); }
    examine_processes(*machine, findings);
    for (Finding& finding : findings) {
        if (!finding.host.empty()) { finding.found += " (" + finding.host + ")"; }
    }
    const bool well = std::ranges::none_of(findings, [](const Finding& f) { return f.rating == Rating::Bad; });
    for (const Finding& finding : findings) { print(finding, output); }
    output.report(report_of(findings, well));
    return well ? kExitDone : kExitFailed;
}

}  // namespace

void add_doctor(Verb command) {
    const Verb verb = command.add_verb("doctor",
                                       "check whether this host and its network suit a machine\n"
                                       "The command prints the command that corrects each problem.");
    const auto options = std::make_shared<DoctorOptions>();
    verb.add_option("--seconds", options->seconds,
                    "for how many seconds to measure stalls; run the command under the usual load")
        .in_range(0.1, 3600.0)
        .with_default();
    verb.add_flag("--timing", options->timing, "only watch for stalls, and propose the fastest timing for them");
    add_live_options(verb, *options);
    verb.footer(
        footer("  lockstep doctor --machine mill.textproto\n  lockstep doctor --seconds 600 --json\n  lockstep doctor "
               "--timing --seconds 600\n"));
    verb.action([options] { return examine(*options); });
}

}  // namespace lockstep
