#include "clients/web/request/orders.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "clients/web/request/body_reader.hpp"
#include "core/gcode/kept_values.hpp"
#include "core/gcode/system_names.hpp"
#include "core/number_text.hpp"
#include "core/overrides.hpp"
#include "core/program.hpp"
#include "services/documents/names.hpp"

namespace lockstep::web {
namespace {

constexpr double kMostPlace = 1e6;  // mm or degrees
constexpr int kMaxToolNumber = 99'999;
constexpr std::int64_t kMaxId = std::int64_t{1} << 53;

using Read = std::optional<Order> (*)(const Json& body, const MachineConfig& machine, std::optional<Problem>& problem);

std::optional<AxisIndex> axis_of(const std::string& name, const std::string& place, const MachineConfig& machine,
                                 BodyReader& reader) {
    if (const auto found = axis_in_any_case(machine, name)) { return found; }
    const std::string known = fmt::format("one of the machine's axes: {}", fmt::join(machine.axis_names(), ", "));
    reader.refuse(wrong_value(422, place, name, known));
    return std::nullopt;
}

template <CommandKind kind>
std::optional<Order> plain(const Json& body, const MachineConfig&, std::optional<Problem>& problem) {
    BodyReader(body, "", problem).finish();
    return Command{.kind = kind};
}

template <bool takes>
std::optional<Order> lease(const Json& body, const MachineConfig&, std::optional<Problem>& problem) {
    BodyReader(body, "", problem).finish();
    return LeaseOrder{takes};
}

std::optional<Order> resume(const Json& body, const MachineConfig&, std::optional<Problem>& problem) {
    BodyReader reader(body, "", problem);
    const bool returns = reader.flag("return").value_or(false);
    reader.finish();
    return Command{.kind = CommandKind::Resume, .returns = returns};
}

std::optional<Order> home(const Json& body, const MachineConfig& machine, std::optional<Problem>& problem) {
    BodyReader reader(body, "", problem);
    Command command{.kind = CommandKind::Home};
    const Json* axes = reader.list("axes", machine.axes.size());
    for (std::size_t i = 0; axes != nullptr && i < axes->size(); ++i) {
        const std::string place = fmt::format("/axes/{}", i);
        if (!(*axes)[i].is_string()) {
            reader.refuse(wrong_value(400, place, (*axes)[i], "an axis's name"));
            continue;
        }
        const auto axis = axis_of((*axes)[i].get<std::string>(), place, machine, reader);
        if (axis) { command.axes.insert(*axis); }
    }
    reader.finish();
    return command;
}

std::optional<Order> override_speeds(const Json& body, const MachineConfig&, std::optional<Problem>& problem) {
    BodyReader reader(body, "", problem);
    const auto feed = reader.integer("feed_percent", Overrides::kLeast, Overrides::kMost);
    const auto rapid = reader.integer("rapid_percent", Overrides::kLeast, Overrides::kMost);
    if (!feed && !rapid) { reader.require("feed_percent"); }
    reader.finish();
    return Command{.kind = CommandKind::Override, .feed_percent = feed, .rapid_percent = rapid};
}

void read_jog(const Json& json, std::size_t i, const MachineConfig& machine, JogOrder& order,
              std::optional<Problem>& problem) {
    BodyReader reader(json, fmt::format("/jogs/{}", i), problem);
    reader.require("axis");
    reader.require("velocity");
    const auto name = reader.text("axis", 64);
    const AxisIndex none{machine.axes.size()};
    const AxisIndex axis = name ? axis_of(*name, reader.place_of("axis"), machine, reader).value_or(none) : none;
    const double most = axis < none ? machine.axes[axis].max_velocity_mm_s : kMostPlace;
    const auto velocity = reader.number("velocity", -most, most);
    const auto distance = reader.number("distance", std::numeric_limits<double>::min(), kMostPlace);
    reader.finish();
    if (velocity && std::abs(*velocity) < kLeastSpeed_mm_s) {
        reader.refuse(wrong_value(
            422, reader.place_of("velocity"), *velocity,
            fmt::format("at least {} either way; to end the jog, remove the axis", short_number(kLeastSpeed_mm_s))));
    }
    if (axis == none || !velocity) { return; }
    const auto is_same = [&](const JogAxis& one) { return one.axis == axis; };
    if (std::ranges::any_of(order.jogs, is_same)) {
        reader.refuse(wrong_value(422, reader.place_of("axis"), *name, "an axis that the list has only once"));
    }
    order.jogs.push_back({axis, *velocity, distance});
}

std::optional<Order> jog(const Json& body, const MachineConfig& machine, std::optional<Problem>& problem) {
    BodyReader reader(body, "", problem);
    JogOrder order;
    reader.require("jogs");
    const Json* jogs = reader.list("jogs", machine.axes.size());
    for (std::size_t i = 0; jogs != nullptr && i < jogs->size(); ++i) {
        if ((*jogs)[i].is_object()) {
            read_jog((*jogs)[i], i, machine, order, problem);
        } else {
            reader.refuse(wrong_value(400, fmt::format("/jogs/{}", i), (*jogs)[i], "an object"));
        }
    }
    order.stream = reader.text("stream", 64).value_or("");
    if (const auto press = reader.integer("press", 1, kMaxId)) { order.press = static_cast<std::uint64_t>(*press); }
    order.is_step = reader.flag("step").value_or(false);
    for (std::size_t i = 0; order.is_step && i < order.jogs.size(); ++i) {
        if (order.jogs[i].distance_mm) { continue; }
        reader.refuse(wrong_value(422, fmt::format("/jogs/{}/distance", i), nullptr, "a distance: the step's length"));
    }
    reader.finish();
    return order;
}

std::optional<Order> run(const Json& body, const MachineConfig&, std::optional<Problem>& problem) {
    BodyReader reader(body, "", problem);
    RunOrder order;
    if (const auto id = reader.integer("program", 1, kMaxId)) { order.program = static_cast<std::uint64_t>(*id); }
    reader.finish();
    return order;
}

std::optional<Order> mdi(const Json& body, const MachineConfig&, std::optional<Problem>& problem) {
    BodyReader reader(body, "", problem);
    reader.require("line");
    const std::string line = reader.text("line", kMaxLine_bytes).value_or("");
    const bool is_line = std::ranges::none_of(line, [](char c) { return c == '\n' || c == '\r' || c == '\0'; });
    if (line.empty() || !is_line) { reader.refuse(wrong_value(422, "/line", line, "one line of G-code")); }
    reader.finish();
    return MdiOrder{line};
}

std::size_t read_system(BodyReader& reader, const std::string& otherwise) {
    const std::string name = reader.text("system", 10).value_or(otherwise);
    const auto system = find_system(name);
    if (!system) { reader.refuse(wrong_value(422, "/system", name, "G54 to G59, G59.1, G59.2 or G59.3")); }
    return system.value_or(0);
}

/// Reads the values of axes that G-code names with a letter.
Letters read_letters(const std::string& name, const MachineConfig& machine, BodyReader& reader,
                     std::optional<Problem>& problem) {
    Letters letters;
    const Json* object = reader.object(name);
    if (object == nullptr) { return letters; }
    BodyReader values(*object, reader.place_of(name), problem);
    for (const AxisConfig& axis : machine.axes) {
        const bool is_letter = axis.name.size() == 1 && gcode::kAxisLetters.contains(axis.name[0]);
        if (!is_letter) { continue; }
        if (const auto value = values.number(axis.name, -kMostPlace, kMostPlace)) { letters[axis.name[0]] = *value; }
    }
    values.finish();
    return letters;
}

std::optional<Order> touch(const Json& body, const MachineConfig& machine, std::optional<Problem>& problem) {
    BodyReader reader(body, "", problem);
    reader.require("axes");
    TouchOrder order{.system = read_system(reader, "G54"), .places = read_letters("axes", machine, reader, problem)};
    if (order.places.empty()) { reader.refuse(wrong_value(422, "/axes", Json::object(), "at least one axis")); }
    reader.finish();
    return order;
}

std::optional<Order> offset(const Json& body, const MachineConfig& machine, std::optional<Problem>& problem) {
    BodyReader reader(body, "", problem);
    reader.require("system");
    OffsetOrder order{.system = read_system(reader, "G54"),
                      .origin = read_letters("origin", machine, reader, problem),
                      .rotation_deg = reader.number("rotation_deg", -360, 360)};
    reader.finish();
    return order;
}

std::optional<Order> tool(const Json& body, const MachineConfig& machine, std::optional<Problem>& problem) {
    BodyReader reader(body, "", problem);
    reader.require("number");
    ToolOrder order{.number = static_cast<int>(reader.integer("number", 1, kMaxToolNumber).value_or(0)),
                    .removes = reader.flag("remove").value_or(false),
                    .offset = read_letters("offset", machine, reader, problem),
                    .diameter = reader.number("diameter", 0, kMostPlace)};
    if (const auto pocket = reader.integer("pocket", 0, kMaxToolNumber)) { order.pocket = static_cast<int>(*pocket); }
    const bool sets = order.pocket || order.diameter || !order.offset.empty();
    if (order.removes && sets) {
        reader.refuse(wrong_value(422, "/remove", true, "false if there are other values than the number"));
    }
    reader.finish();
    return order;
}

std::optional<Order> probe(const Json& body, const MachineConfig&, std::optional<Problem>& problem) {
    return read_measure(body, problem);
}

std::optional<Order> keep(const Json& body, const MachineConfig&, std::optional<Problem>& problem) {
    return read_keep(body, problem);
}

const std::vector<std::pair<std::string, Read>>& readers() {
    static const std::vector<std::pair<std::string, Read>> kReaders{
        {"home", home},
        {"run", run},
        {"hold", plain<CommandKind::Hold>},
        {"resume", resume},
        {"stop", plain<CommandKind::Stop>},
        {"estop", plain<CommandKind::EmergencyStop>},
        {"reset", plain<CommandKind::Reset>},
        {"override", override_speeds},
        {"jog", jog},
        {"mdi", mdi},
        {"touch", touch},
        {"offset", offset},
        {"tool", tool},
        {"probe", probe},
        {"keep", keep},
        {"take", lease<true>},
        {"give", lease<false>},
    };
    return kReaders;
}

Problem unknown_verb(std::string_view verb) {
    return {.status = 404,
            .code = "unknown-verb",
            .title = "this command does not exist",
            .detail = "there is no command '" + std::string(verb.substr(0, 100)) + "'",
            .place = "path",
            .value = std::string(verb.substr(0, 100)),
            .limit = fmt::format("{}", fmt::join(verbs(), ", ")),
            .remedy = "use one of these commands"};
}

}  // namespace

const std::vector<std::string>& verbs() {
    static const std::vector<std::string> kVerbs = [] {
        std::vector<std::string> names;
        for (const auto& [name, read] : readers()) { names.push_back(name); }
        return names;
    }();
    return kVerbs;
}

std::expected<Order, Problem> read_order(std::string_view verb, std::string_view body, const MachineConfig& machine) {
    const auto found = std::ranges::find(readers(), verb, [](const auto& reader) { return reader.first; });
    if (found == readers().end()) { return std::unexpected(unknown_verb(verb)); }
    const auto json = read_object(body);
    if (!json) { return std::unexpected(json.error()); }
    std::optional<Problem> problem;
    auto order = found->second(*json, machine, problem);
    if (problem) { return std::unexpected(*std::move(problem)); }
    return *std::move(order);
}

Json accepted_json(const Accepted& accepted) {
    Json json{{"accepted", true}, {"job", accepted.job ? Json(*accepted.job) : Json()}};
    if (accepted.jogging) { json["jogging"] = *accepted.jogging; }
    if (accepted.modes) { json["modes"] = *accepted.modes; }
    return json;
}

}  // namespace lockstep::web
