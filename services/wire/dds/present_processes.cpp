#include "services/wire/dds/present_processes.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <sstream>

#include "core/parse_number.hpp"
#include "services/network/host_name.hpp"
#include "services/wire/dds/partitions.hpp"
#include "services/wire/dds/topics.hpp"

namespace lockstep {
namespace {

/// An axis's partition is PREFIX/NUMBER.
std::optional<MotorIndex> motor_in(std::string_view partition, std::string_view prefix) {
    if (!partition.starts_with(prefix) || !partition.substr(prefix.size()).starts_with('/')) { return std::nullopt; }
    const auto number = parse_number<std::uint32_t>(partition.substr(prefix.size() + 1));
    return number ? std::optional(MotorIndex{*number}) : std::nullopt;
}

/// Returns the process of a writer; nullopt if it writes neither the machine's state nor an axis's.
std::optional<PresentProcess> process_of(const dds_builtintopic_endpoint_t& writer, const std::string& machine) {
    const std::string topic = writer.topic_name;
    const std::string partition = only_partition(writer.qos);
    PresentProcess process{.motor = motor_in(partition, machine)};
    const bool is_coordinator = partition == machine && topic == Topic<MachineState>::kSpec.name;
    if (!is_coordinator && !(process.motor && topic == Topic<AxisState>::kSpec.name)) { return std::nullopt; }
    std::istringstream(user_data(writer.qos)) >> process.host >> process.pid;
    return process;
}

}  // namespace

void announce_process(dds_qos_t& writer) {
    const std::string process = fmt::format("{} {}", host_name(), getpid());
    dds_qset_userdata(&writer, process.data(), process.size());
}

std::vector<PresentProcess> present_processes(const Participant& participant) {
    constexpr std::size_t kBatch = 64;
    const std::string machine = partition_of(participant.machine());
    const Entity reader(dds_create_reader(participant.handle(), DDS_BUILTIN_TOPIC_DCPSPUBLICATION, nullptr, nullptr));
    std::vector<PresentProcess> present;
    for (std::size_t count = reader.good() ? kBatch : 0; count == kBatch;) {
        std::array<void*, kBatch> samples{};
        std::array<dds_sample_info_t, kBatch> infos{};
        const dds_return_t taken = dds_take(reader.handle(), samples.data(), infos.data(), kBatch, kBatch);
        count = taken > 0 ? static_cast<std::size_t>(taken) : 0;
        for (std::size_t i = 0; i < count; ++i) {
            if (!infos[i].valid_data || infos[i].instance_state != DDS_IST_ALIVE) { continue; }
            auto process = process_of(*static_cast<const dds_builtintopic_endpoint_t*>(samples[i]), machine);
            if (process) { present.push_back(*std::move(process)); }
        }
        if (count > 0) { dds_return_loan(reader.handle(), samples.data(), taken); }
    }
    return present;
}

}  // namespace lockstep
