// How soon a machine in motion reacts to what happens: the least, the median and the greatest time until it begins to
// brake and until it rests, by its pulses, in virtual time. Each event comes at many places of a frame and of a slot.
//
// usage: lockstep-reactions MACHINE.textproto
#include <algorithm>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "core/protocol/frame_room.hpp"
#include "services/documents/machine_file.hpp"
#include "services/virtual/virtual_machine.hpp"

namespace lockstep {
namespace {

constexpr double kSpeed_mm_s = 100;
constexpr int kTimes = 40;
constexpr Ticks kSecond{1'000'000};

/// The pulses of the axis that moves, X.
class Pulses : public VirtualObserver {
public:
    void on_step(std::size_t axis, StepEdge step) override {
        if (axis == 0) { ticks.push_back(step.tick); }
    }
    std::vector<Tick> ticks;
};

struct Reaction {
    double brakes_ms = 0;
    double rests_ms = 0;
};

class Machine {
public:
    explicit Machine(const MachineConfig& config) : vm_({.machine = config}) {
        vm_.observe(pulses_);
        (void)reaches(MachinePhase::Idle, kSecond * 10);
        (void)vm_.command(CommandKind::Home);
        (void)reaches(MachinePhase::Homing, kSecond);
        (void)reaches(MachinePhase::Idle, kSecond * 120);
    }

    VirtualMachine& vm() { return vm_; }
    void move() {
        const double end = vm_.machine().axes[0].position_max_mm - 5;
        vm_.give_program(1, {.name = "line",
                             .axes = {"X"},
                             .start_mm = {vm_.machine().axes[0].homing.park_mm},
                             .blocks = {{1, LinearMove{{end}, kSpeed_mm_s, false}}}});
        (void)vm_.command(CommandKind::Run, 0, 1);
    }
    void move_own() {
        vm_.give_program(1, {.name = "line",
                             .axes = {"X"},
                             .start_mm = {vm_.machine().axes[0].homing.park_mm},
                             .blocks = {{1, LinearMove{{vm_.machine().axes[0].position_max_mm - 5}, 0, true}}}});
        (void)vm_.command(CommandKind::MoveOwn, 0, 1);
    }
    void wait(Ticks time) {
        (void)vm_.advance_until([] { return false; }, time);
    }
    /// From now on until the time between two pulses has grown by more than two ticks, and until no pulse comes.
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

private:
    bool reaches(MachinePhase phase, Ticks limit) {
        return vm_.advance_until([&] { return vm_.state() && vm_.state()->phase == phase; }, limit);
    }

    VirtualMachine vm_;
    Pulses pulses_;
};

struct Event {
    const char* name;
    bool own;  // in a move of the axis on its own
    std::function<void(Machine&)> happens;
    bool comes_to_rest = true;
};

std::string spread(std::vector<double> values) {
    std::ranges::sort(values);
    char text[64];
    std::snprintf(text, sizeof text, "%.0f / %.0f / %.0f", values.front(), values[values.size() / 2], values.back());
    return text;
}

/// A profile's timing; everything else as the machine's file has it.
struct Profile {
    const char* name;
    std::int64_t slot_us;
    int stall_slots;
    int late_check_slots;
};

MachineConfig with(MachineConfig machine, const Profile& profile) {
    ProtocolTiming& t = machine.timing;
    t.slot_us = profile.slot_us;
    t.stall_slots = profile.stall_slots;
    t.late_check_slots = profile.late_check_slots;
    t.freshness_slots = RULE_LEAST_FRESHNESS(t.stall_slots);
    t.send_ahead_slots = RULE_LEAST_SEND_AHEAD(t.check_slots(), t.freshness_slots, t.stall_slots);
    t.frame_slots = std::max(5, least_frame_slots(t));
    return machine;
}

void measure(const MachineConfig& machine, const Profile& profile, const Event& event) {
    std::vector<double> brakes, rests;
    for (int i = 0; i < kTimes; ++i) {
        Machine moving(with(machine, profile));
        event.own ? moving.move_own() : moving.move();
        const ProtocolTiming& t = moving.vm().machine().timing;
        moving.wait(kSecond + Ticks{t.slot_us * t.frame_slots * i / kTimes + t.slot_us * i * 7 / kTimes});
        const Reaction reaction = moving.after([&] { event.happens(moving); });
        brakes.push_back(reaction.brakes_ms);
        rests.push_back(reaction.rests_ms);
    }
    std::printf("| %s | %s | %s | %s |\n", event.name, profile.name, spread(brakes).c_str(),
                event.comes_to_rest ? spread(rests).c_str() : "");
}

int main_of(const char* file) {
    const auto machine = load_machine_file(file);
    if (!machine) {
        std::fprintf(stderr, "%s\n", to_text(file, machine.error()).c_str());
        return 2;
    }
    const auto crash = [](Machine& m, std::size_t process) {
        m.vm().schedule(
            {.kind = VirtualFault::Kind::Crash, .process = process, .at = m.vm().now(), .lasts = kSecond * 10});
    };
    const std::size_t last = machine->axes.size() - 1;
    const Event events[] = {
        {"hold", false, [](Machine& m) { (void)m.vm().command(CommandKind::Hold); }},
        {"stop", false, [](Machine& m) { (void)m.vm().command(CommandKind::Stop); }},
        {"feed from 100 to 10 %", false, [](Machine& m) { (void)m.vm().turn({.feed_percent = 10}); }, false},
        {"another axis's process ends", false, [&](Machine& m) { crash(m, last); }},
        {"the coordinator's process ends", false, [&](Machine& m) { crash(m, machine->axes.size()); }},
        {"stop of a move of its own", true, [](Machine& m) { (void)m.vm().command(CommandKind::Stop); }},
    };
    constexpr Profile kProfiles[] = {{"slots of 10 ms, s = 10, e = 2", 10'000, 10, 2},
                                     {"slots of 10 ms, s = 10, e = 10", 10'000, 10, 10},
                                     {"slots of 1 ms, s = 1, e = 0", 1000, 1, 0}};
    std::printf(
        "| event, at 100 mm/s | profile | brakes after: least / median / most, ms | rests after, ms "
        "|\n|---|---|---|---|\n");
    for (const Event& event : events) {
        for (const Profile& profile : kProfiles) { measure(*machine, profile, event); }
    }
    return 0;
}

}  // namespace
}  // namespace lockstep

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fprintf(stderr, "usage: lockstep-reactions MACHINE.textproto\n");
        return 2;
    }
    return lockstep::main_of(argv[1]);
}
