#include "clients/scenario/runner/run_scenario.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <algorithm>
#include <thread>

#include "clients/analysis/analysis.hpp"
#include "clients/report_page/report_page.hpp"
#include "clients/scenario/model/evaluation.hpp"
#include "clients/scenario/runner/evidence.hpp"
#include "clients/scenario/runner/sandbox.hpp"
#include "clients/scenario/runner/scenario_executor.hpp"
#include "clients/supervisor/flight_files.hpp"
#include "clients/supervisor/program_folder.hpp"
#include "clients/text/format.hpp"
#include "core/kinematics/motors.hpp"
#include "core/number_text.hpp"
#include "services/axis/device_window.hpp"
#include "services/documents/machine_file.hpp"
#include "services/files/text_file.hpp"
#include "services/network/host_name.hpp"

namespace lockstep::scenario {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr const char* kStandby = "coordinator-2";
constexpr auto kStartPatience = 10s;

std::string clock_error_text(const Asked::WrongClock& clock) {
    std::string text = fmt::format("offset={},ppm={}", number_text(clock.offset_s()), number_text(clock.ppm()));
    if (clock.has_step_s()) { text += ",step=" + number_text(clock.step_s()) + "@" + number_text(clock.step_at_s()); }
    return text;
}

/// The command lines of all processes, each in its own network or container.
std::vector<ServiceLine> lines_of(const Scenario& scenario, const Network& network, const Containers* containers,
                                  const StateDirectory& state, const DeviceFiles& files) {
    const Layout layout{scenario.asked.separate_devices() ? FpgaKind::Shared : FpgaKind::Sim, scenario.asked.standby(),
                        scenario.asked.continues()};
    const fs::path programs = containers == nullptr ? program_folder() : "";
    auto lines = service_lines(scenario.machine, placed_on(scenario.machine, host_name()), layout, programs, state);
    for (ServiceLine& line : lines) {
        for (const auto& clock : scenario.asked.wrong_clock()) {
            if (line.name != "axis-" + clock.axis()) { continue; }
            line.words.insert(line.words.end(), {"--clock-error", clock_error_text(clock)});
        }
        const bool is_device = line.name.starts_with("fpga-");
        if (is_device) {
            line.words.insert(line.words.end(),
                              {"--closed-inputs", files.closed_inputs.string(), "--pushes", files.pushes.string()});
        }
        const CommandLine entry = containers == nullptr ? network.entry(line.name)
                                                        : containers->entry(line.name, network.namespace_of(line.name));
        line.words.insert(line.words.begin(), entry.begin(), entry.end());
    }
    return lines;
}

/// Runs lcm-logger as long as the object exists.
class Logger {
public:
    Logger(const std::string& lcm_url, const fs::path& folder)
        : pid_(
              start_program({"lcm-logger", "--quiet", "--force", "--lcm-url=" + lcm_url, (folder / "run.lcm").string()},
                            folder / "lcm-logger.log")) {}
    ~Logger() {
        if (!pid_) { return; }
        kill(*pid_, SIGTERM);
        waitpid(*pid_, nullptr, 0);
    }
    Logger(const Logger&) = delete;
    Logger& operator=(const Logger&) = delete;
    const std::expected<pid_t, std::string>& pid() const { return pid_; }

private:
    std::expected<pid_t, std::string> pid_;
};

/// Waits for each device, so that the scenario's time starts when axes can attach.
std::expected<void, std::string> start_devices(const Scenario& scenario, ProcessSet& processes) {
    for (const std::string& motor : motor_names(scenario.machine)) {
        const std::string name = "fpga-" + motor;
        if (const auto started = processes.start(name); !started) { return started; }
        const auto deadline = monotonic_now() + kStartPatience;
        for (auto window = open_window(shared_device(scenario.machine, motor), scenario.machine); !window;
             window = open_window(shared_device(scenario.machine, motor), scenario.machine)) {
            if (monotonic_now() > deadline) { return std::unexpected(name + ": " + window.error()); }
            std::this_thread::sleep_for(5ms);
        }
    }
    return {};
}

/// If the machine does not become Idle, the error has the end of the coordinator's log.
std::expected<void, std::string> bring_up(const Scenario& scenario, ProcessSet& processes, Session& session,
                                          ScenarioExecutor& executor, const StateDirectory& state) {
    if (scenario.asked.separate_devices()) {
        if (const auto started = start_devices(scenario, processes); !started) { return started; }
    }
    for (const std::string& name : processes_of(scenario.asked, scenario.machine)) {
        if (name == kStandby || name.starts_with("fpga-")) { continue; }
        if (const auto started = processes.start(name); !started) { return started; }
    }
    if (!executor.wait_for(Asked::IDLE)) {
        return std::unexpected("the machine does not become Idle; the last output of the coordinator:\n" +
                               tail_of(state.log_file("coordinator"), 4));
    }
    if (!scenario.asked.standby()) { return {}; }
    if (const auto started = processes.start(kStandby); !started) { return started; }
    const auto deadline = monotonic_now() + kStartPatience;
    while (!session.has_standby()) {
        if (monotonic_now() > deadline) { return std::unexpected("no state of the standby coordinator is received"); }
        session.receive(50ms);
    }
    return {};
}

/// The observations of a run that could not begin: only the reason.
Observations broken(const std::string& why) {
    Observations observed;
    observed.broken = why;
    return observed;
}

/// Adds a check for each clock step: it happens only if the processes run long enough.
void add_clock_checks(const Scenario& scenario, std::chrono::nanoseconds lived, Observations& observed) {
    const double lived_s = static_cast<double>(lived.count()) * 1e-9;
    for (const auto& clock : scenario.asked.wrong_clock()) {
        if (!clock.has_step_s()) { continue; }
        const bool was_set = lived_s > clock.step_at_s();
        observed.checks.push_back(check_of(
            fmt::format("the clock of {} is set by {} s, {} s after its process started", clock.axis(),
                        number_text(clock.step_s()), number_text(clock.step_at_s())),
            was_set ? "it was" : "never happened: all ended after " + fixed(lived_s, 1) + " s", kAsObserved, was_set));
    }
}

Observations run_session(const Scenario& scenario, const ChosenMachine& machine, ProcessSet& processes,
                         Network& network, const StateDirectory& state, const DeviceFiles& files) {
    auto session = Session::join(machine, Purpose::Command);
    if (!session) { return broken(to_text("", session.error().errors)); }
    ActExecutor acts(processes, network, *session, files);
    ScenarioExecutor executor(scenario, *session, processes, acts);
    const auto begun = monotonic_now();
    if (const auto up = bring_up(scenario, processes, *session, executor, state); !up) { return broken(up.error()); }
    executor.execute();
    (void)write_flight_files(scenario.machine);
    Observations observed = executor.observations();
    add_clock_checks(scenario, monotonic_now() - begun, observed);
    return observed;
}

/// Brings the machine up, executes the steps, takes it down.
Observations run_machine(const Scenario& scenario, const Containers* containers, const fs::path& folder) {
    if (containers != nullptr) { umask(0); }  // a container's user writes files that root has made
    const StateDirectory state(scenario.machine.name);
    const fs::path file = folder / "machine.textproto";
    const auto made = state.make();
    if (!made) { return broken(made.error()); }
    for (const fs::path& path : {file, state.machine_file()}) {
        const auto written = write_text_file(path, machine_text(scenario.machine));
        if (!written) { return broken(written.error()); }
    }
    auto network =
        Network::make(scenario.asked.place(), processes_of(scenario.asked, scenario.machine), folder / "network.log");
    if (!network) { return broken(network.error()); }
    const Logger logger(scenario.machine.network.lcm_url, folder);
    if (!logger.pid()) { return broken(logger.pid().error()); }
    const DeviceFiles files{folder / "closed-inputs", folder / "pushes"};
    ProcessSet processes(lines_of(scenario, *network, containers, state, files), state,
                         containers == nullptr ? fs::path() : Containers::pid_folder());
    Observations observed = run_session(scenario, {file, scenario.machine, config_hash(scenario.machine)}, processes,
                                        *network, state, files);
    observed.checks.push_back(processes.exit_check());
    processes.end_all();
    return observed;
}

/// Copies the logs, and a page of the run, into the directory.
void keep_logs(const fs::path& folder, int directory) {
    if (const auto found = analysis::analyze_log(folder / kWholeLog)) {
        (void)analysis::write_html(*found, folder / "whole.html");
    }
    std::error_code error;
    fs::copy(folder, fmt::format("/proc/self/fd/{}", directory), fs::copy_options::recursive, error);
}

proto::ScenarioReport report_of(const Scenario& scenario, const Observations& observed,
                                const std::vector<Check>& evaluated) {
    proto::ScenarioReport report;
    report.set_file(scenario.file.string());
    report.set_shows(scenario.asked.shows());
    report.set_broken(observed.broken);
    report.mutable_story()->Add(observed.events.begin(), observed.events.end());
    report.mutable_checks()->Add(observed.checks.begin(), observed.checks.end());
    report.mutable_checks()->Add(evaluated.begin(), evaluated.end());
    const auto& checks = report.checks();
    report.set_held(observed.broken.empty() &&
                    std::ranges::all_of(checks, [](const Check& check) { return check.held(); }));
    return report;
}

}  // namespace

proto::ScenarioReport run_scenario(const Scenario& scenario, const std::optional<Containers>& containers, int keep) {
    const auto begun = monotonic_now();
    const fs::path folder = sandbox_folder();
    setenv("LOCKSTEP_STATE", (folder / "state").c_str(), 1);
    const bool in_containers = scenario.asked.place() == Asked::CONTAINER;
    const Observations observed = run_machine(scenario, in_containers ? &*containers : nullptr, folder);
    std::vector<Check> evaluated;
    if (observed.broken.empty()) { evaluated = evaluate(scenario, observed, read_evidence(scenario.machine, folder)); }
    proto::ScenarioReport report = report_of(scenario, observed, evaluated);
    if (keep >= 0) { keep_logs(folder, keep); }
    report.set_took_s(static_cast<double>((monotonic_now() - begun).count()) * 1e-9);
    return report;
}

}  // namespace lockstep::scenario
