#include "clients/report_page/incident_page.hpp"

#include <fmt/format.h>

#include "clients/drawing/svg.hpp"
#include "clients/report_page/page_charts.hpp"
#include "clients/report_page/page_parts.hpp"
#include "clients/report_page/page_template.hpp"
#include "services/documents/report_json.hpp"
#include "services/files/text_file.hpp"

namespace lockstep::incident {
namespace {

/// Omits the first sentence, the cause, because the page shows it above.
std::string story_list(const proto::IncidentReport& report) {
    std::string out;
    for (int i = 1; i < report.story_size(); ++i) { out += "<li>" + drawing::escape_xml(report.story(i)) + "</li>"; }
    return out;
}

/// The log's curves, and offset_s: their times begin at the log's first step, the page's when the incident was noticed.
std::string log_charts(const proto::IncidentReport& report, const analysis::Analysis* log) {
    if (log == nullptr || !log->first_tick()) { return "null"; }
    std::string charts = analysis::page_charts(*log);
    const double offset_s = log->seconds(*log->first_tick() - Tick{report.noticed_tick()});
    return charts.insert(1, fmt::format("\"offset_s\":{:.6f},", offset_s));
}

}  // namespace

std::string to_html(const proto::IncidentReport& report, const analysis::Analysis* log) {
    const std::string cause = report.story().empty() ? report.cause() : report.story(0);
    return analysis::filled(analysis::kIncidentTemplate,
                            {{"TITLE", drawing::escape_xml(report.machine() + ": incident")},
                             {"SUBTITLE", drawing::escape_xml(fmt::format(
                                              "recorded {} \u00b7 {} processes \u00b7 {} notes", report.written(),
                                              report.processes_size(), report.events_size()))},
                             {"CAUSE", drawing::escape_xml(cause)},
                             {"STORY", story_list(report)},
                             {"REPORT", analysis::within_page(report_json(report))},
                             {"CHARTS", analysis::within_page(log_charts(report, log))}});
}

std::expected<void, std::string> write_html(const proto::IncidentReport& report, const analysis::Analysis* log,
                                            const std::filesystem::path& path) {
    return write_text_file(path, to_html(report, log));
}

}  // namespace lockstep::incident
