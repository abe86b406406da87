#include "clients/lockstep/offline/analyze_incident.hpp"

#include <fmt/format.h>

#include <algorithm>

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

/// The name of the first of the incident's files.
std::string first_file(const incident::Incident& incident) {
    std::string first;
    for (const incident::Process& process : incident.processes) {
        for (const std::string& file : process.files) {
            if (first.empty() || file < first) { first = file; }
        }
    }
    return first;
}

/// The page's path: as the user gave it, else beside the incident files, named like the first of them. If a file holds
/// several incidents, the pages of all but the first are numbered.
fs::path page_path(const IncidentOptions& options, const IncidentInput& input, std::size_t chosen) {
    if (options.html) { return *options.html; }
    const std::string first = first_file(input.incidents[chosen]);
    const auto before = input.incidents.begin() + static_cast<std::ptrdiff_t>(chosen);
    const auto same = std::count_if(input.incidents.begin(), before,
                                    [&](const incident::Incident& other) { return first_file(other) == first; });
    const fs::path file(first);
    const std::string name = file.filename().string();
    const std::string number = same == 0 ? "" : fmt::format("-{}", same + 1);
    return file.parent_path() / (name.substr(0, name.find('-')) + number + ".html");
}

/// Returns the path of the written page, or an empty path if none was written. Fails only if the log cannot be read, or
/// if the page was requested and cannot be written.
std::expected<fs::path, std::string> write_page(const IncidentOptions& options, const fs::path& path,
                                                const proto::IncidentReport& report, Output& output) {
    std::optional<analysis::Analysis> log;
    if (options.log) {
        auto found = analysis::analyze_log(*options.log, {.machine = report.machine()});
        if (!found) { return std::unexpected(found.error()); }
        log = std::move(*found);
    }
    if (!options.html && (options.no_html || options.json)) { return fs::path(); }
    const auto written = analysis::may_replace(path) ? incident::write_html(report, log ? &*log : nullptr, path)
                                                     : std::unexpected(analysis::in_the_way(path));
    if (written) { return path; }
    if (options.html) { return std::unexpected(written.error()); }
    output.warn("no report page: " + written.error());
    return fs::path();
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
    const std::size_t chosen = count - 1 - static_cast<std::size_t>(options.back);
    const incident::Incident& incident = input->incidents[chosen];
    const incident::Evaluation evaluation = incident::evaluate(incident);
    proto::IncidentReport report = incident::to_report(incident, evaluation);
    report.set_earlier(static_cast<std::int64_t>(chosen));
    report.set_back(options.back);
    incident::add_summaries(input->incidents, report);
    std::string text = incident::to_text(
        incident, evaluation, {.least = options.all ? incident::Weight::Routine : incident::Weight::Notable});
    if (wants_colour() && !options.no_colour) { text = coloured_incident(text); }
    if (count > 1) { text += "\n" + incident::list_text(report); }
    const auto page = write_page(options, page_path(options, *input, chosen), report, output);
    if (!page) { return output.fail(bad_input(page.error())); }
    report.set_page(page->string());
    if (text.ends_with('\n')) { text.pop_back(); }
    output.print(text);
    if (!page->empty()) { output.print("\nreport: " + page->string()); }
    output.report(report);
    return kExitDone;
}

}  // namespace lockstep
