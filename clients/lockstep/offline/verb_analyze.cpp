// lockstep analyze
#include <expected>
#include <filesystem>
#include <memory>
#include <sstream>

#include "clients/analysis/analysis.hpp"
#include "clients/analysis/analysis_text.hpp"
#include "clients/analysis/report.hpp"
#include "clients/lockstep/live_options.hpp"
#include "clients/lockstep/offline/analyze_incident.hpp"
#include "clients/lockstep/verb.hpp"
#include "clients/report_page/report_page.hpp"
#include "clients/text/colour.hpp"
#include "clients/text/output.hpp"

namespace lockstep {
namespace {

struct AnalyzeOptions {
    std::vector<std::string> paths;
    std::string log;  // the only path, without --incident
    bool incident = false;
    int back = 0;
    bool all = false;
    std::string svg_dir;
    std::string csv_dir;
    std::string html;
    std::string machine;
    bool no_html = false;
    bool json = false;
    bool no_colour = false;
};

bool tells_of_trouble(const std::string& line) {
    const bool missing = line.find(" missing") != line.npos && line.find("nothing missing") == line.npos;
    return line.starts_with("damaged") || (missing && !line.starts_with("axis "));  // excludes the table's header
}

/// Highlights missing and damaged data.
std::string coloured(const std::string& text) {
    std::istringstream lines(text);
    std::string out;
    for (std::string line; std::getline(lines, line);) {
        out += (tells_of_trouble(line) ? painted(line, kBad) : line) + "\n";
    }
    return out;
}

/// The page's path: as the user gave it, else beside the log.
std::filesystem::path page_path(const AnalyzeOptions& options) {
    if (!options.html.empty()) { return options.html; }
    auto path = std::filesystem::path(options.log);
    return path.replace_extension(".html");
}

bool wants_page(const AnalyzeOptions& options) { return !options.html.empty() || !(options.no_html || options.json); }

/// Returns the path of the written page, or an empty path if none was written. Fails only if the page was requested.
std::expected<std::filesystem::path, std::string> write_page(const AnalyzeOptions& options,
                                                             const analysis::Analysis& found, Output& output) {
    if (!wants_page(options)) { return std::filesystem::path(); }
    const bool asked = !options.html.empty();
    auto path = page_path(options);
    std::string problem;
    if (!analysis::may_replace(path)) {
        problem = analysis::in_the_way(path);
    } else if (const auto written = analysis::write_html(found, path); !written) {
        problem = written.error();
    } else {
        return path;
    }
    if (asked) { return std::unexpected(problem); }
    output.warn("no report page: " + problem);
    return std::filesystem::path();
}

ExitCode analyze_log(const AnalyzeOptions& options) {
    Output output(options.json);
    if (!options.html.empty() && !analysis::may_replace(options.html)) {
        return output.fail(bad_input(analysis::in_the_way(options.html)));  // fail before a long log is read
    }
    analysis::AnalysisOptions what;
    if (!options.svg_dir.empty()) { what.svg_dir = options.svg_dir; }
    if (!options.csv_dir.empty()) { what.csv_dir = options.csv_dir; }
    if (!options.machine.empty()) { what.machine = options.machine; }
    what.curves = wants_page(options);
    what.progress = output.percent_on_terminal("reading");
    const auto found = analysis::analyze_log(options.log, what);
    if (!found) { return output.fail(bad_input(found.error())); }
    std::string text = analysis::summary(*found);
    const auto page = write_page(options, *found, output);
    if (!page) { return output.fail(bad_input(page.error())); }
    if (wants_colour() && !options.no_colour) { text = coloured(text); }
    if (text.ends_with('\n')) { text.pop_back(); }
    output.print(text);
    if (!page->empty()) { output.print("\nreport: " + page->string()); }
    output.report(analysis::to_report(*found));
    return kExitDone;
}

ExitCode analyze(AnalyzeOptions options) {
    if (options.incident) {
        IncidentOptions incident = split_paths(options.paths);
        incident.back = options.back;
        incident.all = options.all;
        if (!options.html.empty()) { incident.html = options.html; }
        incident.no_html = options.no_html;
        incident.json = options.json;
        incident.no_colour = options.no_colour;
        return analyze_incident(incident);
    }
    if (options.paths.size() > 1) {
        return Output(options.json)
            .fail(bad_input(options.paths[1] + ": name only one log; lockstep log merge combines several logs, and "
                                               "--incident accepts several incident files"));
    }
    options.log = options.paths.front();
    return analyze_log(options);
}

}  // namespace

void add_analyze(Verb command) {
    const Verb verb = command.add_verb("analyze", "report a log's content and what it lacks; or an incident's cause");
    const auto options = std::make_shared<AnalyzeOptions>();
    verb.add_option("log", options->paths,
                    "an LCM log, of lcm-logger or of lockstep simulate; with --incident: incident files, or their "
                    "directory, and optionally the log of the run")
        .required();
    const Argument incident =
        verb.add_flag("--incident", options->incident,
                      "report what all processes received, decided and published around a fault, and its cause");
    verb.add_option("--back", options->back, "with --incident: the incident that is this many before the newest one")
        .needs(incident);
    verb.add_flag("--all", options->all, "with --incident: also list routine events").needs(incident);
    verb.add_option("--html", options->html, "the report page to write; default: LOG.html beside the log");
    verb.add_flag("--no-html", options->no_html, "write no report page; with --json only --html writes one");
    verb.add_option("--svg", options->svg_dir,
                    "draw speed.svg, position.svg, xy.svg, and with outputs outputs.svg and power.svg");
    verb.add_option("--csv", options->csv_dir, "write every step and position of each axis into this directory");
    verb.add_option("--machine", options->machine,
                    "the name of the machine to analyze if the log has several; default: that of its first message");
    add_json(verb, options->json);
    verb.add_flag("--no-color", options->no_colour, "use no colours, also on a terminal");
    verb.footer(
        footer("  lockstep analyze plate.lcm                 # and plate.html\n"
               "  lockstep analyze plate.lcm --svg pictures --csv tables\n"
               "  lockstep analyze plate.lcm --json          # verdict: good, doubtful, unknown or bad\n"
               "  lockstep analyze --incident /var/lib/lockstep/mill/record/incidents plate.lcm\n\n"
               "A log that is damaged, cut short or partly of another version is read as far as possible. The\n"
               "report lists unreadable parts by their bytes, and the exit code is 0. If nothing in the log can\n"
               "be read, it is 2.\n"));
    verb.action([options] { return analyze(*options); });
}

}  // namespace lockstep
