#include "clients/scenario/model/expectation_text.hpp"

#include <fmt/format.h>

#include "clients/scenario/model/problems.hpp"
#include "clients/scenario/model/scenario_text.hpp"
#include "core/number_text.hpp"

namespace lockstep::scenario {
namespace {

std::string asked_mm(double mm) { return number_text(mm) + " mm"; }

std::vector<std::string> names_of(const auto& names) { return {names.begin(), names.end()}; }

}  // namespace

std::string text_of(const Asked::Final& end) {
    return end.axis() + " at " + asked_mm(end.mm()) +
           (end.has_within_mm() ? " within " + asked_mm(end.within_mm()) : " to the step");
}

std::string text_of(const Asked::Vetoes& vetoes) { return "vetoes by " + listed_or_none(names_of(vetoes.by())); }

std::string text_of(const Asked::Cause& cause) {
    return "cause " + cause.kind() + (cause.has_process() ? " of " + cause.process() : "");
}

std::string path_text(const Asked::Expect& expect) {
    return "every step within " + asked_mm(expect.path_within_mm()) + " of the commanded line";
}

std::string interruptions_text(const Asked::Expect& expect) {
    return plural(expect.interruptions(), "interruption") + " of jobs";
}

std::string together_text(const Asked::Expect& expect) {
    return listed(names_of(expect.together())) + " ended each epoch with the same frame";
}

std::string phase_text(const Asked::Expect& expect) {
    return "the machine is " + text_of(expect.phase()) + " at the end";
}

std::string received_text(const Asked::AxisEnd& end) {
    return end.name() + (end.heard() ? " received" : " not received");
}

std::string corrected_text(const Asked::AxisEnd& end) {
    return fmt::format("{} made up {} lost steps", end.name(), end.corrected_steps());
}

std::string homed_text(const Asked::AxisEnd& end) { return end.name() + (end.homed() ? " homed" : " not homed"); }

std::string fault_text(const Asked::AxisEnd& end) { return end.name() + " has fault " + end.fault(); }

std::string listed_or_none(const std::vector<std::string>& names) { return names.empty() ? "none" : listed(names); }

std::vector<std::string> expectation_texts(const Asked::Expect& expect) {
    std::vector<std::string> texts;
    for (const auto& end : expect.final()) { texts.push_back(text_of(end)); }
    if (expect.has_path_within_mm()) { texts.push_back(path_text(expect)); }
    if (expect.has_interruptions()) { texts.push_back(interruptions_text(expect)); }
    if (expect.together_size() > 0) { texts.push_back(together_text(expect)); }
    if (expect.has_vetoes()) { texts.push_back(text_of(expect.vetoes())); }
    if (expect.has_cause()) { texts.push_back(text_of(expect.cause())); }
    for (const auto& end : expect.axis()) {
        if (end.has_heard()) { texts.push_back(received_text(end)); }
        if (end.has_homed()) { texts.push_back(homed_text(end)); }
        if (end.has_fault()) { texts.push_back(fault_text(end)); }
        if (end.has_corrected_steps()) { texts.push_back(corrected_text(end)); }
    }
    if (expect.has_phase()) { texts.push_back(phase_text(expect)); }
    if (!expect.has_exact() || expect.exact()) { texts.emplace_back(kExactText); }
    if (!expect.has_complete() || expect.complete()) { texts.emplace_back(kCompleteText); }
    return texts;
}

}  // namespace lockstep::scenario
