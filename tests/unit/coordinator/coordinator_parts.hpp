// The parts of a coordinator of two axes. The test writes their inputs.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>

#include "core/coordinator/jobs/job_lifecycle.hpp"
#include "core/coordinator/state/coordinator_loop.hpp"

namespace lockstep {

class CoordinatorParts : public testing::Test {
protected:
    static MachineConfig two_axes() {
        MachineConfig m{.name = "pair"};
        m.timing = {.slot_us = 1000, .stall_slots = 1, .freshness_slots = 2, .send_ahead_slots = 12, .frame_slots = 5};
        const AxisConfig axis{.name = "X",
                              .steps_per_mm = 100,
                              .start_velocity_mm_s = 10,
                              .max_velocity_mm_s = 50,
                              .max_accel_mm_s2 = 500,
                              .max_decel_mm_s2 = 500,
                              .position_max_mm = 100};
        m.axes = {axis, axis};
        m.axes[1].name = "Y";
        return m;
    }
    AxisState state_of(std::uint32_t axis) const {
        return {.identity = 10 + axis, .axis = axis, .stamp = slot, .homed = true, .config_hash = 1, .term = term};
    }
    /// Both axes are received, at rest and homed.
    void receive_all() {
        for (const std::uint32_t i : {0U, 1U}) { axes.take(state_of(i), slot); }
    }
    CoordinatorLoop loop() {
        out = {};
        return {{{machine, kinematics, axes, programs, Tick{slot * 1000}, slot, slot, term}, out}, orders};
    }
    void accept(std::uint64_t id, double x_mm, double y_mm) {
        programs.accept(
            id,
            {.name = "line", .axes = {"X", "Y"}, .start_mm = {0, 0}, .blocks = {{1, ProgramMove{{x_mm, y_mm}, 20}}}});
    }
    /// The axis reports its newest order as done.
    void finish_order(std::uint32_t axis, FaultCode fault = FaultCode::None) {
        AxisState state = state_of(axis);
        state.command_done = orders.newest(MotorIndex{axis})->sequence;
        state.command_fault = fault;
        axes.take(state, slot);
    }
    /// The coordinator has claimed the machine, and its axes are ready.
    void enter_idle(JobLifecycle& jobs) {
        jobs.activity().become(MachineEvent::Claimed, activity::Waiting{}, out);
        jobs.activity().become(MachineEvent::AxesReady, activity::Idle{}, out);
    }
    bool has_job_event(JobEvent::Kind kind) const { return std::ranges::count(out.jobs, kind, &JobEvent::kind) != 0; }

    MachineConfig machine = two_axes();
    Kinematics kinematics{machine};
    Slot slot = 1000;
    Term term{5, 1};
    AxisRoster axes{machine};
    AxisOrders orders{2};
    ProgramStore programs{machine};
    CoordinatorOutputs out;
};

}  // namespace lockstep
