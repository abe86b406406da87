#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/kinematics/axis_steps.hpp"
#include "core/kinematics/motors.hpp"
#include "services/documents/machine_proto.hpp"
#include "services/documents/number_field.hpp"
#include "services/documents/proto_reader.hpp"
#include "services/documents/proto_values.hpp"
#include "services/documents/rules/axis_ranges.hpp"
#include "services/documents/workpiece/workpiece_proto.hpp"

namespace lockstep {
namespace {

constexpr double kDefaultLatchShare = 0.2;  // of the search velocity
constexpr double kDefaultPulloff_mm = 2;
constexpr double kDefaultTouchTolerance_mm = 0.02;
constexpr double kDefaultPulloffShare = 0.1;  // of the travel, if that is less
constexpr double kDefaultTravelMargin_mm = 2;
constexpr const char* kMethodNames = "RANADE, SPIELAUER, LAI, LAM and CARRICA";
constexpr double kDefaultPlantReserve = 1.5;  // the motor's capability over the axis's limits

ProtocolTiming read_timing(const proto::Timing& message) {
    const ProtocolTiming preset;
    ProtocolTiming timing{
        .slot_us = message.has_slot_us() ? message.slot_us() : preset.slot_us,
        .stall_slots = message.has_stall_slots() ? message.stall_slots() : preset.stall_slots,
        .late_check_slots = message.has_late_check_slots() ? message.late_check_slots() : preset.late_check_slots,
        .freshness_slots = message.has_freshness_slots() ? message.freshness_slots() : preset.freshness_slots,
        .send_ahead_slots = message.has_send_ahead_slots() ? message.send_ahead_slots() : preset.send_ahead_slots,
        .frame_slots = message.has_frame_slots() ? message.frame_slots() : preset.frame_slots,
        .time_source = value_of<TimeSource>(message.time_source()),
    };
    if (message.has_segment_entries()) { timing.segment_entries = message.segment_entries(); }
    if (message.has_output_entries()) { timing.output_entries = message.output_entries(); }
    if (message.has_jog_hold_ms()) { timing.jog_hold_us = std::int64_t{message.jog_hold_ms()} * 1000; }
    timing.clock_error_limit_us =
        message.has_clock_error_limit_us() ? message.clock_error_limit_us() : timing.most_clock_error_us();
    return timing;
}

NetworkConfig read_network(const proto::Network& message) {
    const NetworkConfig preset;
    return {
        .interface = message.has_interface() ? message.interface() : preset.interface,
        .domain = message.has_domain() ? message.domain() : preset.domain,
        .lcm_url = message.has_lcm_url() ? message.lcm_url() : preset.lcm_url,
        .peers = {message.peers().begin(), message.peers().end()},
        .one_host = message.one_host(),
    };
}

FlightConfig read_flight(const proto::Flight& message) {
    const FlightConfig preset;
    return {
        .kept = message.has_kept() ? message.kept() : preset.kept,
        .memory_kb = message.has_memory_kb() ? message.memory_kb() : preset.memory_kb,
        .files = message.has_files() ? message.files() : preset.files,
    };
}

RecordConfig read_record(const proto::Record& message) {
    const RecordConfig preset;
    return {
        .own_logs = message.has_own_logs() ? message.own_logs() : preset.own_logs,
        .directory = message.directory(),
        .size_limit_mb = message.has_size_limit_mb() ? message.size_limit_mb() : preset.size_limit_mb,
        .flight = read_flight(message.flight()),
    };
}

/// A security block without content must not mean that security is off.
SecurityConfig read_security(const proto::Machine& message, ProtoReader reader) {
    SecurityConfig security;
    if (!message.has_security()) { return security; }
    reader.require(!message.security().directory().empty(), message.security().directory(), security.directory,
                   "security.directory");
    return security;
}

RealTimeConfig read_real_time(const proto::RealTime& message) {
    return {.priority = message.priority(), .cpus = {message.cpus().begin(), message.cpus().end()}};
}

WordRule read_rule(bool is_given, proto::WordRule rule, WordRule preset, const std::string& key, ProtoReader& reader) {
    if (!is_given) { return preset; }
    if (!proto::WordRule_IsValid(rule)) {
        reader.refuse(key, fmt::format("{} is {}; it must be REFUSE or IGNORE", key, int{rule}));
    }
    return rule == proto::IGNORE ? WordRule::Ignore : WordRule::Refuse;
}

ToolChange read_tool_change(const proto::Unassigned& message, ToolChange preset, ProtoReader& reader) {
    if (!message.has_tool_change()) { return preset; }
    if (!proto::ToolChange_IsValid(message.tool_change())) {
        const std::string key = "unassigned.tool_change";
        reader.refuse(key, fmt::format("{} is {}; it must be PAUSE or GO_ON", key, int{message.tool_change()}));
    }
    return message.tool_change() == proto::GO_ON ? ToolChange::GoOn : ToolChange::Pause;
}

UnassignedWords read_unassigned(const proto::Unassigned& message, ProtoReader reader) {
    const UnassignedWords preset;
    return {
        .spindle = read_rule(message.has_spindle(), message.spindle(), preset.spindle, "unassigned.spindle", reader),
        .outputs = read_rule(message.has_outputs(), message.outputs(), preset.outputs, "unassigned.outputs", reader),
        .inputs = read_rule(message.has_inputs(), message.inputs(), preset.inputs, "unassigned.inputs", reader),
        .coolant = read_rule(message.has_coolant(), message.coolant(), preset.coolant, "unassigned.coolant", reader),
        .tool_change = read_tool_change(message, preset.tool_change, reader),
    };
}

std::optional<WebConfig> read_web(const proto::Machine& message) {
    if (!message.has_web()) { return std::nullopt; }
    const proto::Web& web = message.web();
    const WebConfig preset;
    return WebConfig{
        .address = web.has_address() ? web.address() : preset.address,
        .port = web.has_port() ? web.port() : preset.port,
        .certificate_file = web.certificate_file(),
        .key_file = web.key_file(),
        .host_names = {web.host_names().begin(), web.host_names().end()},
    };
}

/// Does not use std::clamp, because it requires ordered limits and a file may have them in the wrong order.
double nearest_in_travel(const AxisConfig& axis, double mm) {
    return std::min(std::max(mm, axis.position_min_mm), axis.position_max_mm);
}

double place_behind_pulloff(const HomingConfig& homing, const AxisConfig& axis) {
    const double pulloff = homing.toward_min ? homing.pulloff_mm : -homing.pulloff_mm;
    return nearest_in_travel(axis, homing.switch_position_mm + pulloff);
}

/// 0, unless the axis would then cross most of its travel after homing, as a Z that homes at the top would. Then beside
/// the switch. `homing` has all other values.
double usual_park(const HomingConfig& homing, const AxisConfig& axis) {
    const double zero = nearest_in_travel(axis, 0);
    const double middle = (axis.position_min_mm + axis.position_max_mm) / 2;
    if (homing.toward_min ? zero <= middle : zero >= middle) { return zero; }
    return place_behind_pulloff(homing, axis);
}

/// 0 if the file has no valid scale.
double step_mm(const AxisConfig& axis) { return axis.steps_per_mm > 0 ? 1 / axis.steps_per_mm : 0; }

HomingConfig read_homing(const proto::Homing& message, const AxisConfig& axis, bool has_several_motors) {
    const double travel = axis.position_max_mm - axis.position_min_mm;
    HomingConfig homing;
    homing.sequence = message.sequence();
    homing.way = message.in_place()        ? HomingWay::InPlace
                 : message.input().empty() ? HomingWay::BySwitch
                                           : HomingWay::ByTouch;
    homing.input = message.input();
    homing.toward_min = message.has_toward_min() ? message.toward_min() : homing.toward_min;
    homing.search_velocity_mm_s =
        message.has_search_velocity_mm_s() ? message.search_velocity_mm_s() : axis.start_velocity_mm_s;
    homing.latch_velocity_mm_s =
        message.has_latch_velocity_mm_s()
            ? message.latch_velocity_mm_s()
            : std::max(homing.search_velocity_mm_s * kDefaultLatchShare, axis_ranges::kMinSpeed_mm_s);
    homing.pulloff_mm = message.has_pulloff_mm()
                            ? message.pulloff_mm()
                            : std::max(std::min(kDefaultPulloff_mm, travel * kDefaultPulloffShare), step_mm(axis));
    homing.touch_tolerance_mm = message.has_touch_tolerance_mm()
                                    ? message.touch_tolerance_mm()
                                    : std::min(kDefaultTouchTolerance_mm, homing.pulloff_mm / 2);
    homing.switch_position_mm = message.has_switch_position_mm() ? message.switch_position_mm()
                                : homing.toward_min              ? axis.position_min_mm
                                                                 : axis.position_max_mm;
    homing.park_mm = message.has_park_mm() ? message.park_mm()
                     : has_several_motors  ? place_behind_pulloff(homing, axis)
                                           : usual_park(homing, axis);
    return homing;
}

PlantConfig read_plant(const proto::Plant& message, const AxisConfig& axis) {
    const double hardest = std::max(axis.max_accel_mm_s2, axis.max_decel_mm_s2);
    return {
        .start_position_mm = message.has_start_position_mm() ? message.start_position_mm()
                                                             : (axis.position_min_mm + axis.position_max_mm) / 2,
        .travel_margin_mm = message.has_travel_margin_mm() ? message.travel_margin_mm() : kDefaultTravelMargin_mm,
        .max_torque_accel_mm_s2 = message.has_max_torque_accel_mm_s2()
                                      ? message.max_torque_accel_mm_s2()
                                      : std::min(kDefaultPlantReserve * hardest, axis_ranges::kMaxAccel_mm_s2),
        .max_jump_mm_s = message.has_max_jump_mm_s()
                             ? message.max_jump_mm_s()
                             : std::min(kDefaultPlantReserve * axis.start_velocity_mm_s, axis_ranges::kMaxSpeed_mm_s),
        .probe_at_mm = message.has_probe_at_mm() ? std::optional(message.probe_at_mm()) : std::nullopt,
    };
}

PinsConfig read_pins(const proto::Pins& message) {
    return {.step_width_us = message.step_width_us(),
            .direction_setup_us = message.direction_setup_us(),
            .direction_hold_us = message.direction_hold_us(),
            .enable_wait_ms = message.enable_wait_ms(),
            .step_inverted = message.step_inverted(),
            .direction_inverted = message.direction_inverted(),
            .enable_inverted = message.enable_inverted()};
}

std::vector<ScrewPoint> read_screw(const proto::Screw& message, const std::string& place, ProtoReader& reader) {
    std::vector<ScrewPoint> points;
    for (int k = 0; k < message.point_size(); ++k) {
        const proto::ScrewPoint& from = message.point(k);
        const std::string at = fmt::format("{}.point[{}]", place, k);
        ScrewPoint& point = points.emplace_back();
        reader.require(from.has_position_mm(), from.position_mm(), point.position_mm, at + ".position_mm");
        reader.require(from.has_error_mm(), from.error_mm(), point.error_mm, at + ".error_mm");
    }
    return points;
}

BacklashConfig read_backlash(const proto::Backlash& message, const std::string& place, ProtoReader& reader) {
    BacklashConfig backlash;
    reader.require(message.has_mm(), message.mm(), backlash.mm, place + ".mm");
    if (message.has_speed_mm_s()) { backlash.speed_mm_s = message.speed_mm_s(); }
    return backlash;
}

std::string method_name(proto::Method method) {
    return proto::Method_IsValid(method) ? proto::Method_Name(method) : std::to_string(method);
}

/// Nullopt if neither it nor the key that stands in for it is given.
std::optional<double> limit_in(const google::protobuf::Message& message, const MotorLimit& limit) {
    const auto given = number_in(message, limit.key);
    return given || limit.otherwise.empty() ? given : number_in(message, limit.otherwise);
}

MotorBlock read_motor(const proto::Motor& message, const AxisConfig& axis, const std::string& place,
                      ProtoReader& reader) {
    MotorBlock motor;
    reader.require(message.has_name(), message.name(), motor.name, place + ".name");
    motor.host = message.has_host() ? message.host() : axis.host;
    motor.device = message.has_device() ? read_device(message.device(), place + ".device", reader) : axis.device;
    motor.steps_per_mm = message.has_steps_per_mm() ? message.steps_per_mm() : axis.steps_per_mm;
    for (const MotorLimit& limit : kMotorLimits) { motor.*limit.of_block = limit_in(message, limit); }
    motor.switch_offset_mm = message.switch_offset_mm();
    if (message.has_max_following_error_mm()) { motor.max_following_error_mm = message.max_following_error_mm(); }
    if (message.has_correct_following_error_mm()) {
        motor.correct_following_error_mm = message.correct_following_error_mm();
    }
    if (message.has_plant()) { motor.plant = read_plant(message.plant(), axis); }
    if (message.has_pins()) { motor.pins = read_pins(message.pins()); }
    motor.screw = read_screw(message.screw(), place + ".screw", reader);
    if (message.has_backlash()) { motor.backlash = read_backlash(message.backlash(), place + ".backlash", reader); }
    return motor;
}

void read_motors(const proto::Axis& message, AxisConfig& axis, ProtoReader& reader) {
    bool all_have_steps = message.motor_size() > 0;
    for (int k = 0; k < message.motor_size(); ++k) {
        axis.motors.push_back(read_motor(message.motor(k), axis, fmt::format("motor[{}]", k), reader));
        all_have_steps = all_have_steps && message.motor(k).has_steps_per_mm();
    }
    if (message.has_max_skew_mm()) { axis.max_skew_mm = message.max_skew_mm(); }
    if (!all_have_steps) {
        reader.require(message.has_steps_per_mm(), message.steps_per_mm(), axis.steps_per_mm, "steps_per_mm");
    }
    const bool needs_skew = message.motor_size() > 1;
    double skew = 0;
    if (needs_skew) { reader.require(message.has_max_skew_mm(), message.max_skew_mm(), skew, "max_skew_mm"); }
}

DeltaConfig read_delta(const proto::Delta& message, ProtoReader& reader) {
    DeltaConfig delta;
    reader.require(message.has_x(), message.x(), delta.x, "kinematics.delta.x");
    reader.require(message.has_y(), message.y(), delta.y, "kinematics.delta.y");
    reader.require(message.has_z(), message.z(), delta.z, "kinematics.delta.z");
    for (int k = 0; k < message.tower_size(); ++k) {
        const proto::Tower& from = message.tower(k);
        const std::string place = fmt::format("kinematics.delta.tower[{}]", k);
        DeltaTower& tower = delta.towers.emplace_back();
        reader.require(from.has_motor(), from.motor(), tower.motor, place + ".motor");
        reader.require(from.has_x_mm(), from.x_mm(), tower.x_mm, place + ".x_mm");
        reader.require(from.has_y_mm(), from.y_mm(), tower.y_mm, place + ".y_mm");
        reader.require(from.has_rod_mm(), from.rod_mm(), tower.rod_mm, place + ".rod_mm");
    }
    return delta;
}

KinematicsConfig read_kinematics(const proto::Machine& message, ProtoReader reader) {
    KinematicsConfig kinematics;
    if (message.kinematics().has_core_xy()) {
        const proto::CoreXy& core = message.kinematics().core_xy();
        kinematics.core_xy.emplace();
        reader.require(core.has_first(), core.first(), kinematics.core_xy->first, "kinematics.core_xy.first");
        reader.require(core.has_second(), core.second(), kinematics.core_xy->second, "kinematics.core_xy.second");
    }
    for (int r = 0; r < message.kinematics().matrix().row_size(); ++r) {
        const proto::MatrixRow& row = message.kinematics().matrix().row(r);
        const std::string place = fmt::format("kinematics.matrix.row[{}]", r);
        MotorRow& motor = kinematics.matrix.emplace_back();
        reader.require(row.has_motor(), row.motor(), motor.motor, place + ".motor");
        for (int k = 0; k < row.of_size(); ++k) {
            AxisShare& share = motor.of.emplace_back();
            const std::string of = fmt::format("{}.of[{}]", place, k);
            reader.require(row.of(k).has_axis(), row.of(k).axis(), share.axis, of + ".axis");
            reader.require(row.of(k).has_factor(), row.of(k).factor(), share.factor, of + ".factor");
        }
    }
    if (message.kinematics().has_delta()) { kinematics.delta = read_delta(message.kinematics().delta(), reader); }
    for (int k = 0; k < message.skew_size(); ++k) {
        const std::string place = fmt::format("skew[{}]", k);
        Skew& skew = kinematics.skews.emplace_back();
        reader.require(message.skew(k).has_x(), message.skew(k).x(), skew.x, place + ".x");
        reader.require(message.skew(k).has_y(), message.skew(k).y(), skew.y, place + ".y");
        reader.require(message.skew(k).has_mm_per_m(), message.skew(k).mm_per_m(), skew.mm_per_m, place + ".mm_per_m");
    }
    return kinematics;
}

AxisConfig read_axis(const proto::Axis& message, ProtoReader reader) {
    AxisConfig axis;
    reader.require(message.has_name(), message.name(), axis.name, "name");
    axis.steps_per_mm = message.steps_per_mm();
    for (const MotorLimit& limit : kMotorLimits) {
        const auto given = limit_in(message, limit);
        reader.require(given || !limit.otherwise.empty(), given.value_or(0), axis.*limit.of_axis,
                       std::string(limit.key));
    }
    reader.require(message.has_position_min_mm(), message.position_min_mm(), axis.position_min_mm, "position_min_mm");
    reader.require(message.has_position_max_mm(), message.position_max_mm(), axis.position_max_mm, "position_max_mm");
    if (!proto::Method_IsValid(message.method())) {  // protobuf accepts any number for an enumeration
        reader.refuse("method", fmt::format("method is {}; it must be one of {}", int{message.method()}, kMethodNames));
    }
    axis.method = value_of<StepMethod>(message.method());
    if (message.has_unhomed_jog_mm_s()) { axis.unhomed_jog_mm_s = message.unhomed_jog_mm_s(); }
    if (message.has_safe_height_mm()) { axis.safe_height_mm = message.safe_height_mm(); }
    if (message.has_max_following_error_mm()) { axis.max_following_error_mm = message.max_following_error_mm(); }
    if (message.has_correct_following_error_mm()) {
        axis.correct_following_error_mm = message.correct_following_error_mm();
    }
    axis.host = message.host();
    axis.device = read_device(message.device(), "device", reader);
    axis.homing = read_homing(message.homing(), axis, message.motor_size() > 1);
    axis.plant = read_plant(message.plant(), axis);
    axis.pins = read_pins(message.pins());
    axis.screw = read_screw(message.screw(), "screw", reader);
    if (message.has_backlash()) { axis.backlash = read_backlash(message.backlash(), "backlash", reader); }
    read_motors(message, axis, reader);
    return axis;
}

}  // namespace

MachineDraft machine_from_proto(const proto::Machine& message) {
    MachineDraft draft;
    ProtoReader(draft.missing).require(message.has_name(), message.name(), draft.machine.name, "name");
    draft.machine.tick_ns = message.has_tick_ns() ? message.tick_ns() : draft.machine.tick_ns;
    draft.machine.timing = read_timing(message.timing());
    if (!proto::TimeSource_IsValid(message.timing().time_source())) {
        ProtoReader(draft.missing)
            .refuse("timing.time_source", fmt::format("timing.time_source is {}; it must be SHARED, NETWORK or PTP",
                                                      int{message.timing().time_source()}));
    }
    draft.machine.network = read_network(message.network());
    draft.machine.security = read_security(message, ProtoReader(draft.missing));
    draft.machine.record = read_record(message.record());
    draft.machine.position_directory = message.position_directory();
    draft.machine.coordinator_host = message.coordinator_host();
    draft.machine.real_time = read_real_time(message.real_time());
    draft.machine.unassigned = read_unassigned(message.unassigned(), ProtoReader(draft.missing));
    if (!proto::UnattendedJob_IsValid(message.unattended_job())) {
        ProtoReader(draft.missing)
            .refuse("unattended_job",
                    fmt::format("unattended_job is {}; it must be RUN_ON or BE_HELD", int{message.unattended_job()}));
    }
    const bool is_held = message.unattended_job() == proto::BE_HELD;
    draft.machine.unattended_job = is_held ? UnattendedJob::IsHeld : UnattendedJob::RunsOn;
    draft.machine.subroutine_directory = message.subroutine_directory();
    draft.machine.web = read_web(message);
    draft.machine.coordination = value_of<StepMethod>(message.coordination());
    const bool coordinates = message.coordination() == proto::RANADE || message.coordination() == proto::LAI;
    if (!coordinates) {
        ProtoReader(draft.missing)
            .refuse("coordination", "coordination is " + method_name(message.coordination()) +
                                        "; only RANADE and LAI can move several axes together");
    }
    for (const proto::Axis& axis : message.axis()) {
        draft.machine.axes.push_back(read_axis(axis, ProtoReader(draft.missing, draft.machine.axes.size())));
    }
    draft.machine.kinematics = read_kinematics(message, ProtoReader(draft.missing));
    read_devices(message, draft);
    if (message.has_workpiece()) {
        draft.machine.workpiece = read_workpiece(message.workpiece(), ProtoReader(draft.missing));
    }
    set_steps_of_axes(draft.machine);
    draft.machine.network.processes = motor_count(draft.machine) + 1;  // the coordinator
    return draft;
}

}  // namespace lockstep
