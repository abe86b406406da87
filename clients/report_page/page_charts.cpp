#include "clients/report_page/page_charts.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <vector>

#include "clients/analysis/curves.hpp"
#include "clients/analysis/plane_path.hpp"

namespace lockstep::analysis {
namespace {

/// JSON text, part by part.
class Json {
public:
    void text(std::string_view raw) { out_ += raw; }
    void number(double value) {
        std::isfinite(value) ? void(fmt::format_to(std::back_inserter(out_), "{:.9g}", value)) : text("null");
    }
    void key(std::string_view name) { fmt::format_to(std::back_inserter(out_), "\"{}\":", name); }
    /// For names that need no escapes.
    void word(std::string_view value) { fmt::format_to(std::back_inserter(out_), "\"{}\"", value); }
    template <typename Range, typename Write>
    void list(const Range& values, Write&& write) {
        text("[");
        bool first = true;
        for (const auto& value : values) {
            if (!std::exchange(first, false)) { text(","); }
            write(value);
        }
        text("]");
    }
    void numbers(const std::vector<double>& values) {
        list(values, [this](double value) { number(value); });
    }
    std::string take() && { return std::move(out_); }

private:
    std::string out_;
};

struct Kind {
    std::string_view name;  // of the button
    std::string_view what;  // beside an axis's name
    std::string_view per;   // behind the unit of length
    std::vector<drawing::AxisCurve> curves;
};

std::vector<Kind> kinds(const Analysis& analysis) {
    return {{"speed", "speed", "/s", speed_curves(analysis)},
            {"acceleration", "acceleration", "/s\u00b2", acceleration_curves(analysis)},
            {"position", "position", "", position_curves(analysis)},
            {"step time error", "lateness of its steps against the commanded ticks", "", lateness_curves(analysis)},
            {"slack", "slack: how long before its start the latest frame came", "", slack_curves(analysis)}};
}

void write_row(const Kind& kind, const drawing::AxisCurve& curve, std::size_t colour, Json& out) {
    out.text(R"({"kind":)");
    out.word(kind.name);
    out.text(R"(,"name":)");
    out.word(curve.axis);
    out.text(R"(,"what":)");
    out.word(kind.what);
    out.text(R"(,"unit":)");
    out.word(curve.unit + std::string(kind.per));
    out.text(fmt::format(R"(,"colour":{},"limits":)", colour));
    out.numbers(curve.limit ? std::vector<double>{-*curve.limit, *curve.limit} : std::vector<double>{});
    out.text(R"(,"missing":)");
    out.list(curve.missing, [&out](const drawing::Span& span) { out.numbers({span.from, span.to}); });
    out.text(R"(,"x":)");
    out.numbers(curve.time_s);
    out.text(R"(,"y":)");
    out.numbers(curve.value);
    out.text("}");
}

void write_rows(const Analysis& analysis, Json& out) {
    bool first = true;
    for (const Kind& kind : kinds(analysis)) {
        for (std::size_t i = 0; i < kind.curves.size(); ++i) {
            if (kind.curves[i].time_s.empty()) { continue; }
            if (!std::exchange(first, false)) { out.text(",\n"); }
            write_row(kind, kind.curves[i], i, out);
        }
    }
}

void write_way(const drawing::PlanePath& way, Json& out) {
    out.text(R"({"x":)");
    out.numbers(way.x);
    out.text(R"(,"y":)");
    out.numbers(way.y);
    out.text("}");
}

void write_path(const Analysis& analysis, Json& out) {
    const auto paths = paths_in_plane(analysis);
    if (!paths || paths->stepped.x.empty()) { return out.text("null"); }
    out.text(R"({"asked":)");
    write_way(paths->asked, out);
    out.text(R"(,"stepped":)");
    write_way(paths->stepped, out);
    out.text("}");
}

/// "0", "1", "2 - 3", ... in microseconds.
std::string class_text(const Analysis& analysis, std::size_t number) {
    const double high = analysis.microseconds(TickHistogram::most_in(number));
    if (number < 2) { return fmt::format("{:g}", high); }
    const double low = analysis.microseconds(TickHistogram::most_in(number - 1) + Ticks{1});
    return number + 1 == TickHistogram::kClasses ? fmt::format("{:g} or more", low)
                                                 : fmt::format("{:g} - {:g}", low, high);
}

void write_step_times(const Analysis& analysis, const AxisLog& axis, std::size_t colour, Json& out) {
    out.text(R"({"name":)");
    out.word(axis.name());
    out.text(fmt::format(R"(,"colour":{},"counts":)", colour));
    out.list(axis.late().counts(), [&out](std::int64_t number) { out.text(fmt::format("{}", number)); });
    std::vector<std::string> classes;
    for (std::size_t i = 0; i < TickHistogram::kClasses; ++i) { classes.push_back(class_text(analysis, i)); }
    out.text(R"(,"classes":)");
    out.list(classes, [&out](const std::string& text) { out.word(text); });
    out.text("}");
}

}  // namespace

std::string page_charts(const Analysis& analysis) {
    const double lasts = analysis.first_tick() ? analysis.seconds(*analysis.last_tick() - *analysis.first_tick()) : 0;
    Json out;
    out.text(R"({"whole":)");
    out.numbers({0, lasts});
    out.text(R"(,"rows":[)");
    write_rows(analysis, out);
    out.text(R"(],"path":)");
    write_path(analysis, out);
    out.text(R"(,"step_times":[)");
    bool first = true;
    for (std::size_t i = 0; i < analysis.axes.size(); ++i) {
        if (analysis.axes[i]->late().empty()) { continue; }
        if (!std::exchange(first, false)) { out.text(","); }
        write_step_times(analysis, *analysis.axes[i], i, out);
    }
    out.text("]}");
    return std::move(out).take();
}

}  // namespace lockstep::analysis
