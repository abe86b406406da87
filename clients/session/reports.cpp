#include "clients/session/reports.hpp"

#include "clients/session/remedy_words.hpp"
#include "core/axis_unit.hpp"
#include "core/kinematics/axis_states.hpp"
#include "core/kinematics/kinematics.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "clients/session/health_report.hpp"
#include "clients/session/homing/homing_report.hpp"
#include "clients/session/inputs/input_report.hpp"
#include "clients/session/outputs/output_report.hpp"
#include "clients/text/format.hpp"
#include "core/coordinator/path/return_way.hpp"
#include "core/protocol/names.hpp"
#include "services/flight/incident_file.hpp"
#include "services/runtime/clock.hpp"

namespace lockstep {
namespace {

bool is_in_motion(MachinePhase phase) { return phase == MachinePhase::Running || phase == MachinePhase::Stopping; }

proto::WriterReport writer_report(const MachineState& state, const MachineConfig& machine) {
    proto::WriterReport report;
    report.set_name(state.lease->writer.name);
    report.set_host(state.lease->writer.host);
    const auto ticks = static_cast<double>((state.tick - state.lease->since).value);
    report.set_held_s(std::max(0.0, ticks / machine.ticks_per_second()));
    const auto held = std::chrono::milliseconds(static_cast<std::int64_t>(report.held_s() * 1000));
    report.set_since(utc_text(std::chrono::system_clock::now() - held));
    return report;
}

void fill(proto::StatusReport& report, const MachineState& state, const MachineConfig& machine) {
    report.set_phase(std::string(name_of(state.phase)));
    if (auto fault = fault_of(state, machine)) { *report.mutable_fault() = *std::move(fault); }
    if (state.job > 0) { report.set_job(state.job); }
    report.set_feed_override_percent(state.overrides.feed_percent);
    report.set_rapid_override_percent(state.overrides.rapid_percent);
    if (state.job_fault != FaultCode::None) {
        *report.mutable_ended_early() = fault_report(state.job_fault, "");
        if (state.line) { report.set_line(*state.line); }
    }
    if (state.lease) { *report.mutable_writer() = writer_report(state, machine); }
    if (auto devices = devices_report(state.devices)) { *report.mutable_devices() = *std::move(devices); }
    if (!is_in_motion(state.phase)) { return; }
    report.set_waits_for_program(state.lacks_blocks);
    if (state.line) { report.set_line(*state.line); }
    report.set_progress(state.progress);
    report.set_remaining_s(state.remaining_s);
}

}  // namespace

proto::FaultReport fault_report(FaultCode fault, const std::string& axis) {
    proto::FaultReport report;
    report.set_number(static_cast<std::uint32_t>(fault));
    report.set_name(std::string(name_of(fault)));
    if (const FaultText* text = find_fault(fault)) {
        report.set_cause(std::string(text->cause));
        report.set_remedy(remedy_text(*text, shell_words));
    }
    if (!axis.empty()) { report.set_axis(axis); }
    return report;
}

proto::FaultReport motor_fault(FaultCode fault, const Kinematics& kinematics, MotorIndex motor) {
    const std::string& name = kinematics.motors()[motor].name;
    if (kinematics.is_named_as_axis(motor)) { return fault_report(fault, name); }
    proto::FaultReport report = fault_report(fault, "");
    if (!kinematics.motors()[motor].is_board()) {
        report.set_motor(name);
        return report;
    }
    report.set_board(name);
    if (const FaultText* text = find_fault(fault)) { report.set_remedy(remedy_text(for_board(*text), shell_words)); }
    return report;
}

std::optional<proto::FaultReport> fault_of(const MachineState& state, const MachineConfig& machine) {
    if (state.fault == FaultCode::None) { return std::nullopt; }
    const bool has_motor = state.fault_motor && *state.fault_motor < motor_count(machine);
    if (!has_motor) { return fault_report(state.fault, ""); }
    const MotorIndex motor = *state.fault_motor;
    proto::FaultReport report = motor_fault(state.fault, Kinematics(machine), motor);
    name_inputs(machine, motor, report);
    return report;
}

std::optional<proto::DevicesReport> devices_report(const ProgramDevices& devices) {
    if (devices == ProgramDevices{}) { return std::nullopt; }
    using Spindle = SpindleDirection;
    proto::DevicesReport report;
    if (devices.spindle != Spindle::Stopped) {
        report.mutable_spindle()->set_direction(devices.spindle == Spindle::Forward ? "forward" : "reverse");
        report.mutable_spindle()->set_rpm(devices.spindle_rpm);
    }
    report.set_mist(devices.mist);
    report.set_flood(devices.flood);
    if (devices.tool) { report.set_tool(*devices.tool); }
    for (const std::uint32_t output : devices.outputs_on()) { report.add_outputs(output); }
    return report;
}

std::string fault_place(const proto::FaultReport& fault) {
    if (fault.has_board()) { return "board " + fault.board() + ": "; }
    if (fault.has_motor()) { return "motor " + fault.motor() + ": "; }
    return fault.has_axis() ? "axis " + fault.axis() + ": " : "";
}

std::string fault_text(const proto::FaultReport& fault) {
    const std::string what =
        fmt::format("{}{} ({}): {}", fault_place(fault), fault.name(), fault.number(), fault.cause());
    return wrapped("fault: " + what, 80, "       ") + "\n" + wrapped("to do: " + fault.remedy(), 80, "       ");
}

proto::AxisStatus axis_status(const Scale& scale, const AxisState* state, double steps_per_tick) {
    proto::AxisStatus status;
    status.set_name(scale.name);
    if (state == nullptr) { return status; }
    status.set_position_mm(state->position.as_steps() / scale.steps_per_mm);
    status.set_position_steps(state->position.count());
    status.set_velocity_mm_s(steps_per_tick * scale.ticks_per_s / scale.steps_per_mm);
    status.set_state(std::string(name_of(state->phase)));
    status.set_homed(state->homed);
    if (state->fault != FaultCode::None) { *status.mutable_fault() = fault_report(state->fault, scale.name); }
    if (state->unproved != FaultCode::None) { *status.mutable_unproved() = fault_report(state->unproved, scale.name); }
    status.set_at_rest(state->at_rest);
    status.set_following_error_steps(state->following_error_steps);
    if (state->corrected_steps > 0) { status.set_corrected_steps(state->corrected_steps); }
    status.set_refused_frames(state->refused_frames);
    const double error_us = static_cast<double>(state->clock_error.value) / scale.ticks_per_s * 1e6;
    if (error_us > 0) { status.set_clock_error_us(error_us); }
    return status;
}

std::optional<Program> way_back(const Session& session) {
    const MachineConfig& machine = session.config();
    const auto& received = session.state();
    if (!received || !received->state.pause) { return std::nullopt; }
    const auto& place = received->state.pause->place;
    std::vector<std::int64_t> here;
    for (AxisIndex i; i < machine.axes.size() && session.received().axis(i); ++i) {
        here.push_back(session.received().axis(i)->state.position.count());
    }
    if (here.size() != machine.axes.size() || place.size() != here.size()) { return std::nullopt; }
    Program way = return_way(machine, here, {place.begin(), place.end()});
    return way.blocks.empty() ? std::nullopt : std::optional(std::move(way));
}

std::optional<proto::PauseReport> pause_report(const Session& session) {
    const auto& received = session.state();
    if (!received || !received->state.pause) { return std::nullopt; }
    const MachinePause& pause = *received->state.pause;
    proto::PauseReport report;
    report.set_reason(std::string(name_of(pause.why.reason)));
    if (pause.why.reason == PauseReason::ToolChange) { report.set_tool(pause.why.tool); }
    report.set_message(pause.why.text);
    report.set_text(text_of(pause.why));
    if (pause.why.reason == PauseReason::Input) { report.set_wait_left_s(pause.wait_left_s); }
    const auto& axes = session.config().axes;
    for (std::size_t i = 0; i < std::min(axes.size(), pause.place.size()); ++i) {
        *report.add_place() = place_of(axes[i], pause.place[i]);
    }
    if (const auto way = way_back(session)) { report.set_way_back(text_of_way(*way)); }
    return report;
}

namespace {

void add_health(const Session& session, MotorIndex motor, proto::AxisStatus& row) {
    const auto& health = session.received().health(motor);
    if (health) { *row.mutable_health() = health_report(*health, session.config()); }
}

/// `motors`: those that the axis's row is about. Names the first of them that has the row's fault.
void name_faults(const Session& session, MotorSet motors, proto::AxisStatus& row) {
    const auto named = [&](const proto::FaultReport& fault, FaultCode AxisState::*of) {
        for (const MotorIndex m : motors) {
            const auto code = static_cast<FaultCode>(fault.number());
            const bool has_it = session.received().motor(m) && session.received().motor(m)->state.*of == code;
            if (!has_it) { continue; }
            proto::FaultReport of_motor = motor_fault(code, session.received().kinematics(), m);
            name_inputs(session.config(), m, of_motor);
            return of_motor;
        }
        return fault;
    };
    if (row.has_fault()) { *row.mutable_fault() = named(row.fault(), &AxisState::fault); }
    if (row.has_unproved()) { *row.mutable_unproved() = named(row.unproved(), &AxisState::unproved); }
}

void add_axes(const Session& session, proto::StatusReport& report) {
    const MachineConfig& machine = session.config();
    for (const AxisIndex i : axis_indices(machine.axes.size())) {
        const AxisConfig& config = machine.axes[i];
        const auto& axis = session.received().axis(i);
        proto::AxisStatus& row = *report.add_axes();
        row = axis_status({config.name, config.steps_per_mm, machine.ticks_per_second()}, axis ? &axis->state : nullptr,
                          session.received().axis_speed(i));
        row.set_present(session.received().axis_present(i));
        name_faults(session, motors_needed_for(i, session.received().kinematics()), row);
        if (const auto own = session.received().kinematics().own_motor(i)) { add_health(session, *own, row); }
    }
}

/// Motors that are not an axis's own.
void add_motors(const Session& session, proto::StatusReport& report) {
    const Kinematics& kinematics = session.received().kinematics();
    for (const MotorIndex m : motor_indices(kinematics.motors().size())) {
        const MotorConfig& config = kinematics.motors()[m];
        if (config.is_board() || kinematics.own_motor(*config.axis) == m) { continue; }
        const auto& motor = session.received().motor(m);
        proto::AxisStatus& row = *report.add_motors();
        row = axis_status({config.name, config.steps_per_mm, session.config().ticks_per_second()},
                          motor ? &motor->state : nullptr, motor ? motor->state.velocity.steps_per_tick() : 0);
        row.set_axis(session.config().axes[*config.axis].name);
        row.set_present(session.received().motor_present(m));
        name_faults(session, {m}, row);
        add_health(session, m, row);
    }
}

void add_boards(const Session& session, proto::StatusReport& report) {
    const std::vector<MotorConfig>& motors = session.received().kinematics().motors();
    for (MotorIndex m{moving_motor_count(session.config())}; m < motors.size(); ++m) {
        const auto& board = session.received().motor(m);
        proto::AxisStatus& row = *report.add_boards();
        row = axis_status({motors[m].name, motors[m].steps_per_mm, session.config().ticks_per_second()},
                          board ? &board->state : nullptr, 0);
        row.clear_position_mm();
        row.clear_position_steps();
        row.clear_velocity_mm_s();
        row.clear_homed();
        row.clear_following_error_steps();
        row.set_board(true);
        row.set_present(session.received().motor_present(m));
        name_faults(session, {m}, row);
        add_health(session, m, row);
    }
}

}  // namespace

proto::StatusReport status_report(const Session& session) {
    proto::StatusReport report;
    const MachineConfig& machine = session.config();
    report.set_machine(machine.name);
    if (const auto& received = session.state()) {
        fill(report, received->state, machine);
        report.set_lost_records(received->state.lost_records);
        report.set_participant_reopened(received->state.process.reopened);
        report.set_lost_log_lines(received->state.process.lost_log_lines);
        report.set_age_ms(static_cast<double>((monotonic_now() - received->time).count()) * 1e-6);
    }
    if (auto pause = pause_report(session)) { *report.mutable_pause() = *std::move(pause); }
    report.set_standby(session.has_standby());
    report.set_unsaved_values(session.values().unsaved_since().has_value());
    add_axes(session, report);
    add_motors(session, report);
    add_boards(session, report);
    const auto closed_of = [&](MotorIndex motor) {
        return session.received().motor(motor) ? std::optional(session.received().motor(motor)->state.inputs)
                                               : std::nullopt;
    };
    add_inputs(machine, closed_of, report);
    const auto state_of = [&](MotorIndex motor) {
        return session.received().motor(motor) ? &session.received().motor(motor)->state : nullptr;
    };
    const MachineState* const state = session.state() ? &session.state()->state : nullptr;
    add_homing(machine, session.received().kinematics(), state_of, state, report);
    add_outputs(machine, state_of, state, report);
    return report;
}

proto::FinalPosition place_of(const AxisConfig& axis, std::int64_t count) {
    proto::FinalPosition place;
    place.set_name(axis.name);
    place.set_position_steps(count);
    place.set_position_mm(to_mm(axis, static_cast<double>(count)));
    return place;
}

std::string label_of(const proto::AxisStatus& row) {
    if (row.board()) { return row.name(); }
    if (!row.has_axis()) { return axis_label(row.name()); }
    return is_rotary(row.axis()) ? row.name() + " (deg)" : row.name();
}

std::vector<const proto::AxisStatus*> rows_of(const proto::StatusReport& status) {
    std::vector<const proto::AxisStatus*> rows;
    for (const proto::AxisStatus& axis : status.axes()) { rows.push_back(&axis); }
    for (const proto::AxisStatus& motor : status.motors()) { rows.push_back(&motor); }
    for (const proto::AxisStatus& board : status.boards()) { rows.push_back(&board); }
    return rows;
}

std::vector<const proto::AxisStatus*> process_rows(const proto::StatusReport& status) {
    std::vector<const proto::AxisStatus*> rows = rows_of(status);
    std::erase_if(rows, [&](const proto::AxisStatus* row) {
        return !row->has_axis() && !row->board() &&
               std::ranges::any_of(status.motors(),
                                   [&](const proto::AxisStatus& motor) { return motor.axis() == row->name(); });
    });
    return rows;
}

std::string process_label(const proto::AxisStatus& row) {
    return (row.board() ? "board " : row.has_axis() ? "motor " : "axis ") + row.name();
}

void add_incidents(const MachineSetup& machine, proto::StatusReport& report) {
    const auto files = incident_files(incident_directory(machine));
    if (files.empty()) { return; }
    proto::Incidents& incidents = *report.mutable_incidents();
    incidents.set_directory(incident_directory(machine).string());
    incidents.set_files(static_cast<std::int64_t>(files.size()));
    incidents.set_newest(files.back().filename().string());
}

}  // namespace lockstep
