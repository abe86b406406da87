// Translates between the values that outlive programs and idl/proto/values.proto, as text in the coordinator's file and
// as bytes on the network.
#pragma once

#include <cstdint>
#include <expected>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/gcode/kept_values.hpp"
#include "services/files/diagnostic.hpp"

namespace lockstep {

namespace proto {
class KeptValues;
}  // namespace proto

/// The values at one time. The revision increases with every change.
struct RevisedValues {
    std::uint64_t revision = 0;
    gcode::KeptValues values;
    bool operator==(const RevisedValues&) const = default;
};

proto::KeptValues values_to_proto(const RevisedValues& values);
/// Error: the value that is out of range, and the range.
std::expected<RevisedValues, std::string> values_from_proto(const proto::KeptValues& message);

std::string values_text(const RevisedValues& values);
std::expected<RevisedValues, Diagnostics> values_from_text(std::string_view text);

/// Reads the coordinator's file. If it does not exist, returns no values and revision 0.
std::expected<RevisedValues, Diagnostics> read_values(const std::filesystem::path& file);

std::vector<std::uint8_t> values_bytes(const RevisedValues& values);
std::expected<RevisedValues, std::string> values_from_bytes(std::span<const std::uint8_t> bytes);

}  // namespace lockstep
