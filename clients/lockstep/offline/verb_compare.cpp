// lockstep compare
#include <fmt/format.h>

#include <iostream>
#include <memory>

#include "clients/lockstep/live_options.hpp"
#include "clients/lockstep/verb.hpp"
#include "clients/methods/comparison.hpp"
#include "clients/methods/comparison_text.hpp"
#include "clients/methods/figures.hpp"
#include "clients/methods/move_text.hpp"
#include "clients/methods/report.hpp"
#include "clients/text/output.hpp"
#include "services/files/text_file.hpp"

namespace lockstep {
namespace {

struct CompareOptions {
    std::string move{comparison::kDefaultMove};
    std::vector<std::string> methods;
    std::string svg;
    std::string lines_svg;
    std::string html;
    bool csv = false;
    bool json = false;
};

std::expected<std::vector<methods::Method>, std::string> chosen(const std::vector<std::string>& names) {
    const auto all = methods::methods();
    if (names.empty()) { return std::vector<methods::Method>(all.begin(), all.end()); }
    std::vector<methods::Method> found;
    for (const std::string& name : names) {
        const methods::Method* method = methods::find_method(name);
        if (method == nullptr) {
            std::string known;
            for (const auto& one : all) { known += " " + std::string(one.name); }
            return std::unexpected(fmt::format("--method: no method is called '{}'; choose from{}", name, known));
        }
        found.push_back(*method);
    }
    return found;
}

std::expected<void, std::string> write_files(const CompareOptions& options, const comparison::Comparison& result) {
    std::expected<void, std::string> done;
    if (!options.svg.empty()) { done = write_text_file(options.svg, drawing::to_svg(comparison_figure(result))); }
    if (done && !options.lines_svg.empty()) {
        done = write_text_file(options.lines_svg, drawing::to_svg(comparison::lines_figure()));
    }
    if (done && !options.html.empty()) { done = write_text_file(options.html, to_html(result)); }
    return done;
}

ExitCode compare_verb(const CompareOptions& options) {
    Output output(options.json);
    const auto move = comparison::parse_move(options.move);
    if (!move) { return output.fail(bad_input("--move " + move.error())); }
    const auto methods = chosen(options.methods);
    if (!methods) { return output.fail(bad_input(methods.error())); }
    const auto result = comparison::compare(*move, *methods);
    if (auto written = write_files(options, result); !written) { return output.fail(bad_input(written.error())); }
    if (options.csv) {
        std::cout << to_csv(result);
        return kExitDone;
    }
    std::string text = to_text(result);
    text.pop_back();
    output.print(text);
    output.report(to_report(result));
    return kExitDone;
}

}  // namespace

void add_compare(Verb command) {
    const Verb verb =
        command.add_verb("compare",
                         "make one move by five published methods, and compare the steps\n"
                         "The command reports how far the steps of each method are from the ideal times. It "
                         "needs no machine.");
    const auto options = std::make_shared<CompareOptions>();
    verb.add_option("--move", options->move, "STEPS,START,MAX,ACCEL[,DECEL] in steps, steps/s and steps/s^2")
        .with_default();
    verb.add_option("--method", options->methods,
                    "compare only this method: ranade, spielauer, lai, lam, carrica, off-line; may be repeated");
    verb.add_option("--svg", options->svg, "draw speed and step time error of each method into this file");
    verb.add_option("--lines-svg", options->lines_svg, "draw the six lines with and without the DDA into this file");
    verb.add_option("--html", options->html, "write tables and figures into this file, as one page");
    const Argument csv =
        verb.add_flag("--csv", options->csv, "every step on standard output: method,step,time_s,error_us");
    add_json(verb, options->json).excludes(csv);
    verb.footer("A method that cannot express the move makes the nearest one it can, and reports the change.\n" +
                footer("  lockstep compare\n  lockstep compare --move 4000,0,1000,1000 --svg compare.svg\n"
                       "  lockstep compare --method ranade --method carrica --csv > steps.csv\n"));
    verb.action([options] { return compare_verb(*options); });
}

}  // namespace lockstep
