// How many bytes a frame has on DDS.
#pragma once

#include <cstddef>
#include <expected>
#include <string>

#include "services/wire/dds/participant.hpp"
#include "services/wire/dds/topics.hpp"
#include "services/wire/translate/translate.hpp"

namespace lockstep {

/// Writes frames as the coordinator does and takes them as DDS has encoded them. Nothing leaves the process.
class FrameSizer {
public:
    static std::expected<FrameSizer, std::string> open();
    /// Without the headers of the packet. Throws if DDS does not deliver the frame.
    std::size_t bytes(const Frame& frame);

private:
    explicit FrameSizer(Participant participant);

    Participant participant_;
    Entity topic_;
    Entity writer_;
    Entity reader_;
    SetpointMessage message_;
};

}  // namespace lockstep
