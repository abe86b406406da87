// A number of a message, by the name of its field: for keys that a table has. The message must have an optional double
// of this name.
#pragma once

#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>

#include <optional>
#include <string>
#include <string_view>

namespace lockstep {

/// Nullopt if it is not given.
inline std::optional<double> number_in(const google::protobuf::Message& message, std::string_view name) {
    const auto* const field = message.GetDescriptor()->FindFieldByName(std::string(name));
    const google::protobuf::Reflection& fields = *message.GetReflection();
    return fields.HasField(message, field) ? std::optional(fields.GetDouble(message, field)) : std::nullopt;
}

inline void set_number(google::protobuf::Message& message, std::string_view name, double value) {
    message.GetReflection()->SetDouble(&message, message.GetDescriptor()->FindFieldByName(std::string(name)), value);
}

}  // namespace lockstep
