// Decides which writer may publish for an axis: one in that axis's own partition and in no other. DDS Security's
// permissions keep other writers out of that partition. Without security the check protects only against mistakes.
#pragma once

#include <dds/dds.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace lockstep {

class PartitionCheck {
public:
    explicit PartitionCheck(std::string machine) : machine_(std::move(machine)) {}

    /// `writer` is the sample's publication handle. A writer that has left may write for no axis.
    bool may_write_for(dds_entity_t reader, dds_instance_handle_t writer, std::uint32_t axis);

private:
    struct Known {
        dds_instance_handle_t writer;
        std::string partition;
        std::optional<std::uint32_t> axis;  // the last axis for which it may write
    };
    static constexpr std::size_t kMaxKnown = 128;  // beyond it the oldest is forgotten, and looked up again

    Known& known_writer(dds_entity_t reader, dds_instance_handle_t writer);

    std::string machine_;
    std::vector<Known> known_;
};

}  // namespace lockstep
