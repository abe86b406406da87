#include "core/kinematics/motor_limits.hpp"
#include "services/documents/machine_proto.hpp"
#include "services/documents/number_field.hpp"
#include "services/documents/proto_values.hpp"
#include "services/documents/workpiece/workpiece_proto.hpp"

namespace lockstep {
namespace {

void write_timing(const MachineSetup& machine, proto::Timing& message) {
    const ProtocolTiming& timing = machine.timing;
    message.set_slot_us(timing.slot_us);
    message.set_stall_slots(timing.stall_slots);
    message.set_late_check_slots(timing.late_check_slots);
    message.set_freshness_slots(timing.freshness_slots);
    message.set_send_ahead_slots(timing.send_ahead_slots);
    message.set_frame_slots(timing.frame_slots);
    const ProtocolTiming preset;
    if (timing.segment_entries != preset.segment_entries) { message.set_segment_entries(timing.segment_entries); }
    if (timing.output_entries != preset.output_entries) { message.set_output_entries(timing.output_entries); }
    if (timing.jog_hold_us != preset.jog_hold_us) {
        message.set_jog_hold_ms(static_cast<std::int32_t>(timing.jog_hold_us / 1000));
    }
    const bool is_shared = timing.time_source == TimeSource::Shared;
    if (!is_shared) { message.set_time_source(static_cast<proto::TimeSource>(timing.time_source)); }
    if (is_shared && !machine.estimates_clocks()) { return; }  // the limit has no meaning
    message.set_clock_error_limit_us(timing.clock_error_limit_us);
}

void write_network(const NetworkConfig& network, proto::Network& message) {
    message.set_interface(network.interface);
    message.set_domain(network.domain);
    message.set_lcm_url(network.lcm_url);
    for (const std::string& peer : network.peers) { message.add_peers(peer); }
    message.set_one_host(network.one_host);
}

void write_flight(const FlightConfig& flight, proto::Flight& message) {
    message.set_kept(flight.kept);
    message.set_memory_kb(flight.memory_kb);
    message.set_files(flight.files);
}

void write_record(const RecordConfig& record, proto::Record& message) {
    message.set_own_logs(record.own_logs);
    if (!record.directory.empty()) { message.set_directory(record.directory); }
    message.set_size_limit_mb(record.size_limit_mb);
    if (record.flight != FlightConfig{}) { write_flight(record.flight, *message.mutable_flight()); }
}

void write_real_time(const RealTimeConfig& real_time, proto::RealTime& message) {
    message.set_priority(real_time.priority);
    for (const int cpu : real_time.cpus) { message.add_cpus(cpu); }
}

proto::WordRule rule_to_proto(WordRule rule) { return rule == WordRule::Ignore ? proto::IGNORE : proto::REFUSE; }

void write_unassigned(const UnassignedWords& rules, proto::Unassigned& message) {
    message.set_spindle(rule_to_proto(rules.spindle));
    message.set_outputs(rule_to_proto(rules.outputs));
    message.set_inputs(rule_to_proto(rules.inputs));
    message.set_coolant(rule_to_proto(rules.coolant));
    if (rules.tool_change == ToolChange::GoOn) { message.set_tool_change(proto::GO_ON); }
}

void write_web(const WebConfig& web, proto::Web& message) {
    message.set_address(web.address);
    message.set_port(web.port);
    if (!web.certificate_file.empty()) { message.set_certificate_file(web.certificate_file); }
    if (!web.key_file.empty()) { message.set_key_file(web.key_file); }
    for (const std::string& name : web.host_names) { message.add_host_names(name); }
}

void write_homing(const HomingConfig& homing, proto::Homing& message) {
    message.set_sequence(homing.sequence);
    message.set_toward_min(homing.toward_min);
    message.set_search_velocity_mm_s(homing.search_velocity_mm_s);
    message.set_latch_velocity_mm_s(homing.latch_velocity_mm_s);
    message.set_pulloff_mm(homing.pulloff_mm);
    message.set_touch_tolerance_mm(homing.touch_tolerance_mm);
    message.set_switch_position_mm(homing.switch_position_mm);
    message.set_park_mm(homing.park_mm);
    if (homing.way == HomingWay::InPlace) { message.set_in_place(true); }
    if (!homing.input.empty()) { message.set_input(homing.input); }
}

void write_plant(const PlantConfig& plant, proto::Plant& message) {
    message.set_start_position_mm(plant.start_position_mm);
    message.set_travel_margin_mm(plant.travel_margin_mm);
    message.set_max_torque_accel_mm_s2(plant.max_torque_accel_mm_s2);
    message.set_max_jump_mm_s(plant.max_jump_mm_s);
    if (plant.probe_at_mm) { message.set_probe_at_mm(*plant.probe_at_mm); }
}

proto::OutputLevel level_to_proto(bool stays) { return stays ? proto::KEEP : proto::OFF; }

void write_output(const OutputConfig& output, proto::Output& message) {
    message.set_name(output.name);
    output.at_board ? message.set_board(output.motor) : message.set_motor(output.motor);
    message.set_channel(output.channel);
    message.set_use(static_cast<proto::OutputUse>(output.use));
    message.set_number(output.number);
    message.set_inverted(output.inverted);
    message.set_at_interruption(level_to_proto(output.stays_at_interruption));
    message.set_at_fault(level_to_proto(output.stays_at_fault));
    message.set_at_silence(level_to_proto(output.stays_at_silence));
    if (output.makes_pulses()) { message.set_pulse_us(output.pulse_us); }
    if (!output.at_speed.empty()) { message.set_at_speed(output.at_speed); }
    if (output.spin_up_s != 0) { message.set_spin_up_s(output.spin_up_s); }
    if (output.simulated_spin_up_s != 0) { message.set_simulated_spin_up_s(output.simulated_spin_up_s); }
    if (!output.pwm) { return; }
    message.mutable_pwm()->set_hz(output.pwm->hz);
    message.mutable_pwm()->set_full_scale(output.pwm->full_scale);
    message.mutable_pwm()->set_follows_speed(output.pwm->follows_speed);
}

void write_pins(const PinsConfig& pins, proto::Pins& message) {
    message.set_step_width_us(pins.step_width_us);
    message.set_direction_setup_us(pins.direction_setup_us);
    message.set_direction_hold_us(pins.direction_hold_us);
    message.set_enable_wait_ms(pins.enable_wait_ms);
    message.set_step_inverted(pins.step_inverted);
    message.set_direction_inverted(pins.direction_inverted);
    message.set_enable_inverted(pins.enable_inverted);
}

void write_screw(const std::vector<ScrewPoint>& points, proto::Screw& message) {
    for (const ScrewPoint& point : points) {
        proto::ScrewPoint& out = *message.add_point();
        out.set_position_mm(point.position_mm);
        out.set_error_mm(point.error_mm);
    }
}

void write_backlash(const BacklashConfig& backlash, proto::Backlash& message) {
    message.set_mm(backlash.mm);
    if (backlash.speed_mm_s) { message.set_speed_mm_s(*backlash.speed_mm_s); }
}

proto::Method method_to_proto(StepMethod method) { return static_cast<proto::Method>(method); }

void write_motor(const MotorBlock& motor, proto::Motor& message) {
    message.set_name(motor.name);
    if (motor.steps_per_mm) { message.set_steps_per_mm(*motor.steps_per_mm); }
    for (const MotorLimit& limit : kMotorLimits) {
        if (const auto value = motor.*limit.of_block) { set_number(message, limit.key, *value); }
    }
    if (!motor.host.empty()) { message.set_host(motor.host); }
    message.set_device(motor.device.text());
    message.set_switch_offset_mm(motor.switch_offset_mm);
    if (motor.max_following_error_mm) { message.set_max_following_error_mm(*motor.max_following_error_mm); }
    if (motor.correct_following_error_mm) { message.set_correct_following_error_mm(*motor.correct_following_error_mm); }
    if (motor.plant) { write_plant(*motor.plant, *message.mutable_plant()); }
    if (motor.pins) { write_pins(*motor.pins, *message.mutable_pins()); }
    if (!motor.screw.empty()) { write_screw(motor.screw, *message.mutable_screw()); }
    if (motor.backlash) { write_backlash(*motor.backlash, *message.mutable_backlash()); }
}

void write_delta(const DeltaConfig& delta, proto::Delta& message) {
    message.set_x(delta.x);
    message.set_y(delta.y);
    message.set_z(delta.z);
    for (const DeltaTower& tower : delta.towers) {
        proto::Tower& out = *message.add_tower();
        out.set_motor(tower.motor);
        out.set_x_mm(tower.x_mm);
        out.set_y_mm(tower.y_mm);
        out.set_rod_mm(tower.rod_mm);
    }
}

void write_kinematics(const KinematicsConfig& kinematics, proto::Machine& message) {
    if (kinematics.core_xy) {
        proto::CoreXy& core = *message.mutable_kinematics()->mutable_core_xy();
        core.set_first(kinematics.core_xy->first);
        core.set_second(kinematics.core_xy->second);
    }
    for (const MotorRow& motor : kinematics.matrix) {
        proto::MatrixRow& row = *message.mutable_kinematics()->mutable_matrix()->add_row();
        row.set_motor(motor.motor);
        for (const AxisShare& share : motor.of) {
            proto::AxisShare& of = *row.add_of();
            of.set_axis(share.axis);
            of.set_factor(share.factor);
        }
    }
    if (kinematics.delta) { write_delta(*kinematics.delta, *message.mutable_kinematics()->mutable_delta()); }
    for (const Skew& skew : kinematics.skews) {
        proto::Skew& out = *message.add_skew();
        out.set_x(skew.x);
        out.set_y(skew.y);
        out.set_mm_per_m(skew.mm_per_m);
    }
}

void write_board_link(const BoardLinkConfig& board, proto::Board& message) {
    message.set_name(board.name);
    message.set_link(board.link.text());
}

void write_board(const BoardConfig& board, proto::Board& message) {
    message.set_name(board.name);
    if (!board.host.empty()) { message.set_host(board.host); }
    message.set_device(board.device.text());
}

void write_input(const InputConfig& input, proto::Input& message) {
    message.set_name(input.name);
    input.at_board ? message.set_board(input.motor) : message.set_motor(input.motor);
    message.set_channel(input.channel);
    message.set_use(static_cast<proto::InputUse>(input.use));
    message.set_active_low(input.active_low);
    message.set_debounce_ms(input.debounce_ms);
    if (input.number) { message.set_number(*input.number); }
    const bool ends_moves = input.use == InputUse::Probe || input.use == InputUse::Home || input.is_limit_by_message();
    if (!input.axis.empty()) { message.set_axis(input.axis); }
    if (!input.wire.empty()) { message.set_wire(input.wire); }
    if (input.simulated_bounce_ms != 0) { message.set_simulated_bounce_ms(input.simulated_bounce_ms); }
    if (ends_moves) { message.set_max_overshoot_mm(input.max_overshoot_mm); }
    const TouchInMotion touch = input.at_touch_in_motion;
    if (touch != TouchInMotion::Nothing) { message.set_at_touch_in_motion(static_cast<proto::TouchInMotion>(touch)); }
}

void write_axis(const AxisConfig& axis, proto::Axis& message) {
    message.set_name(axis.name);
    if (axis.motors.empty()) { message.set_steps_per_mm(axis.steps_per_mm); }  // otherwise each motor has its own
    for (const MotorLimit& limit : kMotorLimits) { set_number(message, limit.key, axis.*limit.of_axis); }
    message.set_position_min_mm(axis.position_min_mm);
    message.set_position_max_mm(axis.position_max_mm);
    message.set_method(method_to_proto(axis.method));
    if (axis.unhomed_jog_mm_s) { message.set_unhomed_jog_mm_s(*axis.unhomed_jog_mm_s); }
    if (axis.safe_height_mm) { message.set_safe_height_mm(*axis.safe_height_mm); }
    if (axis.max_following_error_mm) { message.set_max_following_error_mm(*axis.max_following_error_mm); }
    if (axis.correct_following_error_mm) { message.set_correct_following_error_mm(*axis.correct_following_error_mm); }
    if (!axis.host.empty()) { message.set_host(axis.host); }
    if (axis.device != AxisConfig{}.device) { message.set_device(axis.device.text()); }
    write_homing(axis.homing, *message.mutable_homing());
    write_plant(axis.plant, *message.mutable_plant());
    if (axis.pins != PinsConfig{}) { write_pins(axis.pins, *message.mutable_pins()); }
    if (!axis.screw.empty()) { write_screw(axis.screw, *message.mutable_screw()); }
    if (axis.backlash) { write_backlash(*axis.backlash, *message.mutable_backlash()); }
    for (const MotorBlock& motor : axis.motors) { write_motor(motor, *message.add_motor()); }
    if (axis.max_skew_mm) { message.set_max_skew_mm(*axis.max_skew_mm); }
}

}  // namespace

proto::Machine machine_to_proto(const MachineSetup& machine) {
    proto::Machine message;
    message.set_name(machine.name);
    message.set_tick_ns(machine.tick_ns);
    write_timing(machine, *message.mutable_timing());
    write_network(machine.network, *message.mutable_network());
    if (machine.security.enabled()) { message.mutable_security()->set_directory(machine.security.directory); }
    if (machine.record != RecordConfig{}) { write_record(machine.record, *message.mutable_record()); }
    if (!machine.position_directory.empty()) { message.set_position_directory(machine.position_directory); }
    if (!machine.coordinator_host.empty()) { message.set_coordinator_host(machine.coordinator_host); }
    if (machine.real_time != RealTimeConfig{}) { write_real_time(machine.real_time, *message.mutable_real_time()); }
    if (machine.unassigned != UnassignedWords{}) {
        write_unassigned(machine.unassigned, *message.mutable_unassigned());
    }
    if (machine.unattended_job == UnattendedJob::IsHeld) { message.set_unattended_job(proto::BE_HELD); }
    if (!machine.subroutine_directory.empty()) { message.set_subroutine_directory(machine.subroutine_directory); }
    if (machine.web) { write_web(*machine.web, *message.mutable_web()); }
    message.set_coordination(method_to_proto(machine.coordination));
    for (const AxisConfig& axis : machine.axes) { write_axis(axis, *message.add_axis()); }
    for (const BoardConfig& board : machine.boards) { write_board(board, *message.add_board()); }
    for (const BoardLinkConfig& board : machine.board_links) { write_board_link(board, *message.add_board()); }
    write_kinematics(machine.kinematics, message);
    for (const OutputConfig& output : machine.outputs) { write_output(output, *message.add_output()); }
    if (!machine.outputs.empty()) { message.set_output_silence_ms(machine.output_silence_ms); }
    for (const InputConfig& input : machine.inputs) { write_input(input, *message.add_input()); }
    if (machine.workpiece) { write_workpiece(*machine.workpiece, *message.mutable_workpiece()); }
    return message;
}

}  // namespace lockstep
