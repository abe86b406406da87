// A machine in virtual time with a moving axis X. Measures by X's pulses how soon it reacts to an event.
#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <vector>

#include "services/virtual/virtual_machine.hpp"
#include "tests/unit/virtual/jogger.hpp"

namespace lockstep {

/// The pulses of the axis that moves, X.
class Pulses : public VirtualObserver {
public:
    void on_step(MotorIndex axis, StepEdge step) override {
        if (axis == 0) { ticks.push_back(step.tick); }
    }
    std::vector<Tick> ticks;
};

struct Reaction {
    double brakes_ms = 0;
    double rests_ms = 0;
};

class MovingMachine {
public:
    static constexpr double kFeed_mm_s = 100;
    static constexpr Ticks kSecond{1'000'000};

    explicit MovingMachine(const MachineConfig& config) : vm_({.machine = config}) {
        vm_.observe(pulses_);
        (void)reaches(MachinePhase::Idle, kSecond * 10);
        (void)vm_.command(CommandKind::Home);
        (void)reaches(MachinePhase::Homing, kSecond);
        (void)reaches(MachinePhase::Idle, kSecond * 120);
    }

    VirtualMachine& vm() { return vm_; }
    /// Moves nearly to the end of the travel, as one coordinated move.
    void move() { give(CommandKind::Run, kFeed_mm_s); }
    /// The same as a move of the axis on its own, as fast as possible.
    void move_own() { give(CommandKind::MoveOwn, 0); }
    /// Jogs in positive direction while client() renews the jog.
    void jog() { client_.press({{.axis = AxisIndex{0}, .speed_mm_s = kFeed_mm_s}}); }
    Jogger& client() { return client_; }
    void wait(Ticks time) {
        if (client_.is_alive()) { return pass(vm_, {&client_}, time); }
        (void)vm_.advance_until([] { return false; }, time);
    }
    /// The reaction to `event`. The axis begins to brake when the time between two pulses grows by more than two ticks,
    /// and rests after the last pulse.
    Reaction after(const std::function<void()>& event) {
        const Tick now = vm_.now();
        const std::size_t before = pulses_.ticks.size();
        event();
        wait(kSecond * 3);
        const auto& t = pulses_.ticks;
        const auto interval = [&](std::size_t i) { return t[i].value - t[i - 1].value; };
        std::size_t i = before;
        while (i < t.size() && interval(i) <= interval(before - 1) + 2) { ++i; }
        const auto ms = [&](Tick tick) { return static_cast<double>((tick - now).value) / 1000; };
        return {ms(t[std::min(i, t.size()) - 1]), ms(t.back())};
    }

    std::optional<Tick> first_pulse_after(Tick tick) const {
        const auto found = std::ranges::lower_bound(pulses_.ticks, tick);
        return found == pulses_.ticks.end() ? std::nullopt : std::optional(*found);
    }

private:
    void give(CommandKind kind, double feed_mm_s) {
        const AxisConfig& axis = vm_.machine().axes[0];
        const ProgramMove line{{axis.position_max_mm - 5}, feed_mm_s, feed_mm_s == 0};
        vm_.give_program(
            1, {.name = "line", .axes = {axis.name}, .start_mm = {axis.homing.park_mm}, .blocks = {{1, line}}});
        (void)vm_.command(kind, {}, 1);
    }
    bool reaches(MachinePhase phase, Ticks limit) {
        return vm_.advance_until([&] { return vm_.state() && vm_.state()->phase == phase; }, limit);
    }

    VirtualMachine vm_;
    Jogger client_{vm_};
    Pulses pulses_;
};

}  // namespace lockstep
