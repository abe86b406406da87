#include "clients/session/homing/homing_report.hpp"

#include <algorithm>
#include <iterator>
#include <vector>

#include "clients/text/format.hpp"
#include "core/protocol/names.hpp"

namespace lockstep {
namespace {

void add_by_itself(const AxisState* state, proto::AxisStatus& row) {
    if (state == nullptr || state->homing == HomingStage::Idle) { return; }
    row.mutable_homing()->set_stage(std::string(name_of(state->homing)));
    row.mutable_homing()->set_closed(state->switches.home);
}

void add_by_touch(const HomedByTouch& homing, const MachineConfig& machine, proto::StatusReport& report) {
    if (homing.axis >= machine.axes.size() || homing.stage == HomingStage::Idle) { return; }
    const std::string& input = machine.axes[homing.axis].homing.input;
    proto::HomingReport& row = *report.mutable_axes(static_cast<int>(homing.axis))->mutable_homing();
    row.set_stage(std::string(name_of(homing.stage)));
    row.set_switch_(input);
    const auto status = std::ranges::find(report.inputs(), input, &proto::InputStatus::name);
    if (status != report.inputs().end() && status->has_closed()) { row.set_closed(status->closed()); }
}

std::string in_words(const proto::HomingReport& homing) {
    const std::string name = homing.switch_().empty() ? "its switch" : homing.switch_();
    const std::string with_state = name + (!homing.has_closed() ? "" : homing.closed() ? " (closed)" : " (open)");
    const auto stage = std::ranges::find(kHomingStages, homing.stage(), &HomingStageRow::name);
    if (stage == kHomingStages.end()) { return homing.stage(); }
    return in_words(*stage, stage->asks_switch ? with_state : name);
}

/// `moving`: the names of those in a part of homing.
std::string in_words(const proto::AxisStatus& row, const std::string& moving) {
    if (row.homed()) { return "homed at " + fixed(row.position_mm(), 3); }
    if (!row.present()) { return "not received"; }
    if (row.has_homing()) { return in_words(row.homing()); }
    return moving.empty() ? row.state() : "waits for " + moving;
}

/// The rows of an axis: its motors, if it has no motor of its own and does not home as a whole.
std::vector<const proto::AxisStatus*> rows_of_axis(const proto::StatusReport& status, const proto::AxisStatus& axis) {
    std::vector<const proto::AxisStatus*> rows;
    for (const proto::AxisStatus& motor : status.motors()) {
        if (motor.axis() == axis.name() && !axis.has_homing()) { rows.push_back(&motor); }
    }
    return rows.empty() ? std::vector{&axis} : rows;
}

}  // namespace

void add_homing(const MachineConfig& config, const Kinematics& kinematics,
                const std::function<const AxisState*(MotorIndex)>& state_of, const MachineState* machine,
                proto::StatusReport& report) {
    for (int i = 0; i < report.axes_size(); ++i) {
        const auto own = kinematics.own_motor(AxisIndex{static_cast<std::size_t>(i)});
        if (own) { add_by_itself(state_of(*own), *report.mutable_axes(i)); }
    }
    for (proto::AxisStatus& row : *report.mutable_motors()) {
        const auto motor = std::ranges::find(kinematics.motors(), row.name(), &MotorConfig::name);
        add_by_itself(state_of(MotorIndex{static_cast<std::size_t>(motor - kinematics.motors().begin())}), row);
    }
    if (machine != nullptr && machine->homing) { add_by_touch(*machine->homing, config, report); }
}

std::string homing_text(const proto::StatusReport& status, AxisSet axes) {
    std::vector<const proto::AxisStatus*> rows;
    for (int i = 0; i < status.axes_size(); ++i) {
        if (!axes.empty() && !axes.contains(AxisIndex{static_cast<std::size_t>(i)})) { continue; }
        std::ranges::copy(rows_of_axis(status, status.axes(i)), std::back_inserter(rows));
    }
    std::string moving;
    for (const proto::AxisStatus* const row : rows) {
        if (row->has_homing()) { moving += (moving.empty() ? "" : ", ") + row->name(); }
    }
    std::string text;
    for (const proto::AxisStatus* const row : rows) {
        text += (text.empty() ? "" : "   ") + row->name() + " " + in_words(*row, moving);
    }
    return text;
}

}  // namespace lockstep
