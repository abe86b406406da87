#include "clients/scenario/model/report.hpp"

#include <tinyxml2.h>

#include <filesystem>

#include "clients/text/format.hpp"

namespace lockstep::scenario {
namespace {

constexpr std::size_t kWidth = 100;

std::string line_of(const Check& check) {
    const std::string text = (check.held() ? "holds   " : "FAILED  ") + check.asked() + ": " + check.found() +
                             (check.held() ? "" : " (" + check.where() + ")");
    return "  " + wrapped(text, kWidth, "          ") + "\n";
}

std::string name_of(const proto::ScenarioReport& report) {
    return std::filesystem::path(report.file()).stem().string();
}

/// The failed checks, a line each.
std::string failures(const proto::ScenarioReport& report) {
    std::string text = report.broken().empty() ? "" : report.broken() + "\n";
    for (const Check& check : report.checks()) {
        if (!check.held()) { text += check.asked() + ": " + check.found() + " (" + check.where() + ")\n"; }
    }
    return text;
}

void add_case(tinyxml2::XMLPrinter& xml, const proto::ScenarioReport& report) {
    xml.OpenElement("testcase");
    xml.PushAttribute("classname", "scenario");
    xml.PushAttribute("name", name_of(report).c_str());
    xml.PushAttribute("file", report.file().c_str());
    xml.PushAttribute("time", fixed(report.took_s(), 3).c_str());
    if (!report.held()) {
        const std::string text = failures(report);
        xml.OpenElement(report.broken().empty() ? "failure" : "error");
        xml.PushAttribute("message", text.substr(0, text.find('\n')).c_str());
        xml.PushText(text.c_str());
        xml.CloseElement();
    }
    xml.OpenElement("system-out");
    xml.PushText(to_text(report, true).c_str());
    xml.CloseElement();
    xml.CloseElement();
}

}  // namespace

std::string to_text(const proto::ScenarioReport& report, bool events) {
    std::string text = name_of(report) + ": " + (report.held() ? "holds" : "FAILED") + " (" +
                       fixed(report.took_s(), 1) + " s): " + report.shows() + "\n";
    for (const auto& happening : report.story()) {
        if (events) { text += "  " + fixed(happening.at_s(), 3) + " s  " + happening.what() + "\n"; }
    }
    for (const Check& check : report.checks()) { text += line_of(check); }
    if (!report.broken().empty()) {
        text += "  FAILED  the scenario could not run to its end: " + report.broken() + "\n";
    }
    if (!report.kept().empty()) { text += "  logs: " + report.kept() + "\n"; }
    text.pop_back();
    return text;
}

std::string junit_xml(const proto::ScenarioRunReport& report) {
    int failed = 0;
    int broken = 0;
    double took_s = 0;
    for (const auto& scenario : report.scenarios()) {
        took_s += scenario.took_s();
        if (!scenario.held()) { ++(scenario.broken().empty() ? failed : broken); }
    }
    tinyxml2::XMLPrinter xml;
    xml.PushHeader(false, true);
    xml.OpenElement("testsuites");
    xml.OpenElement("testsuite");
    xml.PushAttribute("name", "lockstep scenarios");
    xml.PushAttribute("tests", report.scenarios_size());
    xml.PushAttribute("failures", failed);
    xml.PushAttribute("errors", broken);
    xml.PushAttribute("time", fixed(took_s, 3).c_str());
    for (const auto& scenario : report.scenarios()) { add_case(xml, scenario); }
    xml.CloseElement();
    xml.CloseElement();
    return xml.CStr();
}

}  // namespace lockstep::scenario
