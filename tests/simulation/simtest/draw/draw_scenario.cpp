#include <algorithm>

#include "tests/simulation/simtest/draw/draw_bounces.hpp"
#include "tests/simulation/simtest/draw/draw_close_probes.hpp"
#include "tests/simulation/simtest/draw/draw_encoders.hpp"
#include "tests/simulation/simtest/draw/draw_fault.hpp"
#include "tests/simulation/simtest/draw/draw_inputs.hpp"
#include "tests/simulation/simtest/draw/draw_jogs.hpp"
#include "tests/simulation/simtest/draw/draw_machine.hpp"
#include "tests/simulation/simtest/draw/draw_outputs.hpp"
#include "tests/simulation/simtest/draw/draw_plant_fault.hpp"
#include "tests/simulation/simtest/draw/draw_probes.hpp"
#include "tests/simulation/simtest/draw/draw_program.hpp"
#include "tests/simulation/simtest/draw/draw_stream.hpp"
#include "tests/simulation/simtest/draw/draw_takeover.hpp"
#include "tests/simulation/simtest/draw/machine/draw_backlash.hpp"
#include "tests/simulation/simtest/draw/machine/draw_delta.hpp"
#include "tests/simulation/simtest/draw/machine/draw_late_devices.hpp"
#include "tests/simulation/simtest/draw/machine/draw_motors.hpp"
#include "tests/simulation/simtest/draw/machine/draw_rings.hpp"
#include "tests/simulation/simtest/draw/machine/draw_screws.hpp"
#include "tests/simulation/simtest/draw/machine/draw_touches.hpp"
#include "tests/simulation/simtest/draw/scenario.hpp"
#include "tests/simulation/simtest/record/motor_shares.hpp"

