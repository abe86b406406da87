// The newest offsets and tools that a client has received from the machine's owner.
#pragma once

#include <chrono>
#include <cstdint>
#include <expected>
#include <optional>
#include <string>

#include "core/protocol/machine_values.hpp"
#include "services/documents/values/values_document.hpp"

namespace lockstep {

class ReceivedValues {
public:
    /// Ignores values of a coordinator that no longer owns the machine.
    void take(MachineValues&& values, std::chrono::nanoseconds now);

    bool has_any() const { return values_.has_value(); }
    /// Call it only if has_any(). Fails if the values cannot be read.
    std::expected<RevisedValues, std::string> read() const { return values_from_bytes(values_->bytes); }
    /// nullopt if none were received, or if they cannot be read.
    std::optional<RevisedValues> newest() const;
    /// Whether this revision, or a later one, is on the coordinator's disk.
    bool is_kept(std::uint64_t revision) const { return values_ && values_->revision >= revision && values_->on_disk; }
    /// Since when the values are not on the coordinator's disk; nullopt: they are, or none are received. After a change
    /// this lasts some milliseconds.
    std::optional<std::chrono::nanoseconds> unsaved_since() const { return unsaved_since_; }

private:
    std::optional<MachineValues> values_;
    std::optional<std::chrono::nanoseconds> unsaved_since_;
};

}  // namespace lockstep
