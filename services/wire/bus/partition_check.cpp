#include "services/wire/bus/partition_check.hpp"

#include <algorithm>
#include <memory>

#include "services/wire/dds/partitions.hpp"

namespace lockstep {

PartitionCheck::Known& PartitionCheck::known_writer(dds_entity_t reader, dds_instance_handle_t writer) {
    const auto known = std::ranges::find(known_, writer, &Known::writer);
    if (known != known_.end()) { return *known; }
    if (known_.size() == kMaxKnown) { known_.erase(known_.begin()); }
    const std::unique_ptr<dds_builtintopic_endpoint_t, decltype(&dds_builtintopic_free_endpoint)> publication(
        dds_get_matched_publication_data(reader, writer), &dds_builtintopic_free_endpoint);
    return known_.emplace_back(writer, publication ? only_partition(publication->qos) : "", std::nullopt);
}

bool PartitionCheck::may_write_for(dds_entity_t reader, dds_instance_handle_t writer, std::uint32_t axis) {
    Known& known = known_writer(reader, writer);
    if (known.axis == axis) { return true; }
    if (known.partition != partition_of(machine_, axis)) { return false; }
    known.axis = axis;
    return true;
}

}  // namespace lockstep
