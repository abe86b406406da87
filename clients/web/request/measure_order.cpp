#include "clients/web/request/measure_order.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "clients/web/request/body_reader.hpp"
#include "core/gcode/gcode.hpp"
#include "core/gcode/system_names.hpp"
#include "core/number_text.hpp"

namespace lockstep::web {
namespace {

constexpr double kMost_mm = 1e6;
constexpr int kLastProbe = 63;
constexpr int kLastTool = 99'999;
constexpr std::size_t kMostAxes = 64;

struct Number {
    const char* name;
    double MeasureOptions::*value;
};

/// The values that a kind needs, beside the feed and its ways.
struct Kind {
    MeasureKind kind;
    std::vector<Number> numbers;
};

const std::vector<Kind>& kinds() {
    using O = MeasureOptions;
    const Number tip{"tip", &O::tip_mm};
    const Number diameter{"diameter", &O::diameter_mm};
    const Number down{"down", &O::down_mm};
    static const std::vector<Kind> kKinds{
        {MeasureKind::Edge, {tip}},
        {MeasureKind::Angle, {{"along", &O::along_mm}}},
        {MeasureKind::Corner, {{"beside", &O::clearance_mm}, tip}},
        {MeasureKind::Bore, {diameter, tip}},
        {MeasureKind::Boss, {diameter, down, {"clearance", &O::clearance_mm}, tip}},
        {MeasureKind::Tool, {down, {"setter", &O::setter_mm}}},
        {MeasureKind::Surface, {{"spacing", &O::spacing_mm}, down}},
    };
    return kKinds;
}

std::string names_of_kinds() {
    std::string names = "touch";
    for (const Kind& kind : kinds()) { names += ", " + std::string(name_of(kind.kind)); }
    return names;
}

/// The axes with their values, as the words of a command: "X=10".
std::vector<std::string> words_of(const std::string& name, BodyReader& reader, std::optional<Problem>& problem) {
    std::vector<std::string> words;
    reader.require(name);
    const Json* object = reader.object(name);
    if (object == nullptr || object->size() > kMostAxes) { return words; }
    BodyReader values(*object, reader.place_of(name), problem);
    for (const auto& [axis, value] : object->items()) {
        if (const auto mm = values.number(axis, -kMost_mm, kMost_mm)) {
            words.push_back(axis + "=" + number_text(*mm));
        }
    }
    if (words.empty()) { reader.refuse(wrong_value(422, reader.place_of(name), *object, "at least one axis")); }
    return words;
}

/// From "X=10" and "X=190" to "X=10:190".
std::vector<std::string> ranges_of(BodyReader& reader, std::optional<Problem>& problem) {
    std::vector<std::string> words = words_of("from", reader, problem);
    const std::vector<std::string> ends = words_of("to", reader, problem);
    for (std::string& word : words) {
        const std::string axis = word.substr(0, word.find('=') + 1);
        const auto end = std::ranges::find_if(ends, [&](const std::string& one) { return one.starts_with(axis); });
        if (end != ends.end()) { word += ":" + end->substr(axis.size()); }
    }
    return words;
}

double feed_of(BodyReader& reader) {
    reader.require("feed");
    return reader.number("feed", kMinFeedPerMinute, kMaxFeed_mm_s * 60).value_or(0);
}

std::optional<int> probe_of(BodyReader& reader) {
    const auto probe = reader.integer("probe", 0, kLastProbe);
    return probe ? std::optional(static_cast<int>(*probe)) : std::nullopt;
}

ProbeOptions read_touch(BodyReader& reader, std::optional<Problem>& problem) {
    return {.move = {.targets = words_of("to", reader, problem),
                     .feed_mm_min = feed_of(reader),
                     .relative = reader.flag("relative").value_or(false)},
            .probe = probe_of(reader),
            .away = reader.flag("away").value_or(false),
            .may_miss = reader.flag("may_miss").value_or(false)};
}

MeasureOptions read_kind(const Kind& kind, BodyReader& reader, std::optional<Problem>& problem) {
    MeasureOptions options{.kind = kind.kind, .words = {}, .feed_mm_min = feed_of(reader), .probe = probe_of(reader)};
    options.back_mm = reader.number("back", 0, kMost_mm).value_or(options.back_mm);
    for (const Number& number : kind.numbers) {
        reader.require(number.name);
        options.*number.value = reader.number(number.name, -kMost_mm, kMost_mm).value_or(0);
    }
    const bool has_way =
        kind.kind == MeasureKind::Edge || kind.kind == MeasureKind::Angle || kind.kind == MeasureKind::Corner;
    if (has_way) { options.words = words_of("way", reader, problem); }
    if (kind.kind == MeasureKind::Surface) { options.words = ranges_of(reader, problem); }
    return options;
}

}  // namespace

std::optional<MeasureOrder> read_measure(const Json& body, std::optional<Problem>& problem) {
    BodyReader reader(body, "", problem);
    reader.require("kind");
    const std::string name = reader.text("kind", 20).value_or("");
    const auto kind = std::ranges::find(kinds(), name, [](const Kind& one) { return name_of(one.kind); });
    MeasureOrder order;
    if (name == "touch") {
        order.what = read_touch(reader, problem);
    } else if (kind != kinds().end()) {
        order.what = read_kind(*kind, reader, problem);
    } else {
        reader.refuse(wrong_value(422, "/kind", name, names_of_kinds()));
    }
    reader.finish();
    return order;
}

std::optional<KeepOrder> read_keep(const Json& body, std::optional<Problem>& problem) {
    BodyReader reader(body, "", problem);
    KeepOrder order{.system = reader.text("system", 10).value_or(""),
                    .tool = std::nullopt,
                    .reads_mm = reader.number("reads", -kMost_mm, kMost_mm).value_or(0)};
    if (const auto tool = reader.integer("tool", 1, kLastTool)) { order.tool = static_cast<int>(*tool); }
    if (!order.tool) { reader.require("system"); }
    if (order.tool && !order.system.empty()) {
        reader.refuse(wrong_value(422, "/tool", *order.tool, "absent if a system is given"));
    }
    if (!order.system.empty() && !find_system(order.system)) {
        reader.refuse(wrong_value(422, "/system", order.system, "G54 to G59, G59.1, G59.2 or G59.3"));
    }
    reader.finish();
    return order;
}

}  // namespace lockstep::web
