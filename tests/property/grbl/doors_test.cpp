// A program ends at the same place whether it is run as a file, or sent line by line, or in one packet.
#include "core/arc_path.hpp"
#include "services/documents/program_file.hpp"
#include "tests/property/gcode/random_program.hpp"
#include "tests/unit/grbl/virtual_sender.hpp"

namespace lockstep::grbl {
namespace {

constexpr std::size_t kPrograms = 12;
constexpr std::size_t kLines = 30;
constexpr double kMost_s = 30;  // of a program, so that the test is short
constexpr std::size_t kLeastMoves = 6;

MachineSetup machine_with_devices() {
    MachineSetup machine = small_machine();
    machine.unassigned = {.spindle = WordRule::Ignore, .coolant = WordRule::Ignore};
    return machine;
}

double seconds_of(const Program& program) {
    double seconds = 0;
    std::vector<double> at = program.start_mm;
    for (const Block& block : program.blocks) {
        const auto* move = std::get_if<ProgramMove>(&block.action);
        if (move == nullptr) { continue; }
        if (!move->rapid) { seconds += length_mm(*move, at) / move->feed_mm_s; }
        at = move->target_mm;
    }
    return seconds;
}

struct Sent {
    std::uint32_t seed = 0;
    std::vector<std::string> lines;
    Program program;
    std::vector<std::int64_t> end;

    std::string text() const {
        std::string text;
        for (const std::string& line : lines) { text += line + "\n"; }
        return text;
    }
};

class Doors : public Rig {
protected:
    Doors() : Rig({.machine = machine_with_devices()}) {}
    void SetUp() override {
        home();
        const GcodeSetup setup = gcode_setup(vm.machine(), {5, 5}, "whole");
        for (std::uint32_t seed = 1; programs.size() < kPrograms; ++seed) {
            Sent sent{.seed = seed, .lines = RandomProgram(seed, setup).lines(kLines), .program = {}, .end = {}};
            sent.lines.insert(sent.lines.begin(), "G0");  // grbl begins with it
            sent.program = read_gcode(sent.text(), setup)->program;
            std::size_t moves = 0;
            for (const Block& block : sent.program.blocks) {
                const auto* move = std::get_if<ProgramMove>(&block.action);
                if (move == nullptr) { continue; }
                ++moves;
                sent.end = {to_steps(vm.machine().axes[0], move->target_mm[0]),
                            to_steps(vm.machine().axes[1], move->target_mm[1])};
            }
            if (moves >= kLeastMoves && seconds_of(sent.program) < kMost_s) { programs.push_back(std::move(sent)); }
        }
        sender.emplace(vm);
    }
    bool passes_until(const std::function<bool()>& done, double seconds) {
        const Tick end = vm.now() + Ticks{static_cast<std::int64_t>(seconds * 1e6)};
        while (!done()) {
            if (vm.now() >= end) { return false; }
            (void)vm.advance_until([] { return false; }, Ticks{2'000});
            sender->pass();
        }
        return true;
    }
    /// Sends the text, and returns its answers when the machine is idle.
    std::string answers_to(const std::string& text, std::size_t lines) {
        (void)sender->take_text();
        sender->send(text);
        const auto is_answered = [&] {
            std::size_t answers = 0;
            for (std::size_t at = 0; (at = sender->text().find("ok\r\n", at)) != std::string::npos; ++at) { ++answers; }
            return answers >= lines || sender->text().contains("error:");
        };
        EXPECT_TRUE(passes_until(is_answered, 4 * kMost_s)) << text << sender->text();
        const std::string answers = sender->take_text();
        EXPECT_TRUE(passes_until(
            [&] {
                sender->send("?");
                sender->pass();
                return sender->take_text().starts_with("<Idle");
            },
            4 * kMost_s))
            << text;
        return answers;
    }
    /// A reset, so that the next program begins like the first.
    void return_to_start() {
        sender->pass();
        sender->send("\x18");
        sender->values = {};
        EXPECT_EQ(answers_to("G53 G0 X5 Y5\n", 1).find("error:"), std::string::npos);
        sender->send("\x18");
        ASSERT_EQ(counts(), (std::vector<std::int64_t>{500, 500}));
    }

    std::vector<Sent> programs;
    std::optional<VirtualSender> sender;
};

TEST_F(Doors, AFileEndsAtItsLastPlace) {
    for (const Sent& sent : programs) {
        ASSERT_EQ(run(sent.program).status, ReplyStatus::Accepted) << sent.text();
        ASSERT_TRUE(reaches(MachinePhase::Idle, 4 * kMost_s)) << sent.text();
        EXPECT_EQ(counts(), sent.end) << "seed " << sent.seed << "\n" << sent.text();
        ASSERT_NO_FATAL_FAILURE(return_to_start());
    }
}

TEST_F(Doors, LineByLineEndsWhereTheFileEnds) {
    for (const Sent& sent : programs) {
        for (const std::string& line : sent.lines) {
            EXPECT_EQ(answers_to(line + "\n", 1).find("error:"), std::string::npos) << line << "\n" << sent.text();
        }
        EXPECT_EQ(counts(), sent.end) << "seed " << sent.seed << "\n" << sent.text();
        ASSERT_NO_FATAL_FAILURE(return_to_start());
    }
}

TEST_F(Doors, OnePacketEndsWhereTheFileEnds) {
    for (const Sent& sent : programs) {
        const std::string answers = answers_to(sent.text(), sent.lines.size());
        EXPECT_EQ(answers.find("error:"), std::string::npos) << sent.text() << answers;
        EXPECT_EQ(counts(), sent.end) << "seed " << sent.seed << "\n" << sent.text();
        ASSERT_NO_FATAL_FAILURE(return_to_start());
    }
}

}  // namespace
}  // namespace lockstep::grbl
