// lockstep export
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "clients/export/export.hpp"
#include "clients/lockstep/live_options.hpp"
#include "clients/lockstep/verb.hpp"
#include "clients/text/output.hpp"
#include "idl/proto/report.pb.h"

namespace lockstep {
namespace {

using exporting::Exported;
using exporting::Format;

struct ExportOptions {
    std::string log;
    std::string format = "csv";
    std::string out;
    bool force = false;
    bool json = false;
};

std::string place_of(const ExportOptions& options) {
    if (!options.out.empty()) { return options.out; }
    return std::filesystem::path(options.log).replace_extension(options.format).string();
}

proto::ExportReport to_report(const Exported& exported, const ExportOptions& options) {
    proto::ExportReport report;
    report.set_file(place_of(options));
    report.set_format(options.format);
    report.set_samples(exported.samples);
    report.set_left_out(exported.left_out);
    report.set_damages(exported.damages);
    report.set_complete(exported.record.is_complete());
    for (const std::string& line : exported.record.missing) { report.add_missing(line); }
    for (const std::string& line : exported.record.not_known) { report.add_not_known(line); }
    return report;
}

void warn_of_losses(const Exported& exported, Output& output) {
    if (exported.left_out > 0) {
        output.warn(fmt::format("{} samples are left out: they came more than 2 s late, or exceed the number of topics",
                                exported.left_out));
    }
    if (exported.damages > 0) {
        output.warn(fmt::format("{} places in the log cannot be read; see: lockstep analyze", exported.damages));
    }
}

ExitCode export_verb(const ExportOptions& options) {
    Output output(options.json);
    const std::filesystem::path to = place_of(options);
    std::error_code ignored;
    if (std::filesystem::exists(to, ignored) && !options.force) {
        return output.fail(bad_input(to.string() + ": exists already; name another file with --out, or add --force"));
    }
    if (std::filesystem::equivalent(options.log, to, ignored)) {
        return output.fail(bad_input(to.string() + ": is the log itself; name another file with --out"));
    }
    const auto exported = exporting::export_log(options.log, to, options.format == "csv" ? Format::Csv : Format::Mcap,
                                                output.percent_on_terminal("exporting"));
    if (!exported) { return output.fail(bad_input(exported.error())); }
    output.print(fmt::format("{}: {} samples; the record is {}", to.string(), exported->samples,
                             analysis::to_text(exported->record)));
    warn_of_losses(*exported, output);
    output.report(to_report(*exported, options));
    return kExitDone;
}

}  // namespace

void add_export(Verb command) {
    const Verb verb = command.add_verb("export",
                                       "write a log in a format of PlotJuggler and Foxglove\n"
                                       "The file contains positions, states, health and jobs.");
    const auto options = std::make_shared<ExportOptions>();
    verb.add_option("log", options->log, "an LCM log, of lcm-logger or of lockstep simulate").required();
    verb.add_option("--format", options->format, "csv: PlotJuggler, spreadsheets; mcap: Foxglove, PlotJuggler")
        .one_of({"csv", "mcap"})
        .with_default();
    verb.add_option("--out", options->out, "the file to write; default: beside the log");
    verb.add_flag("--force", options->force, "replace an existing file");
    add_json(verb, options->json);
    verb.footer(
        "csv: one table. Its first column is time_s, which counts from the log's first sample. Each signal has a\n"
        "column with its unit in the name, such as mill/X/position_mm, mill/X/velocity_mm_s, mill/X/state and\n"
        "mill/X/fault. A cell is empty if there was no value at that time. In PlotJuggler, load the file and\n"
        "choose time_s as the time axis.\n"
        "mcap: a topic for each axis and kind, such as /mill/X/position; its messages are JSON with the same names.\n"
        "For the tick of every step use: lockstep analyze LOG --csv DIR\n" +
        footer("  lockstep export plate.lcm\n  lockstep export plate.lcm --format mcap --out plate.mcap\n",
               "0 written; 2 bad usage, no log with values to export, or the file cannot be written"));
    verb.action([options] { return export_verb(*options); });
}

}  // namespace lockstep
