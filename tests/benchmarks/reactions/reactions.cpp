// Measures how soon a machine in motion reacts to events: the least, the median and the greatest time until it begins
// to brake and until it rests, by its pulses, in virtual time. Each event comes at many places of a frame and of a
// slot.
//
// usage: lockstep-reactions MACHINE.textproto
#include <algorithm>
#include <cstdio>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/protocol/frame_room.hpp"
#include "services/documents/machine_file.hpp"
#include "tests/benchmarks/reactions/in_copy.hpp"
#include "tests/benchmarks/reactions/moving_machine.hpp"

namespace lockstep {
namespace {

constexpr int kTimes = 40;
constexpr Ticks kSecond = MovingMachine::kSecond;

enum class Motion { Together, Own, Jog };

struct Event {
    const char* name;
    Motion motion;
    std::function<void(MovingMachine&)> happens;
    bool comes_to_rest = true;
};

std::string spread(std::vector<double> values) {
    std::ranges::sort(values);
    char text[64];
    std::snprintf(text, sizeof text, "%.0f / %.0f / %.0f", values.front(), values[values.size() / 2], values.back());
    return text;
}

/// A profile's timing; everything else is as in the machine's file.
struct Profile {
    const char* name;
    std::int64_t slot_us;
    int stall_slots;
    int late_check_slots;
};

MachineSetup with(MachineSetup machine, const Profile& profile) {
    ProtocolTiming& t = machine.timing;
    t.slot_us = profile.slot_us;
    t.stall_slots = profile.stall_slots;
    t.late_check_slots = profile.late_check_slots;
    t.frame_slots = 5;
    t = with_least_times(t);
    return machine;
}

/// A homed machine at rest. Homing takes longer than a measurement, so each machine homes once.
struct HomedMachine {
    const char* profile;
    std::unique_ptr<MovingMachine> machine;
};

void begin(Motion motion, MovingMachine& moving) {
    switch (motion) {
        case Motion::Together: return moving.move();
        case Motion::Own: return moving.move_own();
        case Motion::Jog: return moving.jog();
    }
}

/// Measures the time from the client's command to the first pulse.
void measure_begin_of_jog(const HomedMachine& homed) {
    MovingMachine& moving = *homed.machine;
    std::vector<double> begins;
    for (int i = 0; i < kTimes; ++i) {
        begins.push_back(in_copy([&] {
            moving.wait(Ticks{moving.vm().machine().timing.slot_us * i * 7 / kTimes});
            const Tick pressed = moving.vm().now();
            moving.jog();
            moving.wait(kSecond);
            return static_cast<double>((moving.first_pulse_after(pressed).value_or(pressed) - pressed).value) / 1000;
        }));
    }
    std::printf("| jog: begins | %s | %s | |\n", homed.profile, spread(begins).c_str());
}

void measure(const HomedMachine& homed, const Event& event) {
    MovingMachine& moving = *homed.machine;
    std::vector<double> brakes, rests;
    for (int i = 0; i < kTimes; ++i) {
        const Reaction reaction = in_copy([&] {
            begin(event.motion, moving);
            const ProtocolTiming& t = moving.vm().machine().timing;
            moving.wait(kSecond + Ticks{t.slot_us * t.frame_slots * i / kTimes + t.slot_us * i * 7 / kTimes});
            return moving.after([&] { event.happens(moving); });
        });
        brakes.push_back(reaction.brakes_ms);
        rests.push_back(reaction.rests_ms);
    }
    std::printf("| %s | %s | %s | %s |\n", event.name, homed.profile, spread(brakes).c_str(),
                event.comes_to_rest ? spread(rests).c_str() : "");
}

int main_of(const char* file) {
    const auto machine = load_machine_file(file);
    if (!machine) {
        std::fprintf(stderr, "%s\n", to_text(file, machine.error()).c_str());
        return 2;
    }
    const auto crash = [](MovingMachine& m, std::size_t process) {
        m.vm().schedule(
            {.kind = VirtualFault::Kind::Crash, .process = process, .at = m.vm().now(), .lasts = kSecond * 10});
    };
    const std::size_t last = machine->axes.size() - 1;
    const Event events[] = {
        {"hold", Motion::Together, [](MovingMachine& m) { (void)m.vm().command(CommandKind::Hold); }},
        {"stop", Motion::Together, [](MovingMachine& m) { (void)m.vm().command(CommandKind::Stop); }},
        {"feed from 100 to 10 %", Motion::Together,
         [](MovingMachine& m) { (void)m.vm().set_overrides({.feed_percent = 10}); }, false},
        {"another axis's process ends", Motion::Together, [&](MovingMachine& m) { crash(m, last); }},
        {"the coordinator's process ends", Motion::Together, [&](MovingMachine& m) { crash(m, machine->axes.size()); }},
        {"stop of a move of its own", Motion::Own, [](MovingMachine& m) { (void)m.vm().command(CommandKind::Stop); }},
        {"jog: its key is released", Motion::Jog, [](MovingMachine& m) { m.client().release(); }},
        {"jog: its client ends", Motion::Jog, [](MovingMachine& m) { m.client().die(); }},
        {"jog: the coordinator's process ends", Motion::Jog, [&](MovingMachine& m) { crash(m, machine->axes.size()); }},
        {"jog: the axis's process stalls", Motion::Jog,
         [](MovingMachine& m) { m.vm().schedule({.process = 0, .at = m.vm().now(), .lasts = kSecond}); }},
    };
    constexpr Profile kProfiles[] = {{"slots of 10 ms, s = 10, e = 2", 10'000, 10, 2},
                                     {"slots of 10 ms, s = 10, e = 10", 10'000, 10, 10},
                                     {"slots of 1 ms, s = 1, e = 0", 1000, 1, 0}};
    std::printf(
        "| event, at 100 mm/s | profile | brakes after: least / median / most, ms | rests after, ms "
        "|\n|---|---|---|---|\n");
    std::vector<HomedMachine> machines;
    for (const Profile& profile : kProfiles) {
        machines.push_back({profile.name, std::make_unique<MovingMachine>(with(*machine, profile))});
    }
    for (const HomedMachine& homed : machines) { measure_begin_of_jog(homed); }
    for (const Event& event : events) {
        for (const HomedMachine& homed : machines) { measure(homed, event); }
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