namespace lockstep::simtest {
namespace {

/// A hop takes two slots: up to half a slot until the sender's loop, one on the link, up to half until the receiver's.
NetworkBehaviour draw_network(Draw& draw, const FaultKinds& faults, Ticks slot) {
    const auto part_of_slot = [&](double most) {
        return Ticks{1 + static_cast<std::int64_t>(draw.part() * most * static_cast<double>(slot.value - 1))};
    };
    NetworkBehaviour network;
    network.delay_min = faults.delay ? part_of_slot(1) : Ticks{1 + slot.value / 50};
    network.delay_max = network.delay_min;
    if (faults.clock) { slot = {std::max<std::int64_t>(2, slot.value / 8)}; }  // the clocks use the rest of a hop
    if (faults.delay && faults.clock) { network.delay_min = network.delay_max = part_of_slot(1); }
    if (faults.reorder) {
        network.delay_max = std::max(network.delay_min, part_of_slot(1));
        if (draw.chance(0.5)) { network.delay_min = Ticks{1}; }
    }
    if (faults.duplicate) { network.duplicated = draw.magnitude(0.01, 0.8); }
    if (faults.loss) { network.lost = draw.magnitude(0.001, 0.05); }
    if (faults.corrupt) { network.corrupted = draw.magnitude(0.0003, 0.01); }
    return network;
}

/// A program that starts where no axis can be.
Program elsewhere(Program program, const MachineConfig& machine) {
    const MotorShares motors(machine);
    for (const std::string& name : program.axes) {
        const auto axis = std::ranges::find(machine.axes, name, &AxisConfig::name);
        const double step_of_motor = motors.step_of(static_cast<std::size_t>(axis - machine.axes.begin()));
        program.start_mm.push_back(axis->position_max_mm + 10 * step_of_motor / axis->steps_per_mm);
    }
    return program;
}

WrongCommand wrong_when_idle(Draw& draw, const MachineConfig& machine) {
    const std::size_t i = draw.index(machine.axes.size());
    const AxisConfig& axis = machine.axes[i];
    Program program{.name = "wrong", .axes = {axis.name}, .start_mm = {}, .blocks = {}};
    const double step = MotorShares(machine).step_of(i) / axis.steps_per_mm;  // of a motor
    switch (draw.index(8)) {
        case 0: return {CommandKind::Hold, {}, FaultCode::NothingToDo};
        case 1: return {CommandKind::Resume, {}, FaultCode::NothingToDo};
        case 2: return {CommandKind::Stop, {}, FaultCode::NothingToDo};
        case 3: return {CommandKind::Run, {}, FaultCode::UnknownProgram};
        case 4: program.axes = {"none"}; return {CommandKind::Run, program, FaultCode::BadProgram};
        case 5: program.blocks = {{1, ProgramMove{{axis.position_max_mm + 1.5 * step}, 0, true}}}; break;
        case 6: program.blocks = {{1, ProgramMove{{axis.position_min_mm - 1.5 * step}, 0, true}}}; break;
        default: return {CommandKind::Run, elsewhere(program, machine), FaultCode::StartMismatch};
    }
    return {CommandKind::Run, program, FaultCode::OutsideTravel};
}

WrongCommand wrong_in_motion(Draw& draw, const MachineConfig& machine) {
    switch (draw.index(5)) {
        case 0: return {CommandKind::Home, {}, FaultCode::Busy};
        case 1: return {CommandKind::Reset, {}, FaultCode::Busy};
        case 2: return {CommandKind::Run, {}, FaultCode::Busy};
        case 3: return {CommandKind::Run, elsewhere(draw_program(draw, machine), machine), FaultCode::Busy};
        default: return {CommandKind::Resume, {}, FaultCode::NothingToDo};
    }
}

Interrupt draw_interrupt(Draw& draw, const MachineConfig& machine) {
    Interrupt interrupt;
    interrupt.after_s = draw.chance(0.2) ? 0 : draw.magnitude(0.002, 3);
    interrupt.rest_s = draw.magnitude(0.001, 0.1);
    const double kind = draw.part();
    if (kind < 0.25) {
        interrupt.kind = Interrupt::Kind::WrongCommand;
        interrupt.wrong = wrong_in_motion(draw, machine);
    } else if (kind < 0.4) {
        interrupt.kind = Interrupt::Kind::Stop;
    } else if (kind < 0.45) {
        interrupt.kind = Interrupt::Kind::HoldAndStop;
    } else if (kind < 0.5) {
        interrupt.kind = Interrupt::Kind::EmergencyStop;
    }
    return interrupt;
}

Task draw_task(Draw& draw, const MachineConfig& machine, const FaultKinds& faults) {
    Task task{.program = draw_program(draw, machine), .before = {}, .interrupts = {}, .faults = {}};
    while (draw.chance(0.3)) { task.before.push_back(wrong_when_idle(draw, machine)); }
    for (int n = 0; n < 5 && draw.chance(0.6); ++n) { task.interrupts.push_back(draw_interrupt(draw, machine)); }
    if (const auto fault = draw_fault(draw, machine, faults)) { task.faults.push_back(*fault); }
    // Half of the faults are in a job without interrupts.
    if (!task.faults.empty() && draw.chance(0.5)) { task.interrupts.clear(); }
    return task;
}

/// Each kind is in half of the runs, so that it occurs alone and together with others.
FaultKinds half_of(Draw& draw, const FaultKinds& faults) {
    const auto kept = [&draw](bool kind) { return kind && draw.chance(0.5); };
    return {kept(faults.delay), kept(faults.reorder),   kept(faults.duplicate), kept(faults.loss),  kept(faults.freeze),
            kept(faults.crash), kept(faults.partition), kept(faults.corrupt),   kept(faults.stall), kept(faults.clock)};
}

/// Changes overrides up to three times in each job. The random numbers are separate: other random values stay the same.
void give_overrides(std::uint64_t seed, bool mixed, Scenario& scenario) {
    Draw draw(seed ^ 0x0f0e0d0c0b0a0908U);
    if (mixed && draw.chance(0.5)) { return; }
    for (Task& task : scenario.tasks) {
        for (std::int64_t n = draw.whole(1, 3); n > 0; --n) {
            Interrupt turn{.kind = Interrupt::Kind::Override, .after_s = draw.magnitude(0.002, 3), .wrong = {}};
            turn.overrides = {static_cast<int>(draw.whole(60, 200)), static_cast<int>(draw.whole(60, 200))};
            const auto place = draw.index(task.interrupts.size() + 1);
            task.interrupts.insert(task.interrupts.begin() + static_cast<std::ptrdiff_t>(place), turn);
        }
    }
}

/// Half of the programs end with a dense curve. The random numbers are separate, as for overrides.
void give_dense_curves(std::uint64_t seed, Scenario& scenario) {
    Draw draw(seed ^ 0x0de05ecc0de05eccU);
    for (Task& task : scenario.tasks) {
        if (draw.chance(0.5)) { task.program = with_dense_curve(draw, scenario.machine, std::move(task.program)); }
    }
}

/// Arcs, path modes and events. The random numbers are separate, as for overrides.
void give_curves(std::uint64_t seed, bool mixed, Scenario& scenario) {
    Draw draw(seed ^ 0xc0e7ec0e7ec0e7e0U);
    if (mixed && draw.chance(0.5)) { return; }
    for (Task& task : scenario.tasks) {
        if (draw.chance(0.7)) { task.program = with_curves(draw, scenario.machine, std::move(task.program)); }
    }
}

/// Programs that are sent while they run. The random numbers are separate, as for overrides.
void give_streams(std::uint64_t seed, bool mixed, Scenario& scenario) {
    Draw draw(seed ^ 0x57ea357ea357ea30U);
    if (mixed && draw.chance(0.5)) { return; }
    for (Task& task : scenario.tasks) {
        if (draw.chance(0.8)) { send_in_parts(draw, task); }
    }
}

/// Some homings are stopped. The random numbers are separate, as for overrides.
void give_homing_stop(std::uint64_t seed, Scenario& scenario) {
    Draw draw(seed ^ 0x5109051095109510U);
    if (scenario.homing_stop || !draw.chance(0.05)) { return; }
    scenario.homing_stop = HomingStop{CommandKind::Stop, draw.magnitude(0.001, 3)};
}

/// A second coordinator, and jobs and homings with a takeover. The random numbers are separate, as for overrides. If
/// there are other kinds, some jobs keep the faults drawn for those kinds.
void give_standby(std::uint64_t seed, bool mixed, const FaultKinds& others, Scenario& scenario) {
    Draw draw(seed ^ 0x0a0b0c0d0e0f0102U);
    if (mixed && draw.chance(0.6)) { return; }
    Draw late(seed ^ 0x1a7e0e0f01020304U);
    scenario.coordinators = 2;
    if (Draw(seed ^ 0x0c04715e0e0f0102U).chance(0.5)) { scenario.on_takeover = OnTakeover::Continue; }
    if (!others.breaks_processes()) { scenario.tasks.push_back({scenario.tasks[0].program, {}, {}, {}}); }
    if (draw.chance(0.25)) { scenario.homing_faults = draw_takeover_of_homing(draw, scenario.machine); }
    for (std::size_t n = 0; n + 1 < scenario.tasks.size(); ++n) {
        Task& task = scenario.tasks[n];
        if (!task.faults.empty() && draw.chance(0.3)) { continue; }
        task.faults = draw_takeover(draw, scenario.machine);
        draw_late_network(late, scenario.machine, task.faults);
    }
}

/// Faults of axes' switches, slides and devices in jobs and homings, alone or shortly after other faults there.
void give_plant_faults(std::uint64_t seed, bool mixed, Scenario& scenario) {
    Draw draw(seed ^ 0x0102030405060708U);
    constexpr double kLongSearch = 40'000;
    const auto takes_long = [&](const AxisConfig& axis) {
        return search_slots(axis, scenario.machine.timing) > kLongSearch;
    };
    if (std::ranges::any_of(scenario.machine.axes, takes_long)) { return; }
    if (mixed && draw.chance(0.7)) { return; }
    scenario.tasks.push_back({scenario.tasks[0].program, {}, {}, {}});
    scenario.asks_in_fault = draw.chance(0.5);
    if (draw.chance(0.4)) { scenario.homing_faults = {draw_plant_fault_of_homing(draw, scenario.machine)}; }
    for (std::size_t n = 0; n + 1 < scenario.tasks.size(); ++n) {
        PlannedFault planned = draw_plant_fault(draw, scenario.machine);
        auto& faults = scenario.tasks[n].faults;
        if (!faults.empty() && draw.chance(0.5)) {
            planned.edge = PlannedFault::Edge::Before;
            planned.slots = draw.real(0, 2.0 * scenario.machine.timing.frame_slots);
        } else {
            faults.clear();
        }
        faults.push_back(planned);
    }
}

/// Devices that are lost in jobs and homings, alone or shortly after other faults there. The random numbers are
/// separate, as for overrides; the last job has no such fault.
void give_device_faults(std::uint64_t seed, bool mixed, Scenario& scenario) {
    Draw draw(seed ^ 0x0de71ce0de71ce00U);
    if (mixed && draw.chance(0.7)) { return; }
    scenario.tasks.push_back({scenario.tasks[0].program, {}, {}, {}});
    if (draw.chance(0.3)) { scenario.homing_faults = {draw_device_fault_of_homing(draw, scenario.machine)}; }
    for (std::size_t n = 0; n + 1 < scenario.tasks.size(); ++n) {
        PlannedFault planned = draw_device_fault(draw, scenario.machine);
        auto& faults = scenario.tasks[n].faults;
        if (!faults.empty() && draw.chance(0.5)) {
            planned.edge = PlannedFault::Edge::Before;
            planned.slots = draw.real(0, 2.0 * scenario.machine.timing.frame_slots);
        } else {
            faults.clear();
        }
        faults.push_back(planned);
    }
}

/// Uneven delays change the known clock error from one exchange to the next. The random numbers are separate, as for
/// overrides. The clocks use the rest of a hop.
void give_uneven_delays(std::uint64_t seed, Scenario& scenario) {
    Draw draw(seed ^ 0x0de1a70fc10c0000U);
    if (draw.chance(0.3)) { return; }
    const double most = 0.06 * static_cast<double>(scenario.machine.slot_ticks().value);
    const auto part = [&] { return Ticks{static_cast<std::int64_t>(draw.real(0, most))}; };
    scenario.network.delay_max = std::max(scenario.network.delay_max, scenario.network.delay_min + part());
    scenario.network.reply_longer = part();
}

/// Sets the clocks seconds apart and up to 100 ppm fast or slow, separately for each process and each device.
void give_clocks(Draw& draw, Scenario& scenario) {
    MachineConfig& machine = scenario.machine;
    scenario.power_up = {100'000'000};  // more than any clock is behind
    machine.timing.time_source = TimeSource::Network;
    machine.timing.clock_error_limit_us = machine.timing.most_clock_error_us();
    const auto draw_clock = [&] {
        const double offset_s = (draw.chance(0.5) ? 1 : -1) * draw.magnitude(1e-6, 60);
        const double offset = offset_s * machine.ticks_per_second();
        return VirtualClock{.offset = {static_cast<std::int64_t>(offset)}, .ppm = draw.real(-100, 100)};
    };
    for (std::size_t m = 0; m < motor_count(machine); ++m) {
        const VirtualClock process = draw_clock();
        scenario.clocks.push_back({process, draw_clock()});
    }
}

/// The kinds of this run, and those that are not drawn for each run.
FaultKinds with_plant(FaultKinds faults, const FaultKinds& asked) {
    faults.limit = asked.limit;
    faults.device = asked.device;
    return faults;
}

}  // namespace

Scenario draw_scenario(std::uint64_t seed, const FaultKinds& asked, const MachineKind& kind) {
    Draw draw(seed);
    Scenario scenario{.seed = seed};
    FaultKinds faults = asked.mixed ? half_of(draw, asked) : asked;
    if (faults.clock) { faults.corrupt = false; }  // no clock bound holds with falsified replies
    const std::size_t drawn = 1 + draw.index(6);
    scenario.machine = draw_machine(draw, kind.axes.value_or(drawn), kind.long_searches);
    if (kind.small_rings) { scenario.machine = with_small_rings(seed, std::move(scenario.machine)); }
    if (kind.deltas) {
        scenario.machine = with_delta(seed, std::move(scenario.machine));
    } else if (kind.motors) {
        scenario.machine = with_motors(seed, std::move(scenario.machine));
    }
    if (kind.screws && !kind.deltas) { scenario.machine = with_screws(seed, std::move(scenario.machine)); }
    if (kind.boards && scenario.machine.coordination != StepMethod::Lai) {
        scenario.machine.boards.push_back({.name = "IO", .host = "", .device = {}});
    }
    if (kind.touches && !kind.deltas) { scenario.machine = with_touches(seed, std::move(scenario.machine)); }
    if (kind.backlash && !kind.screws) { scenario.machine = with_backlash(seed, std::move(scenario.machine)); }
    if (kind.encoders && !kind.backlash) { scenario.machine = with_encoders(seed, std::move(scenario.machine)); }
    scenario.network = draw_network(draw, faults, scenario.machine.slot_ticks());
    if (faults.clock) {
        give_clocks(draw, scenario);
        give_uneven_delays(seed, scenario);
    }
    if (draw.chance(0.3)) {
        scenario.before_homing.push_back({CommandKind::Run, draw_program(draw, scenario.machine), FaultCode::NotHomed});
    }
    if (draw.chance(0.05)) { scenario.homing_stop = HomingStop{CommandKind::EmergencyStop, draw.magnitude(0.001, 1)}; }
    if (draw.chance(0.2)) {
        const auto fault = draw_homing_fault(draw, scenario.machine, faults);
        if (fault) { scenario.homing_faults.push_back(*fault); }
    }
    for (std::int64_t n = draw.whole(1, 2); n > 0; --n) {
        scenario.tasks.push_back(draw_task(draw, scenario.machine, faults));
    }
    // A last job without faults shows that the machine works again after any fault.
    if (faults.breaks_processes()) { scenario.tasks.push_back({draw_program(draw, scenario.machine), {}, {}, {}}); }
    give_homing_stop(seed, scenario);
    if (asked.override) { give_overrides(seed, asked.mixed, scenario); }
    if (asked.standby && !faults.clock) { give_standby(seed, asked.mixed, faults, scenario); }
    if (asked.limit) { give_plant_faults(seed, asked.mixed, scenario); }
    if (asked.device) {
        give_device_faults(seed, asked.mixed, scenario);
        scenario.resets_early = Draw(seed ^ 0x0ea717ea717ea717U).chance(0.3);
    }
    give_dense_curves(seed, scenario);
    if (asked.curve) { give_curves(seed, asked.mixed, scenario); }
    if (kind.outputs) { give_outputs(seed, scenario); }
    if (asked.stream) { give_streams(seed, asked.mixed, scenario); }
    if (kind.late_devices) { give_late_devices(seed, scenario); }
    if (kind.inputs) { give_inputs(seed, scenario); }
    if (kind.probes) { give_probes(seed, scenario); }
    if (kind.probes && kind.close_probes) { bring_probe_close(seed, scenario); }
    if (kind.bounces) { give_bounces(seed, scenario); }
    put_limits_behind_errors(scenario.machine);
    if (kind.small_rings) { give_rings(seed, scenario); }
    if (kind.jogs) { give_jogs(seed, with_plant(faults, asked), scenario); }
    if (kind.encoders && !kind.backlash) { give_slips(seed, scenario); }
    return scenario;
}

}  // namespace lockstep::simtest
