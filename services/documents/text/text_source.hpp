// Reads a protobuf message from text, and remembers the place of each key.
#pragma once

#include <google/protobuf/text_format.h>

#include <string_view>

#include "services/files/diagnostic.hpp"

namespace lockstep {

class TextSource {
public:
    /// Returns the errors: unknown and repeated keys, wrong types and wrong syntax. Empty if there is none.
    Diagnostics parse(std::string_view text, google::protobuf::Message& message);

    struct Place {
        int line = 1;
        int column = 1;
        bool is_of_key = false;  // true: place of the key; false: of the block that lacks it
    };
    /// `path` is, for example, "timing.slot_us", or "axis[1].homing.park_mm" for a repeated key, from 0. An empty path
    /// gives the text's beginning.
    Place place_of(const google::protobuf::Descriptor& type, std::string_view path) const;

private:
    google::protobuf::TextFormat::ParseInfoTree places_;
};

}  // namespace lockstep
