// Translates between the values that outlive programs and their Protobuf message.
#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "core/gcode/line_words.hpp"
#include "core/gcode/system_names.hpp"
#include "core/number_text.hpp"
#include "idl/proto/values.pb.h"
#include "services/documents/values/values_document.hpp"

namespace lockstep {
namespace {

using gcode::CoordinateSystem;
using gcode::KeptValues;
using gcode::kMaxNumber;
using gcode::Point;

constexpr int kMaxToolNumber = 99'999;
constexpr int kMaxOrientation = 9;

/// Returns the field of an axis in a place. x is the first field.
const google::protobuf::FieldDescriptor& field_of(std::size_t axis) {
    return *proto::Place::descriptor()->FindFieldByNumber(static_cast<int>(axis) + 1);
}

void write(const Point& place, proto::Place& message) {
    for (std::size_t axis = 0; axis < gcode::kAxes; ++axis) {
        if (place[axis] != 0) { proto::Place::GetReflection()->SetDouble(&message, &field_of(axis), place[axis]); }
    }
}

proto::Tool write(int number, const gcode::Tool& tool) {
    proto::Tool message;
    message.set_number(number);
    if (tool.pocket != 0) { message.set_pocket(tool.pocket); }
    if (tool.offset != Point{}) { write(tool.offset, *message.mutable_offset()); }
    if (tool.diameter != 0) { message.set_diameter(tool.diameter); }
    if (tool.front_angle != 0) { message.set_front_angle(tool.front_angle); }
    if (tool.back_angle != 0) { message.set_back_angle(tool.back_angle); }
    if (tool.orientation != 0) { message.set_orientation(tool.orientation); }
    return message;
}

/// Reads numbers, and notes the first that is out of range.
class ValuesReader {
public:
    double number(double value, const std::string& what) { return within(value, -kMaxNumber, kMaxNumber, what); }
    int whole(int value, int least, int most, const std::string& what) {
        return static_cast<int>(within(value, least, most, what));
    }
    Point place(const proto::Place& message, const std::string& what) {
        Point place{};
        for (std::size_t axis = 0; axis < gcode::kAxes; ++axis) {
            const double value = proto::Place::GetReflection()->GetDouble(message, &field_of(axis));
            place[axis] = number(value, what + ": " + gcode::kAxisLetters[axis]);
        }
        return place;
    }
    void refuse(const std::string& why) {
        if (!refusal_) { refusal_ = why; }
    }
    const std::optional<std::string>& refusal() const { return refusal_; }

private:
    double within(double value, double least, double most, const std::string& what) {
        if (value >= least && value <= most) { return value; }
        refuse(fmt::format("{} is {}; it must be from {} to {}", what, number_text(value), number_text(least),
                           number_text(most)));
        return least;
    }

    std::optional<std::string> refusal_;
};

void read_system(const proto::CoordinateSystem& message, KeptValues& values, ValuesReader& reader) {
    const auto system = find_system(message.name());
    if (!system) {
        return reader.refuse("there is no coordinate system '" + message.name() + "'; they are G54 to G59, G59.1, " +
                             "G59.2 and G59.3");
    }
    CoordinateSystem& read = values.systems[*system];
    if (read != CoordinateSystem{}) { return reader.refuse("coordinate system " + message.name() + " is there twice"); }
    read = {reader.place(message.origin(), message.name()),
            reader.number(message.rotation(), message.name() + ": the rotation")};
}

void read_tool(const proto::Tool& message, KeptValues& values, ValuesReader& reader) {
    const std::string what = fmt::format("tool {}", message.number());
    const int number = reader.whole(message.number(), 1, kMaxToolNumber, "a tool's number");
    const gcode::Tool tool{
        .pocket = reader.whole(message.pocket(), 0, kMaxToolNumber, what + ": the pocket"),
        .offset = reader.place(message.offset(), what),
        .diameter = reader.number(message.diameter(), what + ": the diameter"),
        .front_angle = reader.number(message.front_angle(), what + ": the front angle"),
        .back_angle = reader.number(message.back_angle(), what + ": the back angle"),
        .orientation = reader.whole(message.orientation(), 0, kMaxOrientation, what + ": the orientation")};
    if (!values.tools.try_emplace(number, tool).second) { reader.refuse(what + " is there twice"); }
}

}  // namespace

proto::KeptValues values_to_proto(const RevisedValues& revised) {
    const KeptValues& values = revised.values;
    proto::KeptValues message;
    message.set_revision(revised.revision);
    for (std::size_t i = 0; i < gcode::kSystems; ++i) {
        if (values.systems[i] == CoordinateSystem{}) { continue; }
        proto::CoordinateSystem& system = *message.add_system();
        system.set_name(name_of_system(i));
        write(values.systems[i].origin, *system.mutable_origin());
        if (values.systems[i].rotation != 0) { system.set_rotation(values.systems[i].rotation); }
    }
    if (values.g92 != Point{}) { write(values.g92, *message.mutable_g92()); }
    message.set_g92_applies(values.g92_applies);
    if (values.home) { write(*values.home, *message.mutable_g28()); }
    if (values.second_home) { write(*values.second_home, *message.mutable_g30()); }
    for (const auto& [number, tool] : values.tools) { *message.add_tool() = write(number, tool); }
    return message;
}

std::expected<RevisedValues, std::string> values_from_proto(const proto::KeptValues& message) {
    if (message.tool_size() > static_cast<int>(gcode::kMaxTools)) {
        return std::unexpected(
            fmt::format("there are {} tools; at most {} are kept", message.tool_size(), gcode::kMaxTools));
    }
    RevisedValues revised{.revision = message.revision(), .values = {}};
    KeptValues& values = revised.values;
    ValuesReader reader;
    for (const auto& system : message.system()) { read_system(system, values, reader); }
    values.g92 = reader.place(message.g92(), "G92");
    values.g92_applies = message.g92_applies();
    if (message.has_g28()) { values.home = reader.place(message.g28(), "G28"); }
    if (message.has_g30()) { values.second_home = reader.place(message.g30(), "G30"); }
    for (const auto& tool : message.tool()) { read_tool(tool, values, reader); }
    if (reader.refusal()) { return std::unexpected(*reader.refusal()); }
    return revised;
}

}  // namespace lockstep
