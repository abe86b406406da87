#include "clients/methods/comparison_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "clients/drawing/svg.hpp"
#include "clients/methods/figures.hpp"
#include "clients/methods/move_text.hpp"

namespace lockstep::comparison {
namespace {

constexpr std::string_view kRow = "{:<10} {:>8} {:>11} {:>8} {:>10} {:>10} {:>12} {:>11} {:>8}\n";

std::string error_text(double us) { return fmt::format("{:.1f}", us); }

std::string row_text(const Row& row) {
    if (!row.outcome) { return fmt::format("{:<10} {:>8}\n", row.method.name, "refused"); }
    const Outcome& made = *row.outcome;
    return fmt::format(kRow, row.method.name, made.train.times_s.size(), fmt::format("{:.6f}", made.duration_s),
                       fmt::format("{:.4f}", made.ratio), fmt::format("{:.1f}", made.peak_speed),
                       made.peak_acceleration ? fmt::format("{:.0f}", *made.peak_acceleration) : "-",
                       error_text(made.largest_error_us), error_text(made.rms_error_us),
                       row.method.crossing == Crossing::Half ? "k - 1/2" : "k");
}

std::string method_table(const Comparison& comparison) {
    std::string text = move_text(comparison.move) + "\n\n";
    text += fmt::format(kRow, "method", "steps", "last step s", "to ideal", "peak /s", "peak /s^2", "largest us",
                        "rms us", "step at");
    const double steepest = std::max(comparison.move.acceleration, comparison.move.deceleration);
    text += fmt::format(kRow, "ideal", comparison.move.steps, fmt::format("{:.6f}", comparison.ideal_s), "1.0000",
                        fmt::format("{:.1f}", comparison.ideal_peak), fmt::format("{:.0f}", steepest), "-", "-", "k");
    for (const Row& row : comparison.rows) { text += row_text(row); }
    return text;
}

std::string notes(const Comparison& comparison) {
    std::string text;
    for (const Row& row : comparison.rows) {
        const std::string& note = row.outcome ? row.outcome->train.nearest : row.outcome.error();
        if (!note.empty()) { text += fmt::format("{}: {}\n", row.method.name, note); }
    }
    return text.empty() ? text : "\n" + text;
}

std::string line_table(const Comparison& comparison) {
    std::string text = fmt::format("\n{:<18} {:>16} {:>16} {:>16} {:>16}\n", "line (lai)", "off it, no DDA",
                                   "off it, DDA", "peak /s, no DDA", "peak /s, DDA");
    for (const LineDeviation& line : comparison.lines) {
        text += fmt::format("({},0) to (5,5)     {:>16.2f} {:>16.2f} {:>16.0f} {:>16.0f}\n", line.from_x,
                            line.without_dda, line.with_dda, line.rate_without_dda, line.rate_with_dda);
    }
    return text;
}

}  // namespace

std::string to_text(const Comparison& comparison) {
    return method_table(comparison) + notes(comparison) + line_table(comparison);
}

std::string to_csv(const Comparison& comparison) {
    std::string text = "method,step,time_s,error_us\n";
    for (const Row& row : comparison.rows) {
        if (!row.outcome) { continue; }
        for (std::size_t i = 0; i < row.outcome->errors_us.size(); ++i) {
            fmt::format_to(std::back_inserter(text), "{},{},{:.9f},{:.3f}\n", row.method.name, i + 1,
                           row.outcome->train.times_s[i], row.outcome->errors_us[i]);
        }
    }
    return text;
}

std::string to_html(const Comparison& comparison) {
    return fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>Ways to make "
        "steps</title>\n"
        "<style>body {{ font-family: sans-serif; margin: 2em; }} pre {{ overflow-x: auto; }}</style>\n</head>\n<body>\n"
        "<pre>{}</pre>\n{}\n{}\n</body>\n</html>\n",
        drawing::escape_xml(to_text(comparison)), drawing::to_svg(comparison_figure(comparison)),
        drawing::to_svg(lines_figure()));
}

}  // namespace lockstep::comparison
