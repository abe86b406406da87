#include "clients/report_page/report_page.hpp"

#include <fmt/format.h>

#include <fstream>

#include "clients/analysis/analysis_text.hpp"
#include "clients/analysis/findings.hpp"
#include "clients/analysis/record_state.hpp"
#include "clients/analysis/report.hpp"
#include "clients/drawing/svg.hpp"
#include "clients/report_page/page_charts.hpp"
#include "clients/report_page/page_parts.hpp"
#include "clients/report_page/page_template.hpp"
#include "core/enumeration.hpp"
#include "services/documents/report_json.hpp"
#include "services/files/text_file.hpp"

namespace lockstep::analysis {
namespace {

constexpr std::string_view kMark = R"(<meta name="generator" content="lockstep analyze">)";
constexpr std::size_t kMarkWithin = 1024;  // at the beginning of the page

/// The symbol of a grade: check mark, exclamation mark, question mark, cross. As in web/tables.js.
std::string_view mark_of(Grade grade) { return pick_name({"\u2713", "!", "?", "\u2717"}, grade); }

std::string findings_list(const std::vector<Finding>& found) {
    std::string out;
    for (const Finding& finding : found) {
        out += fmt::format(R"(<li class="{0}"><b><span class="mark">{1}</span>{0}</b><span>{2}</span></li>)",
                           name_of(finding.grade), mark_of(finding.grade), drawing::escape_xml(finding.text));
    }
    return out;
}

}  // namespace

std::string to_html(const Analysis& analysis) {
    const auto found = findings(analysis);
    return filled(kPageTemplate,
                  {{"TITLE", drawing::escape_xml(analysis.machine + ": " + analysis.log.filename().string())},
                   {"SUBTITLE", drawing::escape_xml(in_a_line(analysis))},
                   {"RECORD", drawing::escape_xml(to_text(record_state(analysis)))},
                   {"MARK", std::string(mark_of(worst_grade(found)))},
                   {"GRADE", std::string(name_of(worst_grade(found)))},
                   {"FINDINGS", findings_list(found)},
                   {"REPORT", within_page(report_json(to_report(analysis)))},
                   {"CHARTS", within_page(page_charts(analysis))}});
}

bool may_replace(const std::filesystem::path& path) {
    std::error_code error;
    if (!std::filesystem::exists(path, error)) { return true; }
    std::string beginning(kMarkWithin, '\0');
    std::ifstream file(path, std::ios::binary);
    file.read(beginning.data(), static_cast<std::streamsize>(beginning.size()));
    return beginning.find(kMark) != std::string::npos;
}

std::string in_the_way(const std::filesystem::path& path) {
    return path.string() +
           ": exists already and is not a report, so it is not replaced; name another file with --html FILE";
}

std::expected<void, std::string> write_html(const Analysis& analysis, const std::filesystem::path& path) {
    return write_text_file(path, to_html(analysis));
}

}  // namespace lockstep::analysis
