#include "tests/simulation/simtest/draw/draw_outputs.hpp"

#include <cmath>

#include "core/kinematics/kinematics.hpp"
#include "core/kinematics/motors.hpp"
#include "tests/simulation/simtest/draw/draw.hpp"

namespace lockstep::simtest {
namespace {

using Word = ProgramEvent::Kind;

constexpr double kFullScale_S = 1000;
constexpr double kMost_S = 450;  // with an override of 200 % the power stays below full scale
constexpr int kDigital = 3;

std::vector<OutputConfig> draw_outputs(Draw& draw, const MachineConfig& machine) {
    std::vector<OutputConfig> outputs;
    const auto add = [&](OutputConfig output) {
        output.motor = motor_name(machine, MotorIndex{draw.index(motor_count(machine))});
        output.stays_at_interruption = draw.chance(0.5);
        output.stays_at_fault = draw.chance(0.3);
        output.stays_at_silence = true;  // stalls are long in these runs
        outputs.push_back(std::move(output));
    };
    add({.name = "laser",
         .use = OutputUse::Spindle,
         .pwm = PwmConfig{.hz = draw.magnitude(10, 10'000), .full_scale = kFullScale_S, .follows_speed = true}});
    for (int n = 0; n < kDigital; ++n) {
        add({.name = "valve" + std::to_string(n), .channel = n, .number = n, .inverted = draw.chance(0.3)});
    }
    add({.name = "air", .channel = kDigital, .use = OutputUse::Flood});
    return outputs;
}

class EventDrawer {
public:
    explicit EventDrawer(Draw& draw) : draw_(draw) {}

    /// Levels that do not depend on what was before, and then changes between the moves.
    std::vector<Block> between(const std::vector<Block>& blocks) {
        std::vector<Block> all;
        add(all, {.kind = Word::SpindleReverse, .value = power()});
        add(all, {.kind = Word::CoolantOff});
        for (int n = 0; n < kDigital; ++n) { add(all, {.kind = Word::OutputOff, .index = n}); }
        const double share = draw_.any_of<double>({0.05, 0.3, 0.3, 0.9});
        for (const Block& block : blocks) {
            if (std::holds_alternative<ProgramEvent>(block.action)) { continue; }
            while (draw_.chance(share * 0.7)) { add(all, any()); }
            all.push_back(block);
        }
        return all;
    }

private:
    double power() { return draw_.chance(0.2) ? 0 : draw_.real(1, kMost_S); }
    ProgramEvent any() {
        const auto valve = static_cast<std::int32_t>(draw_.index(kDigital));
        switch (draw_.index(8)) {
            case 0: return {.kind = Word::SpindleStop};
            case 1: return {.kind = Word::SpindleReverse, .value = power()};
            case 2: return {.kind = draw_.chance(0.5) ? Word::FloodOn : Word::CoolantOff};
            case 3:
            case 4: return {.kind = Word::OutputOn, .index = valve};
            case 5: return {.kind = Word::OutputOff, .index = valve};
            default: return {.kind = Word::SpindleSpeed, .value = power()};
        }
    }
    static void add(std::vector<Block>& blocks, const ProgramEvent& event) { blocks.push_back({{}, event}); }

    Draw& draw_;
};

/// Pulses at places of an axis that a motor moves alone.
class PulseDrawer {
public:
    PulseDrawer(Draw& draw, const MachineConfig& machine) : draw_(draw), motors_(motors_of(machine)) {
        std::erase_if(motors_, [](const MotorConfig& motor) { return !motor.moves_one_axis; });
        if (!motors_.empty()) { motor_ = motors_[draw.index(motors_.size())]; }
    }
    bool none() const { return motors_.empty(); }

    OutputConfig output() const {
        return {.name = "camera",
                .motor = motor_.name,
                .channel = kDigital + 1,
                .use = OutputUse::Places,
                .number = kDigital,
                .pulse_us = 100};
    }
    std::vector<Block> between(const std::vector<Block>& blocks, const AxisConfig& axis, double steps_per_mm) {
        std::vector<Block> all{{{}, ProgramEvent{.kind = Word::PulsePlaces}}};
        const double share = draw_.any_of<double>({0.02, 0.1, 0.5});
        for (const Block& block : blocks) {
            if (!std::holds_alternative<ProgramEvent>(block.action) && draw_.chance(share)) {
                add(all, axis, steps_per_mm);
            }
            all.push_back(block);
        }
        return all;
    }
    std::size_t axis() const { return motor_.axis.value(); }

private:
    void add(std::vector<Block>& blocks, const AxisConfig& axis, double steps_per_mm) {
        if (draw_.chance(0.1)) { return blocks.push_back({{}, ProgramEvent{.kind = Word::PulsePlaces}}); }
        const double spacing_mm = (draw_.chance(0.5) ? 1 : -1) * std::round(draw_.magnitude(1, 1000)) / steps_per_mm;
        const auto count = static_cast<std::int32_t>(draw_.magnitude(1, 300));
        blocks.push_back({{}, ProgramEvent{Word::PulseSpacing, kDigital, spacing_mm}});
        blocks.push_back(
            {{}, ProgramEvent{Word::PulsePlaces, count, draw_.real(axis.position_min_mm, axis.position_max_mm)}});
    }

    Draw& draw_;
    std::vector<MotorConfig> motors_;
    MotorConfig motor_;
};

void give_pulses(std::uint64_t seed, Scenario& scenario) {
    Draw draw(seed ^ 0x9015e5a791aceU);
    PulseDrawer pulses(draw, scenario.machine);
    if (pulses.none() || draw.chance(0.3)) { return; }
    scenario.machine.outputs.push_back(pulses.output());
    const Kinematics kinematics(scenario.machine);
    const MotorIndex motor = motor_named(scenario.machine, pulses.output().motor).value();
    const double steps_per_mm = 1 / kinematics.axis_mm(AxisIndex{pulses.axis()}, motor);
    for (Task& task : scenario.tasks) {
        std::vector<Block>& blocks = task.program.blocks;
        const AxisConfig& axis = scenario.machine.axes[pulses.axis()];
        if (!blocks.empty()) { blocks = pulses.between(blocks, axis, steps_per_mm); }
    }
}

/// A board has at least one output.
void move_to_board(std::uint64_t seed, MachineConfig& machine) {
    if (machine.boards.empty()) { return; }
    Draw draw(seed ^ 0x0b0a2d050b0a2d05U);
    const std::string& board = machine.boards.front().name;
    const std::size_t always = draw.index(machine.outputs.size());
    for (std::size_t k = 0; k < machine.outputs.size(); ++k) {
        OutputConfig& output = machine.outputs[k];
        if (k == always || draw.chance(0.5)) { output.motor = board; }
        output.at_board = output.motor == board;
    }
}

}  // namespace

void give_outputs(std::uint64_t seed, Scenario& scenario) {
    if (scenario.machine.coordination == StepMethod::Lai) { return; }
    Draw draw(seed ^ 0x0b7b5e70b7b5e700U);
    scenario.machine.outputs = draw_outputs(draw, scenario.machine);
    move_to_board(seed, scenario.machine);
    for (Task& task : scenario.tasks) {
        std::vector<Block>& blocks = task.program.blocks;
        if (!blocks.empty()) { blocks = EventDrawer(draw).between(blocks); }
    }
    give_pulses(seed, scenario);
}

}  // namespace lockstep::simtest
