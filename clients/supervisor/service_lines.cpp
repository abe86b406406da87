#include "clients/supervisor/service_lines.hpp"

namespace lockstep {
namespace {

std::string shared_name(const MachineConfig& machine, const AxisConfig& axis) {
    return "lockstep-" + machine.name + "-" + axis.name;
}

}  // namespace

std::string shared_device(const MachineConfig& machine, const AxisConfig& axis) {
    return "shm:" + shared_name(machine, axis);
}

std::vector<ServiceLine> service_lines(const MachineConfig& machine, const Placement& placed, const Layout& layout,
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
    for (const std::size_t i : placed.axes) {
        if (layout.fpga != FpgaKind::Shared) { break; }
        const AxisConfig& axis = machine.axes[i];
        lines.push_back(line("fpga-" + axis.name, begin("lockstep-fpga"),
                             {"--axis", axis.name, "--name", shared_name(machine, axis)}));
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
    for (const std::size_t i : placed.axes) {
        const AxisConfig& axis = machine.axes[i];
        const std::string name = "axis-" + axis.name;
        std::vector<std::string> more{"--axis", axis.name, "--log", state.log_file(name).string()};
        if (layout.fpga == FpgaKind::Sim) { more.insert(more.end(), {"--fpga", "sim"}); }
        if (layout.fpga == FpgaKind::Shared) { more.insert(more.end(), {"--fpga", shared_device(machine, axis)}); }
        lines.push_back(line(name, begin("lockstep-axis"), more));
    }
    if (placed.coordinator && (layout.web || machine.web)) {
        lines.push_back(line(kWeb, begin("lockstep-web"), {"--page-file", state.page_file().string()}));
    }
    return lines;
}

}  // namespace lockstep
