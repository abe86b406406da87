#include "clients/scenario/model/scenario_text.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "clients/scenario/model/expectation_text.hpp"
#include "clients/scenario/model/output_course.hpp"
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
    return fmt::format("lose {} % at {}, {}", number_text(loss.percent()), names,
                       way_text(loss.has_way() ? loss.way() : Asked::HEARS));
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
        case Act::kCloseInput: return "close input " + act.close_input();
        case Act::kOpenInput: return "open input " + act.open_input();
        case Act::kPush: return fmt::format("push {} by {} mm", act.push().motor(), number_text(act.push().mm()));
        case Act::WHAT_NOT_SET: break;
    }
    return "nothing";
}

std::string move_text(const Asked::Move& move) {
    return "move " + listed({move.to().begin(), move.to().end()}) +
           (move.has_feed_mm_min() ? " at " + number_text(move.feed_mm_min()) + " mm/min" : "");
}

std::string event_text(const Asked::During& during) {
    switch (during.event_case()) {
        case Asked::During::kLine: return fmt::format("at line {}", during.line());
        case Asked::During::kPasses:
            return fmt::format("as {} passes {} mm", during.passes().axis(), number_text(during.passes().mm()));
        case Asked::During::kPhase: return "when " + text_of(during.phase());
        case Asked::During::EVENT_NOT_SET: break;
    }
    return "begun";
}

std::string clock_text(const Asked::WrongClock& clock) {
    std::string text = "of " + clock.axis() + " is wrong:";
    if (clock.has_offset_s()) { text += " " + seconds(clock.offset_s()) + " ahead;"; }
    if (clock.has_ppm()) { text += " " + number_text(clock.ppm()) + " ppm fast;"; }
    if (clock.has_step_s()) { text += " set forward by " + seconds(clock.step_s()); }
    if (clock.has_step_at_s()) { text += " at " + seconds(clock.step_at_s()) + " after its start"; }
    if (clock.has_step_s() || clock.has_step_at_s()) { text += ";"; }
    text.pop_back();
    return text;
}

std::string setup_text(const Scenario& scenario) {
    const Asked& asked = scenario.asked;
    std::string text = scenario.machine.name;
    if (asked.has_machine_file()) { text += " of " + asked.machine_file(); }
    text += ": " + listed(processes_of(asked, scenario.machine)) + "; " + text_of(asked.place());
    if (asked.continues()) { text += "; coordinator-2 continues a program in motion"; }
    return text;
}

/// The lines of a program, each below the other.
std::string gcode_text(const std::string& gcode) {
    std::string text;
    for (std::size_t at = 0; at < gcode.size();) {
        const std::size_t end = std::min(gcode.find('\n', at), gcode.size());
        text += "           | " + gcode.substr(at, end - at) + "\n";
        at = end + 1;
    }
    return text;
}

std::string step_text(const Asked::Step& step) {
    std::string text = text_of(step);
    if (step.has_ends()) { text += "; ends " + text_of(step.ends()); }
    if (step.has_fault()) { text += (step.has_ends() ? " with " : "; with ") + step.fault(); }
    return text;
}

void add_step(const Asked::Step& step, std::string& text) {
    text += "  step     " + step_text(step) + "\n";
    if (step.run().has_gcode()) { text += gcode_text(step.run().gcode()); }
    for (const auto& during : step.during()) {
        text += "             " + text_of(during);
        if (during.has_rests_within_frames()) {
            text += fmt::format("; at rest within {} frames", during.rests_within_frames());
        }
        for (const auto& output : during.output()) { text += "; " + text_of(output); }
        text += "\n";
    }
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
        case Asked::Step::kMove: return move_text(step.move());
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
    text += "  machine  " + setup_text(scenario) + "\n";
    for (const auto& clock : asked.wrong_clock()) { text += "  clock    " + clock_text(clock) + "\n"; }
    for (const auto& step : asked.step()) { add_step(step, text); }
    for (const std::string& expected : expectation_texts(asked.expect())) { text += "  expect   " + expected + "\n"; }
    if (asked.expect().has_exact() && !asked.expect().exact()) {
        text += "  skip     " + std::string(kExactText) + "\n";
    }
    if (asked.expect().has_complete() && !asked.expect().complete()) {
        text += "  skip     " + std::string(kCompleteText) + "\n";
    }
    return text;
}

}  // namespace lockstep::scenario
