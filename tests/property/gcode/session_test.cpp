// The lines of a program, given one by one while the machine runs them, are the program.
#include "core/gcode/session/gcode_session.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "tests/property/gcode/random_program.hpp"
#include "tests/random_seeds.hpp"

namespace lockstep {
namespace {

constexpr int kPrograms = 400;
constexpr std::size_t kLines = 40;

MachineConfig steps_of_a_hundredth() {
    MachineConfig machine{.name = "mill"};
    for (const char* name : {"X", "Y", "Z"}) {
        machine.axes.push_back({.name = name, .steps_per_mm = 100, .position_min_mm = 0, .position_max_mm = 200});
    }
    return machine;
}

GcodeSetup setup_of(const MachineConfig& machine) {
    GcodeSetup setup{.program_name = "lines", .axes = {}};
    setup.unassigned = {.spindle = WordRule::Ignore, .coolant = WordRule::Ignore};
    for (const AxisConfig& axis : machine.axes) {
        setup.axes.push_back({.name = axis.name, .min_mm = 0, .max_mm = 200, .park_mm = 5, .start_mm = 80});
    }
    return setup;
}

/// Everything of a block except its line, every number exactly.
std::string text_of(const Block& block) {
    std::ostringstream text;
    text << std::hexfloat << block.action.index();
    if (const auto* dwell = std::get_if<Dwell>(&block.action)) { text << " dwell " << dwell->seconds; }
    if (const auto* event = std::get_if<ProgramEvent>(&block.action)) {
        text << " event " << static_cast<int>(event->kind) << ' ' << event->index << ' ' << event->value;
    }
    const auto* move = std::get_if<ProgramMove>(&block.action);
    if (move == nullptr) { return text.str(); }
    for (const double mm : move->target_mm) { text << ' ' << mm; }
    text << " F" << move->feed_mm_s << move->rapid << static_cast<int>(move->mode) << ' ' << move->tolerance_mm
         << move->is_feed_fixed;
    if (move->arc) { text << " arc " << move->arc->centre_first_mm << ' ' << move->arc->centre_second_mm; }
    return text.str();
}

std::vector<std::string> texts_of(const std::vector<Block>& blocks) {
    std::vector<std::string> texts;
    for (const Block& block : blocks) { texts.push_back(text_of(block)); }
    return texts;
}

/// Where the axes stand when they rest: on whole steps.
std::vector<double> rest_of(const MachineConfig& machine, std::vector<double> place_mm) {
    for (std::size_t i = 0; i < place_mm.size(); ++i) {
        const AxisConfig& axis = machine.axes[i];
        place_mm[i] = to_mm(axis, static_cast<double>(to_steps(axis, place_mm[i])));
    }
    return place_mm;
}

class Session : public testing::Test {
protected:
    /// Gives the line to the session. The machine runs it, and comes to rest if `rests`.
    void give(const std::string& line, bool rests) {
        auto read = session.read(line, at);
        ASSERT_TRUE(read) << line << ": " << read.error().message;
        blocks.insert(blocks.end(), read->blocks.begin(), read->blocks.end());
        at = {rests ? rest_of(machine, read->place_mm) : read->place_mm, read->values};
        session.commit(*read);
    }

    MachineConfig machine = steps_of_a_hundredth();
    GcodeSetup setup = setup_of(machine);
    GcodeSession session{setup, machine};
    SessionStart at{.place_mm = {80, 80, 80}, .values = {}};
    std::vector<Block> blocks;
};

TEST_F(Session, RunsEachProgramAsAFileDoes) {
    std::size_t moves = 0;
    for (std::uint32_t seed = 1; seed <= random_cases(kPrograms); ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const std::vector<std::string> lines = RandomProgram(seed, setup).lines(kLines);
        std::string text;
        for (const std::string& line : lines) { text += line + "\n"; }
        const auto whole = read_gcode(text, setup);
        ASSERT_TRUE(whole);
        session.reset();
        at = {.place_mm = {80, 80, 80}, .values = {}};
        blocks.clear();
        std::mt19937 random(seed);
        for (const std::string& line : lines) { ASSERT_NO_FATAL_FAILURE(give(line, random() % 2 == 0)) << text; }
        ASSERT_EQ(texts_of(blocks), texts_of(whole->program.blocks)) << text;
        EXPECT_EQ(at.values, whole->values) << text;
        moves += blocks.size();
    }
    EXPECT_GT(moves, 10 * random_cases(kPrograms)) << "the programs move";
}

}  // namespace
}  // namespace lockstep
