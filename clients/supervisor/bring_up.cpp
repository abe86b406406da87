#include "clients/supervisor/bring_up.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "clients/doctor/probes.hpp"
#include "clients/session/parts.hpp"
#include "clients/supervisor/own_parts.hpp"
#include "clients/supervisor/program_folder.hpp"
#include "clients/supervisor/supervisor.hpp"
#include "core/kinematics/motors.hpp"
#include "services/axis/position_file.hpp"
#include "services/documents/machine_file.hpp"
#include "services/network/host_name.hpp"
#include "services/network/multicast.hpp"
#include "services/record/own_log.hpp"
#include "services/runtime/clock.hpp"
#include "services/runtime/log.hpp"

namespace lockstep {
namespace {

using namespace std::chrono_literals;
using std::chrono::nanoseconds;

constexpr nanoseconds kUpPatience = 20s;
constexpr nanoseconds kUpPatienceEach = 400ms;  // for each axis: they start one by one, and discover each other
constexpr std::size_t kTailLines = 6;

void route_multicast(const NetworkConfig& network, Output& output) {
    if (needs_loopback_multicast(network)) {
        if (const auto route = ensure_loopback_multicast(); !route) { output.warn(route.error()); }
    }
    if (const auto may = check_multicast(network); !may) { output.warn("the record is not published: " + may.error()); }
}

void warn_of_directory(const std::string& lost, const std::filesystem::path& path, const std::string& key,
                       Output& output) {
    const std::string why = doctor::why_not_writable(path);
    if (why.empty()) { return; }
    output.warn(
        fmt::format("{}: {} cannot be written ({}); give it to this user: install -d -o $(id -un) {}; or set {} in the "
                    "machine's file to another directory",
                    lost, path.string(), why, path.string(), key));
}

/// The services find the same problems, but report them only in their logs.
void warn_of_directories(const MachineSetup& machine, const Placement& placed, Output& output) {
    if (machine.record.own_logs) {
        warn_of_directory("the processes on this host write no logs of their own", own_log_directory(machine),
                          "record { directory }", output);
    }
    if (placed.axes.empty()) { return; }
    warn_of_directory("positions are not kept", position_file(machine, placed.axes.front()).parent_path(),
                      "position_directory", output);
}

std::expected<void, Failure> check_programs(const std::vector<ServiceLine>& lines) {
    for (const ServiceLine& line : lines) {
        if (access(line.words[0].c_str(), X_OK) == 0) { continue; }
        return std::unexpected(failed("cannot execute " + line.words[0] + "; install it beside the lockstep command"));
    }
    return {};
}

std::string names_of(const std::vector<ProcessRecord>& processes) {
    std::string names;
    for (const ProcessRecord& process : processes) { names += (names.empty() ? "" : ", ") + process.name; }
    return names;
}

std::expected<void, Failure> claim(const ChosenMachine& machine, const StateDirectory& state) {
    const std::string name = "machine '" + machine.config.name + "'";
    if (const auto running = state.running(); !running.empty()) {
        const auto trouble = state.record_trouble();
        return std::unexpected(failed(name + " is already up (" + names_of(running) + ")" +
                                      (trouble ? ", but " + *trouble + "; end the machine: lockstep down"
                                               : "; see: lockstep status, lockstep down")));
    }
    if (auto made = state.make(); !made) { return std::unexpected(failed(made.error())); }
    if (!state.lock()) {
        return std::unexpected(failed(name + " is being started by another lockstep up; see: lockstep status"));
    }
    state.forget_processes();
    state.remove_logs();
    std::error_code none;
    std::filesystem::remove(state.page_file(), none);
    if (auto written = state.write_machine_file(machine_text(machine.config)); !written) {
        return std::unexpected(failed(written.error()));
    }
    if (auto written = state.write_source(machine.source, machine.settings); !written) {
        return std::unexpected(failed(written.error()));
    }
    return {};
}

/// Makes this process the supervisor, which never returns to the caller's terminal.
[[noreturn]] void be_supervisor(const StateDirectory& state, const std::vector<ServiceLine>& lines) {
    setsid();
    const int log = open(state.log_file(kSupervisor).c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
    dup2(open("/dev/null", O_RDONLY | O_CLOEXEC), STDIN_FILENO);
    dup2(log, STDOUT_FILENO);
    dup2(log, STDERR_FILENO);
    supervise(state, lines);
    _exit(0);
}

std::string with_log(const std::string& what, const std::string& process, const StateDirectory& state) {
    const std::string tail = tail_of(state.log_file(process), kTailLines);
    const std::string log = state.log_file(process).string();
    return what + (tail.empty() ? "; its log " + log + " is empty" : "; the end of its log " + log + ":\n" + tail);
}

/// An error of a process that was given up, or of a part that runs elsewhere; nullopt while the start may succeed.
std::optional<std::string> trouble(const MachineSetup& machine, const OwnParts& parts, const StateDirectory& state,
                                   const ProcessRecord& supervisor, const std::vector<PresentProcess>& present) {
    for (const ProcessRecord& process : state.recorded()) {
        if (!process.pid && process.name != kWeb) {
            return with_log(process.name + " ended and is not started again", process.name, state);
        }
    }
    if (!is_running(supervisor)) { return with_log("the supervisor ended", kSupervisor, state); }
    return foreign_part(machine, parts.placed, supervisor, present);
}

/// The error for the first part that is still missing at the deadline.
Failure missing(const Session& session, const OwnParts& parts, const StateDirectory& state) {
    const auto present = session.present();
    const auto recorded = state.recorded();
    for (const ServiceLine& line : parts.lines) {
        if (are_present({line}, recorded, present)) { continue; }
        return failed(with_log(line.name + " does not appear on the network", line.name, state));
    }
    if (!session.state()) {
        return failed(with_log("no messages are received from the coordinator", "coordinator", state));
    }
    for (const MotorIndex i : motor_indices(session.received().kinematics().motors().size())) {
        const std::string& name = motor_name(session.config(), i);
        if (!session.state()->state.motors_present.contains(i)) {
            return failed(with_log("no messages are received from " + session.received().kinematics().label(i),
                                   "axis-" + name, state));
        }
    }
    for (const MotorIndex i : motor_indices(session.received().kinematics().motors().size())) {
        const std::string& name = motor_name(session.config(), i);
        const auto& axis = session.received().motor(i);
        if (axis && axis->state.unproved == FaultCode::DeviceMissing) {
            return failed(
                with_log(session.received().kinematics().label(i) + " waits for its device", "axis-" + name, state));
        }
    }
    return failed(with_log("the machine does not become Idle", "coordinator", state));
}

/// The name of a part without a host, if the machine has several hosts; empty if every part has one.
std::string part_without_host(const MachineSetup& machine) {
    if (hosts_of(machine).size() < 2) { return ""; }
    if (machine.coordinator_host.empty()) { return part_name(machine, {}); }
    const std::vector<MotorConfig> motors = motors_of(machine);
    for (const MotorIndex i : motor_indices(motors.size())) {
        if (motors[i].host.empty()) { return part_name(machine, i); }
    }
    return "";
}

}  // namespace

std::expected<OwnParts, Failure> prepare(const ChosenMachine& machine, const Layout& layout,
                                         const StateDirectory& state, Output& output) {
    const Placement placed = placed_on(machine.config, host_name());
    if (placed.empty()) {
        return std::unexpected(
            bad_input(fmt::format("{}: assigns no part of the machine to this host, {}; start the machine's parts on "
                                  "their hosts, or change `host`",
                                  machine.file.string(), host_name())));
    }
    if (const std::string part = part_without_host(machine.config); !part.empty()) {
        return std::unexpected(bad_input(machine.file.string() + ": " + part +
                                         " has no host, but other parts do; lockstep up would start it on every host: "
                                         "set its host"));
    }
    const auto lines = service_lines(machine.config, placed, layout, program_folder(), state);
    if (auto checked = check_programs(lines); !checked) { return std::unexpected(checked.error()); }
    if (auto claimed = claim(machine, state); !claimed) { return std::unexpected(claimed.error()); }
    if (!machine.settings.empty()) { output.print(settings_notice(machine.settings) + "; see: lockstep config"); }
    route_multicast(machine.config.network, output);
    warn_of_directories(machine.config, placed, output);
    return OwnParts{placed, lines};
}

void supervise(const StateDirectory& state, const std::vector<ServiceLine>& lines) {
    (void)open_log({kSupervisor, ""});  // to standard error, which cannot fail
    const auto settings = read_settings(state.settings_in_force());
    if (settings && !settings->empty()) { log_info(settings_notice(*settings)); }
    Supervisor(state, lines).run();
}

std::expected<ProcessRecord, Failure> supervise_in_background(const StateDirectory& state,
                                                              const std::vector<ServiceLine>& lines) {
    const pid_t pid = fork();
    if (pid < 0) {
        return std::unexpected(failed("cannot start the supervisor, because the host allows no more processes"));
    }
    if (pid == 0) { be_supervisor(state, lines); }
    return ProcessRecord{kSupervisor, pid, start_of(pid).value_or(0)};
}

bool is_whole(const Session& session) {
    if (!session.state()) { return false; }
    for (const MotorIndex i : motor_indices(session.received().kinematics().motors().size())) {
        if (!session.received().motor_present(i) || !session.state()->state.motors_present.contains(i)) {
            return false;
        }
    }
    const MachinePhase phase = session.state()->state.phase;
    return phase == MachinePhase::Idle || phase == MachinePhase::Fault;
}

bool is_alone(const MachineSetup& machine, const Placement& placed) {
    return placed.coordinator && placed.axes.size() == motor_count(machine);
}

std::expected<Session, Failure> wait_until_up(const ChosenMachine& machine, const OwnParts& parts,
                                              const StateDirectory& state, const ProcessRecord& supervisor) {
    auto session = Session::join(machine, Purpose::Look);
    if (!session) { return session; }
    const bool alone = is_alone(machine.config, parts.placed);
    const nanoseconds deadline = monotonic_now() + kUpPatience + kUpPatienceEach * motor_count(machine.config);
    for (;;) {
        const auto present = session->present();
        if (const auto what = trouble(machine.config, parts, state, supervisor, present)) {
            return std::unexpected(failed(*what));
        }
        if (are_present(parts.lines, state.recorded(), present) && (!alone || is_whole(*session))) { return session; }
        if (monotonic_now() > deadline) { return std::unexpected(missing(*session, parts, state)); }
        session->receive(100ms);
    }
}

bool await_others(Session& session, nanoseconds patience) {
    return session.receive_until(patience, [&] { return is_whole(session); });
}

}  // namespace lockstep
