#include "clients/supervisor/service_lines.hpp"

#include <set>

#include "core/kinematics/motors.hpp"

namespace lockstep {
namespace {

/// The boards behind links that carry devices of these motors, each once.
std::set<std::string> boards_of(const MachineSetup& machine, const std::vector<MotorIndex>& placed) {
    const std::vector<MotorConfig> motors = motors_of(machine);
    std::set<std::string> boards;
    for (const MotorIndex i : placed) {
        if (motors[i].device.kind == DeviceName::Kind::Linked) { boards.insert(motors[i].device.place); }
    }
    return boards;
}

std::string shared_name(const MachineSetup& machine, const std::string& motor) {
    return "lockstep-" + machine.name + "-" + motor;
}

}  // namespace

DeviceName shared_device(const MachineSetup& machine, const std::string& motor) {
    return {DeviceName::Kind::Shared, shared_name(machine, motor)};
}

std::vector<ServiceLine> service_lines(const MachineSetup& machine, const Placement& placed, const Layout& layout,
                                       const std::filesystem::path& programs, const StateDirectory& state) {
    const auto begin = [&](const char* program) {
        return std::vector<std::string>{(programs / program).string(), "--machine", state.machine_file().string()};
    };
    const auto line = [](const std::string& name, std::vector<std::string> words,
                         const std::vector<std::string>& more) {
        words.insert(words.end(), more.begin(), more.end());
        return ServiceLine{name, std::move(words)};
    };
    std::vector<ServiceLine> lines;
    for (const MotorIndex i : placed.axes) {
        if (layout.fpga != FpgaKind::Shared) { break; }
        const std::string& motor = motor_name(machine, i);
        lines.push_back(
            line("fpga-" + motor, begin("lockstep-fpga"), {"--axis", motor, "--name", shared_name(machine, motor)}));
    }
    if (layout.fpga == FpgaKind::AsConfigured) {
        for (const std::string& board : boards_of(machine, placed.axes)) {
            const std::string name = "board-" + board;
            lines.push_back(
                line(name, begin("lockstep-board"), {"--board", board, "--log", state.log_file(name).string()}));
        }
    }
    for (const char* name : {"coordinator", "coordinator-2"}) {
        if (!placed.coordinator) { break; }
        std::vector<std::string> more{"--log", state.log_file(name).string()};
        if (layout.standby) { more.emplace_back("--standby"); }  // both: a coordinator that restarts stands by
        if (layout.continues) { more.insert(more.end(), {"--on-takeover", "continue"}); }
        if (name != std::string_view("coordinator")) { more.emplace_back("--second"); }
        lines.push_back(line(name, begin("lockstep-coordinator"), more));
        if (!layout.standby) { break; }
    }
    for (const MotorIndex i : placed.axes) {
        const std::string& motor = motor_name(machine, i);
        const std::string name = "axis-" + motor;
        std::vector<std::string> more{"--axis", motor, "--log", state.log_file(name).string()};
        if (layout.fpga == FpgaKind::Sim) { more.insert(more.end(), {"--fpga", "sim"}); }
        if (layout.fpga == FpgaKind::Shared) {
            more.insert(more.end(), {"--fpga", shared_device(machine, motor).text()});
        }
        lines.push_back(line(name, begin("lockstep-axis"), more));
    }
    if (placed.coordinator && (layout.web || machine.web)) {
        lines.push_back(line(kWeb, begin("lockstep-web"), {"--page-file", state.page_file().string()}));
    }
    return lines;
}

}  // namespace lockstep
