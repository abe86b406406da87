#include "services/documents/placement.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/kinematics/motors.hpp"
#include "services/documents/names.hpp"

namespace lockstep {
namespace {

std::string_view without_domain(std::string_view host) { return host.substr(0, host.find('.')); }

bool is_placed(const std::string& where, std::string_view host) { return where.empty() || same_host(where, host); }

std::string names_of(const MachineSetup& machine, const std::vector<MotorIndex>& axes) {
    std::string names;
    for (const MotorIndex i : axes) { names += (names.empty() ? "" : " ") + motor_name(machine, i); }
    return names;
}

const char* kind_of(const MachineSetup& machine) { return machine.boards.empty() ? "axis" : "axis or board"; }

std::string places_of(const MachineSetup& machine) {
    std::string places;
    for (const MotorConfig& axis : motors_of(machine)) {
        places += " " + axis.name + " (" + (axis.host.empty() ? "no host" : axis.host) + ")";
    }
    return places;
}

}  // namespace

bool same_host(std::string_view one, std::string_view other) {
    const bool both_whole = one.contains('.') && other.contains('.');
    return both_whole ? same_name(one, other) : same_name(without_domain(one), without_domain(other));
}

std::vector<std::string> hosts_of(const MachineSetup& machine) {
    std::vector<std::string> hosts;
    const auto add = [&](const std::string& host) {
        const auto is_it = [&](const std::string& known) { return same_host(known, host); };
        if (!host.empty() && std::ranges::none_of(hosts, is_it)) { hosts.push_back(host); }
    };
    add(machine.coordinator_host);
    for (const MotorConfig& motor : motors_of(machine)) { add(motor.host); }
    return hosts;
}

Placement placed_on(const MachineSetup& machine, std::string_view host) {
    Placement placement{.coordinator = is_placed(machine.coordinator_host, host)};
    const std::vector<MotorConfig> motors = motors_of(machine);
    for (const MotorIndex i : motor_indices(motors.size())) {
        if (is_placed(motors[i].host, host)) { placement.axes.push_back(i); }
    }
    return placement;
}

std::expected<MotorIndex, std::string> axis_to_run(const MachineSetup& machine, std::string_view named,
                                                   std::string_view host) {
    std::vector<MotorIndex> fit;
    const std::vector<MotorConfig> motors = motors_of(machine);
    for (const MotorIndex i : motor_indices(motors.size())) {
        const MotorConfig& axis = motors[i];
        const bool here = !axis.host.empty() && same_host(axis.host, host);
        if (named.empty() ? here : axis.name == named) { fit.push_back(i); }
    }
    if (fit.size() == 1) { return fit.front(); }
    if (!named.empty()) {
        return std::unexpected(fmt::format("has no {} {}; it has:{}", kind_of(machine), named, places_of(machine)));
    }
    if (fit.empty()) {
        return std::unexpected(
            fmt::format("places no axis on this host, {}; it has:{}; name one with --axis, or set its host in the file",
                        host, places_of(machine)));
    }
    return std::unexpected(
        fmt::format("places several axes on this host, {}: {}; name one with --axis", host, names_of(machine, fit)));
}

}  // namespace lockstep
