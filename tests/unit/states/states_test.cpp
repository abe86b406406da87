// In every state of the machine every command is answered, an accepted one has its effect, and the offered remedies
// lead back to a machine that runs jobs. docs/states.md is the result of this walk; this command writes it again:
//   LOCKSTEP_WRITE_STATES=1 build/bin/unit_states
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>

#include "core/coordinator/state/machine_phases.hpp"
#include "core/protocol/names.hpp"
#include "tests/unit/states/machine_states.hpp"

namespace lockstep {
namespace {

constexpr const char* kFile = "docs/states.md";

const std::vector<Question>& questions() {
    using Program = Question::Program;
    static const std::vector<Question> all{
        {"home", CommandKind::Home},
        {"run", CommandKind::Run, Program::Known},
        {"run, program not sent", CommandKind::Run, Program::Unknown},
        {"move", CommandKind::Move, Program::Known},
        {"move --own", CommandKind::MoveOwn, Program::Known},
        {"jog", CommandKind::Jog},
        {"hold", CommandKind::Hold},
        {"resume", CommandKind::Resume},
        {"stop", CommandKind::Stop},
        {"estop", CommandKind::EmergencyStop},
        {"reset", CommandKind::Reset},
        {"override", CommandKind::Override, Program::None, 50},
        {"override 300 %", CommandKind::Override, Program::None, 300},
    };
    return all;
}

std::string head() {
    std::string text =
        "# What the machine does, in every state, at every command\n\n"
        "Each cell gives the state in which the machine settles after the command and the outcome of the job in\n"
        "progress or begun, or the refusal. Every refusal and fault names its remedies (`core/faults.hpp`); from "
        "every\n"
        "cell they lead back to a machine that runs jobs. `tests/unit/states` walks all of it in virtual time, "
        "follows\n"
        "the remedies, and fails if this table differs from its findings. To write it again:\n"
        "`LOCKSTEP_WRITE_STATES=1 build/bin/unit_states`, in the repository's folder.\n\n| state |";
    std::string rule = "|---|";
    for (const Question& question : questions()) {
        text += " " + question.name + " |";
        rule += "---|";
    }
    return text + "\n" + rule + "\n";
}

/// The changes of one phase: the events in the order of the table, with the next phase.
std::string changes_of(MachinePhase phase) {
    std::string text = "| " + std::string(name_of(phase)) + " |";
    const char* between = " ";
    for (const MachineTransition& row : kMachineTransitions) {
        if (row.from != phase) { continue; }
        text += between + std::string(name_of(row.event)) + " → " + std::string(name_of(row.to));
        between = ", ";
    }
    return text + " |\n";
}

/// An arrow for each pair of phases, with the events that lead from one to the other.
std::string diagram() {
    std::map<std::pair<std::string, std::string>, std::string> arrows;
    for (const MachineTransition& row : kMachineTransitions) {
        if (row.from == row.to || row.event == MachineEvent::StoodDown) { continue; }
        std::string& events = arrows[{std::string(name_of(row.from)), std::string(name_of(row.to))}];
        events += (events.empty() ? "" : ", ") + std::string(name_of(row.event));
    }
    std::string text = "```mermaid\nstateDiagram-v2\n    [*] --> Standby\n";
    for (const auto& [ends, events] : arrows) {
        text += "    " + ends.first + " --> " + ends.second + " : " + events + "\n";
    }
    return text + "```\n";
}

/// What the coordinator's own table lists.
std::string phases() {
    std::string text =
        "\n## How the phase of the machine changes\n\n"
        "Only these events change the phase (`core/coordinator/state/machine_phases.hpp`). An event that is not "
        "listed\n"
        "for a phase is a defect of the program, and ends the process. `simulation.coverage` fails if a row is never\n"
        "taken.\n\n| phase | event → next phase |\n|---|---|\n";
    for (const MachinePhase phase : kMachinePhases) { text += changes_of(phase); }
    return text + "\nThe same as a diagram, without StoodDown, which leads from every phase to Standby:\n\n" +
           diagram();
}

bool is_to_write() { return std::getenv("LOCKSTEP_WRITE_STATES") != nullptr; }

std::string text_of_file() {
    std::ifstream file(kFile);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

class States : public testing::TestWithParam<MachineSituation> {
protected:
    static void TearDownTestSuite() {
        if (!is_to_write()) { return; }
        std::ofstream file(kFile);
        file << head();
        for (const MachineSituation& situation : situations()) { file << rows()[situation.name]; }
        file << phases();
    }
    static std::map<std::string, std::string>& rows() {
        static std::map<std::string, std::string> rows;
        return rows;
    }
    /// Brings a machine into the state, sends the command, follows the remedies. Returns the cell of the table.
    static std::string walk(const MachineSituation& situation, const Question& question, std::size_t choice = 0) {
        Walker machine(situation.options());
        situation.enter(machine);
        if (HasFatalFailure()) { return "not reached"; }
        const Answer answer = machine.answer_to(question);
        if (answer.refusal) { machine.follow(*answer.refusal, choice); }
        EXPECT_TRUE(machine.recovers()) << "in vain: " << machine.state_text();
        const std::size_t choices = answer.refusal ? Walker::choices(*answer.refusal) : 1;
        if (choice + 1 < choices) { (void)walk(situation, question, choice + 1); }
        return answer.text;
    }
};

TEST_P(States, AnswerEveryCommandAndTheRemediesLeadBackToIdle) {
    std::string row = "| " + GetParam().name + " |";
    for (const Question& question : questions()) {
        SCOPED_TRACE(GetParam().name + ": " + question.name);
        row += " " + walk(GetParam(), question) + " |";
    }
    row += "\n";
    rows()[GetParam().name] = row;
    if (!is_to_write()) { EXPECT_NE(text_of_file().find(row), std::string::npos) << "in " << kFile << ": " << row; }
}

INSTANTIATE_TEST_SUITE_P(All, States, testing::ValuesIn(situations()), situation_name);

TEST(StatesDocument, HasTheseStatesAndNoOthers) {
    if (is_to_write()) { GTEST_SKIP() << "it is being written"; }
    const std::string text = text_of_file();
    EXPECT_EQ(text.find(head()), 0u);
    EXPECT_TRUE(text.ends_with(phases()));
    EXPECT_EQ(std::ranges::count(text, '\n'),
              std::ranges::count(head() + phases(), '\n') + static_cast<std::ptrdiff_t>(situations().size()));
}

}  // namespace
}  // namespace lockstep
