#include "clients/scenario/model/scenario_text.hpp"

#include <fmt/format.h>

#include "clients/scenario/model/problems.hpp"

namespace lockstep::scenario {
namespace {

std::string lower(std::string name) {
    for (char& c : name) { c = c == '_' ? '-' : static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }
    return name;
}

std::string seconds(double value) { return number_text(value) + " s"; }

std::string way_text(Asked::Way way) {
    switch (way) {
        case Asked::HEARS: return "what it receives";
        case Asked::SAYS: return "what it sends";
        default: return "both ways";
    }
}

std::string loss_text(const Asked::Loss& loss) {
    const std::string names =
        loss.process().empty() ? "every process" : listed({loss.process().begin(), loss.process().end()});
    return "lose " + number_text(loss.percent()) + " % at " + names + ", " +
           way_text(loss.has_way() ? loss.way() : Asked::HEARS);
}

std::string override_text(const Asked::Override& turn) {
    std::string text = "override";
    if (turn.has_feed()) { text += fmt::format(" feed {} %", turn.feed()); }
    if (turn.has_rapid()) { text += fmt::format(" rapid {} %", turn.rapid()); }
    return text;
}

std::string what_text(const Asked::Act& act) {
    using Act = Asked::Act;
    switch (act.what_case()) {
        case Act::kKill: return "kill " + act.kill();
        case Act::kRestart: return "restart " + act.restart();
        case Act::kPause: return "pause " + act.pause();
        case Act::kUnpause: return "unpause " + act.unpause();
        case Act::kCut: return "cut " + act.cut().process() + ", " + way_text(act.cut().way());
        case Act::kLose: return loss_text(act.lose());
        case Act::kHeal: return "heal " + act.heal();
        case Act::kCommand: return lower(Asked::Command_Name(act.command()));
        case Act::kOverride: return override_text(act.override());
        case Act::WHAT_NOT_SET: break;
    }
    return "nothing";
}

std::string event_text(const Asked::During& during) {
    switch (during.event_case()) {
        case Asked::During::kLine: return fmt::format("at line {}", during.line());
        case Asked::During::kPasses:
            return "as " + during.passes().axis() + " passes " + number_text(during.passes().mm()) + " mm";
        case Asked::During::kPhase: return "when " + text_of(during.phase());
        case Asked::During::EVENT_NOT_SET: break;
    }
    return "begun";
}

void add_expectations(const Asked::Expect& expect, std::string& text) {
    for (const auto& end : expect.final()) {
        text += "  expect   " + end.axis() + " at " + number_text(end.mm()) + " mm\n";
    }
    if (expect.has_path_within_mm()) {
        text += "  expect   every step within " + number_text(expect.path_within_mm()) + " mm of the commanded line\n";
    }
    if (expect.together_size() > 0) {
        text += "  expect   the same frames: " + listed({expect.together().begin(), expect.together().end()}) + "\n";
    }
    if (expect.has_vetoes()) {
        const std::string names = listed({expect.vetoes().by().begin(), expect.vetoes().by().end()});
        text += "  expect   vetoes by: " + (names.empty() ? "none" : names) + "\n";
    }
    if (expect.has_cause()) { text += "  expect   its cause: " + expect.cause().kind() + "\n"; }
    if (!expect.has_exact() || expect.exact()) { text += "  expect   every step as planned\n"; }
    if (!expect.has_complete() || expect.complete()) { text += "  expect   a record without missing messages\n"; }
}

}  // namespace

std::string text_of(const Asked::Act& act) {
    return what_text(act) + (act.has_for_s() ? " for " + seconds(act.for_s()) : "");
}

std::string text_of(const Asked::During& during) {
    const bool is_later = during.after_s() > 0;
    return event_text(during) + (is_later ? ", " + seconds(during.after_s()) + " later" : "") + ": " +
           text_of(during.act());
}

std::string text_of(const Asked::Step& step) {
    switch (step.what_case()) {
        case Asked::Step::kHome: {
            const auto& axes = step.home().axis();
            return axes.empty() ? "home" : "home " + listed({axes.begin(), axes.end()});
        }
        case Asked::Step::kRun: return "run " + (step.run().has_file() ? step.run().file() : "a program");
        case Asked::Step::kMove: return "move " + listed({step.move().to().begin(), step.move().to().end()});
        case Asked::Step::kWait:
            return step.wait().has_phase() ? "wait until " + text_of(step.wait().phase())
                                           : "wait " + seconds(step.wait().seconds());
        case Asked::Step::kAct: return text_of(step.act());
        case Asked::Step::WHAT_NOT_SET: break;
    }
    return "nothing";
}

std::string text_of(Asked::Step::Ending ending) { return lower(Asked::Step::Ending_Name(ending)); }

std::string text_of(Asked::Phase phase) {
    std::string name = lower(Asked::Phase_Name(phase));
    name.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(name.front())));
    return name;
}

std::string text_of(Asked::Place place) {
    if (place == Asked::CONTAINER) { return "a container each"; }
    return place == Asked::NAMESPACE ? "a network namespace each" : "in one network namespace";
}

std::string outline(const Scenario& scenario) {
    const Asked& asked = scenario.asked;
    std::string text = scenario.file.string() + ": " + asked.shows() + "\n";
    text += "  machine  " + scenario.machine.name + ": " + listed(processes_of(asked, scenario.machine)) + "; " +
            text_of(asked.place()) + "\n";
    for (const auto& clock : asked.wrong_clock()) { text += "  clock    of " + clock.axis() + " is wrong\n"; }
    for (const auto& step : asked.step()) {
        text += "  step     " + text_of(step) + (step.has_ends() ? "; ends " + text_of(step.ends()) : "") +
                (step.has_fault() ? " with " + step.fault() : "") + "\n";
        for (const auto& during : step.during()) { text += "             " + text_of(during) + "\n"; }
    }
    add_expectations(asked.expect(), text);
    return text;
}

}  // namespace lockstep::scenario
