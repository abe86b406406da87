// Writes the samples of a log one by one in one format.
#pragma once

#include <cstdint>
#include <expected>
#include <string>

#include "clients/export/signals.hpp"

namespace lockstep::exporting {

class SampleWriter {
public:
    virtual ~SampleWriter() = default;
    virtual void write(const Sample& sample) = 0;
    /// Writes what is buffered. The error names the file and the reason.
    virtual std::expected<void, std::string> close() = 0;
    /// Samples that the format cannot hold.
    virtual std::int64_t left_out() const { return 0; }
};

}  // namespace lockstep::exporting
