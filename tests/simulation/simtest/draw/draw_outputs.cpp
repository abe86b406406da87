#include "tests/simulation/simtest/draw/draw_outputs.hpp"

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
        output.motor = motor_name(machine, draw.index(motor_count(machine)));
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

}  // namespace

void give_outputs(std::uint64_t seed, Scenario& scenario) {
    if (scenario.machine.coordination == StepMethod::Lai) { return; }
    Draw draw(seed ^ 0x0b7b5e70b7b5e700U);
    scenario.machine.outputs = draw_outputs(draw, scenario.machine);
    for (Task& task : scenario.tasks) {
        std::vector<Block>& blocks = task.program.blocks;
        if (!blocks.empty()) { blocks = EventDrawer(draw).between(blocks); }
    }
}

}  // namespace lockstep::simtest
