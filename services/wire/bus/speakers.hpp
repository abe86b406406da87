// Who may speak for an axis: a writer in that axis's own partition, and in no other. DDS Security's permissions keep
// everybody else out of it; without security it keeps honest mistakes apart.
#pragma once

#include <dds/dds.h>

#include <cstdint>
#include <string>
#include <vector>

namespace lockstep {

class Speakers {
public:
    explicit Speakers(std::string machine) : machine_(std::move(machine)) {}

    /// writer: what a sample says of where it comes from. One that has left speaks for nobody.
    bool speaks_for(dds_entity_t reader, dds_instance_handle_t writer, std::uint32_t axis);

private:
    struct Known {
        dds_instance_handle_t writer;
        std::string partition;
    };
    static constexpr std::size_t kMaxKnown = 128;  // writers come and go; the oldest is looked up again

    const std::string& partition_of_writer(dds_entity_t reader, dds_instance_handle_t writer);

    std::string machine_;
    std::vector<Known> known_;
};

}  // namespace lockstep
