#include "clients/scenario/model/scenario.hpp"

#include "clients/scenario/model/rules.hpp"
#include "core/gcode/gcode.hpp"
#include "core/kinematics/motors.hpp"
#include "services/documents/machine_errors.hpp"
#include "services/documents/machine_file.hpp"
#include "services/documents/program_file.hpp"
#include "services/files/text_file.hpp"

namespace lockstep::scenario {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLcmGroup = "udpm://239.255.76.67:7667?recv_buf_size=4194304&ttl=";

Diagnostics at_key(const TextSource& source, std::string_view key, const std::string& message) {
    const auto place = source.place_of(*Asked::descriptor(), key);
    return {{place.line, place.column, message}};
}

/// Reports each error in the machine's file at the key that names the file, with the place in that file.
std::expected<MachineSetup, Diagnostics> machine_of_file(const Asked& asked, const TextSource& source,
                                                         const fs::path& folder) {
    const fs::path path = folder / asked.machine_file();
    auto machine = load_machine_file(path);
    if (machine) { return *std::move(machine); }
    Diagnostics errors;
    for (const Diagnostic& error : machine.error()) {
        const auto place = source.place_of(*Asked::descriptor(), "machine_file");
        errors.push_back({place.line, place.column, to_text(path.string(), error)});
    }
    return std::unexpected(errors);
}

std::expected<MachineSetup, Diagnostics> machine_of(const Asked& asked, const TextSource& source,
                                                    const fs::path& folder) {
    if (asked.has_machine() && asked.has_machine_file()) {
        return std::unexpected(
            at_key(source, "machine_file", "machine and machine_file both name a machine; keep one"));
    }
    if (asked.has_machine_file()) { return machine_of_file(asked, source, folder); }
    if (!asked.has_machine()) {
        return std::unexpected(
            at_key(source, "", "the machine is missing; set machine_file: \"FILE\", or machine { ... }"));
    }
    MachineDraft draft = machine_from_proto(asked.machine());
    const Diagnostics errors = machine_errors(draft, source, *Asked::descriptor(), "machine.");
    if (!errors.empty()) { return std::unexpected(errors); }
    return std::move(draft.machine);
}

}  // namespace

std::expected<Scenario, Diagnostics> parse_scenario(std::string_view text, const fs::path& file,
                                                    std::optional<Asked::Place> place) {
    TextSource source;
    Scenario scenario{.file = file};
    if (const Diagnostics errors = source.parse(text, scenario.asked); !errors.empty()) {
        return std::unexpected(errors);
    }
    if (place) { scenario.asked.set_place(*place); }
    auto machine = machine_of(scenario.asked, source, file.parent_path());
    if (!machine) { return std::unexpected(machine.error()); }
    scenario.machine = isolated(*std::move(machine), scenario.asked.place());
    if (const Diagnostics errors = rule_errors(scenario, source); !errors.empty()) { return std::unexpected(errors); }
    return scenario;
}

std::expected<Scenario, Diagnostics> load_scenario(const fs::path& file, std::optional<Asked::Place> place) {
    const auto text = read_text_file(file);
    if (!text) { return std::unexpected(Diagnostics{text.error()}); }
    return parse_scenario(*text, file, place);
}

bool has_links(Asked::Place place) { return place == Asked::NAMESPACE || place == Asked::CONTAINER; }

std::vector<std::string> processes_of(const Asked& asked, const MachineSetup& machine) {
    std::vector<std::string> names{"coordinator"};
    if (asked.standby()) { names.emplace_back("coordinator-2"); }
    const std::vector<std::string> motors = motor_names(machine);
    for (const std::string& motor : motors) { names.push_back("axis-" + motor); }
    for (const std::string& motor : motors) {
        if (asked.separate_devices()) { names.push_back("fpga-" + motor); }
    }
    return names;
}

std::expected<ProgramOfRun, Diagnostics> program_of(const Asked::Run& run, const fs::path& folder,
                                                    const MachineSetup& machine, const std::vector<double>& start_mm,
                                                    const gcode::KeptValues& values) {
    const fs::path file = folder / (run.has_file() ? run.file() : "gcode");
    ProgramOfRun program{run.gcode(), program_setup(file, machine, start_mm, {}, values)};
    if (!run.has_file()) { return program; }
    auto text = read_text_file(file);
    if (!text) { return std::unexpected(Diagnostics{text.error()}); }
    program.text = *std::move(text);
    return program;
}

MachineSetup isolated(MachineSetup machine, Asked::Place place) {
    const bool linked = has_links(place);
    machine.network = {.interface = linked ? "eth0" : "lo",
                       .lcm_url = kLcmGroup + std::string(linked ? "1" : "0"),
                       .one_host = machine.network.one_host && !linked};
    machine.record = {};
    machine.position_directory.clear();
    machine.coordinator_host.clear();
    for (BoardConfig& board : machine.boards) { board = {.name = board.name, .host = {}, .device = {}}; }
    for (AxisConfig& axis : machine.axes) {
        axis.host.clear();
        axis.device = {};
        for (MotorBlock& motor : axis.motors) {
            motor.host.clear();
            motor.device = {};
        }
    }
    return machine;
}

}  // namespace lockstep::scenario
