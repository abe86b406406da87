#include "tests/records/machine_run.hpp"

#include <algorithm>
#include <span>
#include <stdexcept>
#include <utility>

#include "core/kinematics/kinematics.hpp"
#include "services/documents/machine_file.hpp"
#include "services/documents/program_file.hpp"

namespace lockstep::records {
namespace {

constexpr Ticks kLongest{300'000'000};
constexpr std::int64_t kLongestSlots = 30'000;
constexpr std::int64_t kReplySlots = 20;

std::string axis_text(const std::string& name, int steps_per_mm, int max_mm) {
    return "axis { name: \"" + name + "\" steps_per_mm: " + std::to_string(steps_per_mm) +
           " start_velocity_mm_s: 10 max_velocity_mm_s: 150 max_accel_mm_s2: 1500 position_min_mm: 0 "
           "position_max_mm: " +
           std::to_string(max_mm) +
           " homing { pulloff_mm: 0.5 latch_velocity_mm_s: 4 switch_position_mm: -0.5 park_mm: 5 } "
           "plant { start_position_mm: 1.5 } }\n";
}

MachineSetup machine_of(const std::string& axes) {
    return parse_machine(
               "name: \"mill\" unassigned { spindle: IGNORE outputs: IGNORE coolant: IGNORE "
               "tool_change: GO_ON }\n" +
               axes)
        .value();
}

}  // namespace

MachineSetup example_machine(const std::string& name) {
    return load_machine_file("deploy/examples/" + name + ".textproto").value();
}

MachineSetup small_mill() {
    return machine_of(axis_text("X", 80, 200) + axis_text("Y", 80, 200) + axis_text("Z", 100, 60));
}

MachineSetup small_plotter() { return machine_of(axis_text("X", 80, 200) + axis_text("Y", 80, 200)); }

MachineSetup small_laser() {
    MachineSetup machine = small_plotter();
    machine.outputs = {{.name = "laser",
                        .motor = "X",
                        .use = OutputUse::Spindle,
                        .pwm = PwmConfig{.hz = 5000, .full_scale = 1000, .follows_speed = true},
                        .stays_at_interruption = false},
                       {.name = "valve", .motor = "Y", .number = 1}};
    return machine;
}

MachineSetup with_camera(MachineSetup machine) {
    machine.outputs.push_back(
        {.name = "camera", .motor = "Y", .channel = 2, .use = OutputUse::Places, .number = 0, .pulse_us = 50});
    return machine;
}

MachineSetup small_core_xy() {
    MachineSetup machine = small_mill();
    for (AxisConfig& axis : std::span(machine.axes).first(2)) {
        axis.homing.way = HomingWay::InPlace;
        axis.plant.start_position_mm = axis.homing.park_mm;
        axis.motors = {{.name = axis.name, .steps_per_mm = axis.steps_per_mm}};
    }
    machine.kinematics.core_xy = CoreXy{"X", "Y"};
    return read_again(machine);
}

MachineSetup small_gantry() {
    MachineSetup machine = small_plotter();
    AxisConfig& bridge = machine.axes[0];
    bridge.max_skew_mm = 2;
    bridge.homing.park_mm = 0;
    bridge.motors = {{.name = "X", .steps_per_mm = 80},
                     {.name = "X2", .steps_per_mm = 80, .switch_offset_mm = 0.25, .plant = bridge.plant}};
    bridge.motors[1].plant->start_position_mm += 0.3;
    return read_again(machine);
}

MachineSetup read_again(const MachineSetup& machine) { return parse_machine(machine_text(machine)).value(); }

MachineSetup slow_axis_machine() {
    return parse_machine(
               "name: \"slow\" tick_ns: 100000 axis { name: \"X\" steps_per_mm: 1000 start_velocity_mm_s: "
               "0.78 max_velocity_mm_s: 4 max_accel_mm_s2: 20 position_min_mm: 0 position_max_mm: 50 "
               "homing { pulloff_mm: 0.1 park_mm: 0.5 } plant { start_position_mm: 0.2 } }")
        .value();
}

VirtualOptions options_of(const MachineSetup& machine) {
    return {.machine = machine, .config_hash = config_hash(machine)};
}

VirtualOptions own_clocks(MachineSetup machine) {
    machine.timing.time_source = TimeSource::Network;
    VirtualOptions options = options_of(machine);
    options.start = Tick{20'000'000};
    options.clocks = {{.process = {.offset = {5'000'000}, .ppm = 90}, .device = {.offset = {9'000'000}, .ppm = -70}},
                      {.process = {.offset = {-4'000'000}, .ppm = -60}, .device = {.offset = {123}, .ppm = 100}}};
    return options;
}

MachineRun::MachineRun(const VirtualOptions& options) : vm_(options), recorder_(vm_, sink_) {
    reach(MachinePhase::Idle);
}

void MachineRun::await(const std::function<bool()>& done, const std::string& what) {
    if (!vm_.advance_until(done, std::max(kLongest, slots(kLongestSlots)))) {
        throw std::runtime_error("the machine never " + what);
    }
}

void MachineRun::reach(MachinePhase phase) {
    await([&] { return is(phase); }, "came to phase " + std::to_string(static_cast<int>(phase)));
}

void MachineRun::to_rest() {
    await([&] { return is(MachinePhase::Idle) || is(MachinePhase::Fault); }, "came to rest");
}

void MachineRun::require_success(const std::string& what) const {
    const MachineState& state = *vm_.state();
    const FaultCode fault = state.fault != FaultCode::None ? state.fault : state.job_fault;
    if (is(MachinePhase::Idle) && fault == FaultCode::None) { return; }
    const FaultText* text = find_fault(fault);
    throw std::runtime_error(what + " failed: " + (text != nullptr ? std::string(text->name) : "no fault"));
}

void MachineRun::wait_ms(std::int64_t ms) {
    vm_.advance_until([] { return false; }, Ticks{ms * 1'000'000 / vm_.machine().tick_ns});
}

void MachineRun::command(CommandKind kind, std::uint64_t program, AxisSet axes) {
    const std::uint64_t sequence = vm_.command(kind, axes, program);
    for (int tries = 0; tries < 50; ++tries, vm_.repeat_command()) {
        if (!vm_.advance_until([&] { return vm_.reply_to(sequence) != nullptr; }, slots(kReplySlots))) { continue; }
        const Reply reply = *vm_.reply_to(sequence);
        if (reply.status == ReplyStatus::Refused) { throw std::runtime_error("a command is refused: " + reply.text); }
        const Tick answered = vm_.now();  // the state shows the effect of the command after this
        return await([&] { return vm_.state()->tick > answered; }, "published a state");
    }
    throw std::runtime_error("a command is not answered");
}

void MachineRun::set_overrides(const Overrides& overrides) {
    const std::uint64_t sequence = vm_.set_overrides(overrides);
    await([&] { return vm_.reply_to(sequence) != nullptr; }, "answered an override");
}

void MachineRun::hold() {
    command(CommandKind::Hold);
    reach(MachinePhase::Holding);
    wait_ms(400);
}

void MachineRun::reset() {
    command(CommandKind::Reset);
    reach(MachinePhase::Idle);
}

void MachineRun::resume() { command(CommandKind::Resume); }

void MachineRun::return_and_resume() {
    const Command back{.client = 3, .sequence = ++jogs_, .kind = CommandKind::Resume, .returns = true};
    for (int tries = 0; tries < 50 && !is(MachinePhase::Running); ++tries) {
        vm_.send(back);
        wait_ms(10);
    }
    if (!is(MachinePhase::Running)) { throw std::runtime_error("the axes do not return"); }
}

void MachineRun::home() { home({}); }

void MachineRun::home(AxisSet axes) {
    command(CommandKind::Home, 0, axes);
    to_rest();
    require_success("homing");
}

std::vector<double> MachineRun::here_mm() const {
    MotorCounts motors;
    for (const auto& motor : vm_.axis_states()) { motors.steps.append(motor->position.count()); }
    const AxisCounts axes = Kinematics(vm_.machine()).axes_at(motors);
    std::vector<double> here;
    for (std::size_t i = 0; i < axes.size(); ++i) {
        here.push_back(to_mm(vm_.machine().axes[i], static_cast<double>(axes[i])));
    }
    return here;
}

Program MachineRun::program_of(std::string_view gcode) const {
    auto program = parse_gcode(gcode, gcode_setup(vm_.machine(), here_mm(), "part.gcode"));
    if (!program) { throw std::runtime_error("a program is refused: " + program.error().front().message); }
    return std::move(*program);
}

void MachineRun::begin_job(CommandKind kind) {
    const std::uint64_t before = vm_.state()->job;
    command(kind, programs_);
    await([&] { return vm_.state()->job > before; }, "began the job");
}

void MachineRun::begin(std::string_view gcode) { begin(program_of(gcode)); }

void MachineRun::begin(const Program& program) {
    vm_.give_program(++programs_, program);
    begin_job(CommandKind::Run);
}

void MachineRun::run(std::string_view gcode) { run(program_of(gcode)); }

void MachineRun::run(const Program& program) {
    begin(program);
    while (true) {
        await([&] { return is(MachinePhase::Idle) || is(MachinePhase::Fault) || is(MachinePhase::Paused); },
              "came to rest");
        if (!is(MachinePhase::Paused)) { return; }
        resume();
    }
}

void MachineRun::run_in_parts(std::string_view gcode, std::size_t blocks) {
    const Program program = program_of(gcode);
    ++programs_;
    std::uint32_t index = 0;
    for (std::size_t at = 0; at < program.blocks.size(); at += blocks, ++index) {
        const std::size_t end = std::min(at + blocks, program.blocks.size());
        ProgramPart part{.program = programs_, .index = index, .is_last = end == program.blocks.size()};
        if (index == 0) { part.head = program.head(); }
        part.blocks.assign(program.blocks.begin() + static_cast<std::ptrdiff_t>(at),
                           program.blocks.begin() + static_cast<std::ptrdiff_t>(end));
        const std::uint64_t sequence = vm_.send(std::move(part));
        await([&] { return vm_.reply_to(sequence) != nullptr; }, "answered a part");
        if (index == 0) { command(CommandKind::Run, programs_); }
    }
    to_rest();
}

void MachineRun::move(std::string_view gcode) {
    vm_.give_program(++programs_, program_of(gcode));
    begin_job(CommandKind::Move);
    to_rest();
}

void MachineRun::begin_own(std::string_view gcode) {
    vm_.give_program(++programs_, program_of(gcode));
    begin_job(CommandKind::MoveOwn);
}

void MachineRun::move(const MoveOptions& move) {
    auto program = move_program(vm_.machine(), here_mm(), move);
    if (!program) { throw std::runtime_error("a move is refused: " + program.error()); }
    vm_.give_program(++programs_, *program);
    begin_job(move.own ? CommandKind::MoveOwn : CommandKind::Move);
    to_rest();
    require_success("a move");
}

void MachineRun::move_own(std::string_view gcode) {
    begin_own(gcode);
    to_rest();
}

void MachineRun::jog(std::uint32_t axis, double speed_mm_s, std::int64_t ms) {
    Command held{.client = 2, .sequence = ++jogs_, .kind = CommandKind::Jog};
    held.jogs = {{.axis = AxisIndex{axis}, .speed_mm_s = speed_mm_s}};
    for (; ms > 0; ms -= 10) {
        vm_.send(held);
        wait_ms(10);
    }
    wait_ms(300);
    await([&] { return is(MachinePhase::Idle) || is(MachinePhase::Fault) || is(MachinePhase::Paused); },
          "came to rest");
}

void MachineRun::restart(std::size_t process, std::int64_t ms) {
    vm_.schedule({.kind = VirtualFault::Kind::Crash, .process = process, .at = vm_.now(), .lasts = Ticks{ms * 1000}});
}

Record MachineRun::finish() {
    recorder_.finish();
    return std::move(sink_.record);
}

}  // namespace lockstep::records
