#include "clients/report_page/report_page.hpp"

#include <fstream>
#include <map>

#include "clients/analysis/report.hpp"
#include "clients/analysis/verdict.hpp"
#include "clients/analysis/words.hpp"
#include "clients/drawing/svg.hpp"
#include "clients/report_page/page_charts.hpp"
#include "clients/report_page/page_template.hpp"
#include "services/documents/report_json.hpp"
#include "services/documents/text_file.hpp"

namespace lockstep::analysis {
namespace {

constexpr std::string_view kMark = R"(<meta name="generator" content="lockstep analyze">)";
constexpr std::size_t kMarkWithin = 1024;  // bytes of the page

/// JSON that may stand within a page: no tag begins or ends in it.
std::string within_page(std::string json) {
    std::string out;
    out.reserve(json.size());
    for (const char c : json) { c == '<' ? void(out += "\\u003c") : out.push_back(c); }
    return out;
}

std::string findings_list(const std::vector<Finding>& found) {
    std::string out;
    for (const Finding& finding : found) {
        out +=
            "<li class=\"" + std::string(name_of(finding.grade)) + "\">" + drawing::escape_xml(finding.text) + "</li>";
    }
    return out;
}

/// The template with each @NAME@ replaced by its text, once over: what is put in is not looked at again.
std::string filled(std::string_view page, const std::map<std::string_view, std::string>& texts) {
    std::string out;
    for (;;) {
        const std::size_t from = page.find('@');
        const std::size_t to = from == page.npos ? page.npos : page.find('@', from + 1);
        const auto text = to == page.npos ? texts.end() : texts.find(page.substr(from + 1, to - from - 1));
        if (to == page.npos) { return out.append(page); }
        if (text == texts.end()) {
            out.append(page.substr(0, to));
            page.remove_prefix(to);
            continue;
        }
        out.append(page.substr(0, from)).append(text->second);
        page.remove_prefix(to + 1);
    }
}

}  // namespace

std::string to_html(const Analysis& analysis) {
    const auto found = findings(analysis);
    return filled(kPageTemplate,
                  {{"TITLE", drawing::escape_xml(analysis.machine + ": " + analysis.log.filename().string())},
                   {"SUBTITLE", drawing::escape_xml(in_a_line(analysis))},
                   {"GRADE", std::string(name_of(verdict(found)))},
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

std::expected<void, std::string> write_html(const Analysis& analysis, const std::filesystem::path& path) {
    return write_text_file(path, to_html(analysis));
}

}  // namespace lockstep::analysis
