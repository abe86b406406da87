// Samples as JSON with JSON Schema, as MCAP's registry of encodings defines them (https://mcap.dev/spec/registry).
#pragma once

#include <string>

#include "clients/export/signals.hpp"

namespace lockstep::exporting {

/// Replaces bytes that are not printable ASCII. Names in a damaged log may be any bytes, but JSON must be UTF-8.
std::string printable(std::string text);

/// The JSON Schema of a sample's signals.
std::string json_schema_of(const Sample& sample);

/// One JSON object. Leaves out values that are not finite, because JSON cannot represent them.
std::string json_of(const Sample& sample);

}  // namespace lockstep::exporting
