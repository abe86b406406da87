// A protobuf message read from text, with the place of each of its keys.
#pragma once

#include <google/protobuf/text_format.h>

#include <string_view>

#include "services/files/diagnostic.hpp"

namespace lockstep {

class TextSource {
public:
    /// Returns unknown and repeated keys, wrong types and wrong syntax; empty: no error.
    Diagnostics parse(std::string_view text, google::protobuf::Message& message);

    struct Place {
        int line = 1;
        int column = 1;
        bool is_of_key = false;  // the key itself; otherwise the block that it is missing from
    };
    /// `path`: "timing.slot_us"; "axis[1].homing.park_mm" for a repeated key, from 0. Empty: the text.
    Place place_of(const google::protobuf::Descriptor& type, std::string_view path) const;

private:
    google::protobuf::TextFormat::ParseInfoTree places_;
};

}  // namespace lockstep
