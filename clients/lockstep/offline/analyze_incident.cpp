#include "clients/lockstep/offline/analyze_incident.hpp"

#include <fmt/format.h>

#include "clients/incident/incident_input.hpp"
#include "clients/incident/incident_report.hpp"
#include "clients/lockstep/offline/incident_text.hpp"
#include "clients/report_page/incident_page.hpp"
#include "clients/report_page/report_page.hpp"
#include "clients/text/colour.hpp"
#include "clients/text/output.hpp"

namespace lockstep {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kIncidentEnd = ".flight.lcm";

/// Highlights the story.
std::string coloured_incident(const std::string& text) {
    const std::size_t from = text.find("\n\n") + 2;
    const std::size_t to = text.find("\n\n", from);
    return text.substr(0, from) + painted(text.substr(from, to - from), kBold) + text.substr(to);
}

/// The page's path: as the user gave it, else beside the incident files, named like the first of them.
fs::path page_path(const IncidentOptions& options, const proto::IncidentReport& report) {
    if (options.html) { return *options.html; }
    std::string first;
    for (const auto& process : report.processes()) {
        if (first.empty() || process.files(0) < first) { first = process.files(0); }
    }
    const fs::path file(first);
    const std::string name = file.filename().string();
    return file.parent_path() / (name.substr(0, name.find('-')) + ".html");
}

/// Returns the path of the written page, or an empty path if none was written. Fails only if the log cannot be read, or
/// if the page was requested and cannot be written.
std::expected<fs::path, std::string> write_page(const IncidentOptions& options, const proto::IncidentReport& report,
                                                Output& output) {
    std::optional<analysis::Analysis> log;
    if (options.log) {
        auto found = analysis::analyze_log(*options.log, {.machine = report.machine()});
        if (!found) { return std::unexpected(found.error()); }
        log = std::move(*found);
    }
    if (!options.html && (options.no_html || options.json)) { return fs::path(); }
    fs::path path = page_path(options, report);
    const auto written = analysis::may_replace(path) ? incident::write_html(report, log ? &*log : nullptr, path)
                                                     : std::unexpected(analysis::in_the_way(path));
    if (written) { return path; }
    if (options.html) { return std::unexpected(written.error()); }
    output.warn("no report page: " + written.error());
    return fs::path();
}

std::string earlier_text(int back, std::size_t earlier) {
    return fmt::format("{} earlier incident{} in the same files: --back {}{}", earlier, earlier == 1 ? "" : "s",
                       back + 1, earlier == 1 ? "" : " and on");
}

}  // namespace

IncidentOptions split_paths(const std::vector<std::string>& paths) {
    IncidentOptions options;
    for (const std::string& path : paths) {
        std::error_code error;
        const bool is_incident = path.ends_with(kIncidentEnd) || fs::is_directory(path, error);
        if (is_incident || paths.size() == 1 || options.log) {
            options.incidents.emplace_back(path);
        } else {
            options.log = path;
        }
    }
    return options;
}

ExitCode analyze_incident(const IncidentOptions& options) {
    Output output(options.json);
    if (options.html && !analysis::may_replace(*options.html)) {
        return output.fail(bad_input(analysis::in_the_way(*options.html)));
    }
    auto input = read_incidents(options.incidents);
    if (!input) { return output.fail(bad_input(input.error())); }
    for (const std::string& left_out : input->left_out) { output.warn(left_out); }
    const std::size_t count = input->incidents.size();
    if (options.back < 0 || static_cast<std::size_t>(options.back) >= count) {
        return output.fail(bad_input(fmt::format("--back {}: the files hold {} incidents, so it goes from 0 to {}",
                                                 options.back, count, count - 1)));
    }
    const std::size_t earlier = count - 1 - static_cast<std::size_t>(options.back);
    const incident::Incident& incident = input->incidents[earlier];
    const incident::Evaluation evaluation = incident::evaluate(incident);
    proto::IncidentReport report = incident::to_report(incident, evaluation);
    report.set_earlier(static_cast<std::int64_t>(earlier));
    std::string text = incident::to_text(
        incident, evaluation, {.least = options.all ? incident::Weight::Routine : incident::Weight::Notable});
    if (wants_colour() && !options.no_colour) { text = coloured_incident(text); }
    if (earlier > 0) { text += earlier_text(options.back, earlier) + "\n"; }
    const auto page = write_page(options, report, output);
    if (!page) { return output.fail(bad_input(page.error())); }
    report.set_page(page->string());
    if (text.ends_with('\n')) { text.pop_back(); }
    output.print(text);
    if (!page->empty()) { output.print("\nreport: " + page->string()); }
    output.report(report);
    return kExitDone;
}

}  // namespace lockstep
