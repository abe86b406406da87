#include "services/wire/present_processes.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <memory>

#include "services/wire/partitions.hpp"
#include "services/wire/topics.hpp"

namespace lockstep {
namespace {

/// Calls use(sample) for each living instance of one of DDS's own topics.
template <typename Sample, typename Use>
void look_at(const Participant& participant, dds_entity_t topic, Use use) {
    constexpr std::size_t kBatch = 64;
    const Entity reader(dds_create_reader(participant.handle(), topic, nullptr, nullptr));
    if (!reader.good()) { return; }
    for (;;) {
        std::array<void*, kBatch> samples{};
        std::array<dds_sample_info_t, kBatch> infos{};
        const int count = dds_take(reader.handle(), samples.data(), infos.data(), kBatch, kBatch);
        for (int i = 0; i < count; ++i) {
            const auto at = static_cast<std::size_t>(i);
            if (infos[at].valid_data && infos[at].instance_state == DDS_IST_ALIVE) {
                use(*static_cast<const Sample*>(samples[at]));
            }
        }
        if (count > 0) { dds_return_loan(reader.handle(), samples.data(), count); }
        if (count < static_cast<int>(kBatch)) { return; }
    }
}

std::string property(const dds_qos_t* qos, const char* name) {
    char* value = nullptr;
    if (!dds_qget_prop(qos, name, &value) || value == nullptr) { return ""; }
    const std::unique_ptr<char, decltype(&dds_free)> owned(value, &dds_free);
    return owned.get();
}

std::vector<std::string> partitions_of(const dds_qos_t* qos) {
    std::uint32_t count = 0;
    char** names = nullptr;
    if (!dds_qget_partition(qos, &count, &names)) { return {}; }
    std::vector<std::string> partitions(names, names + count);
    for (std::uint32_t i = 0; i < count; ++i) { dds_free(names[i]); }
    dds_free(names);
    return partitions;
}

/// Partitions of axes are PREFIX/NUMBER.
std::optional<std::uint32_t> axis_in(std::string_view partition, std::string_view prefix) {
    if (!partition.starts_with(prefix) || !partition.substr(prefix.size()).starts_with('/')) { return std::nullopt; }
    partition.remove_prefix(prefix.size() + 1);
    std::uint32_t axis = 0;
    const char* const end = partition.data() + partition.size();
    const auto [rest, error] = std::from_chars(partition.data(), end, axis);
    return error == std::errc{} && rest == end ? std::optional(axis) : std::nullopt;
}

struct Writing {
    std::optional<std::uint32_t> axis;
    dds_guid_t participant;
};

/// Who writes the states of the machine or of one of its axes.
std::vector<Writing> writings(const Participant& participant) {
    const std::string ours = partition_of(participant.machine());
    std::vector<Writing> found;
    look_at<dds_builtintopic_endpoint_t>(
        participant, DDS_BUILTIN_TOPIC_DCPSPUBLICATION, [&](const dds_builtintopic_endpoint_t& writer) {
            const auto partitions = partitions_of(writer.qos);
            if (partitions.size() != 1) { return; }
            const auto axis = axis_in(partitions[0], ours);
            const bool is_axis = axis && writer.topic_name == std::string_view(Topic<AxisState>::kSpec.name);
            const bool is_coordinator =
                partitions[0] == ours && writer.topic_name == std::string_view(Topic<MachineState>::kSpec.name);
            if (is_axis || is_coordinator) { found.push_back({axis, writer.participant_key}); }
        });
    return found;
}

}  // namespace

std::vector<PresentProcess> present_processes(const Participant& participant) {
    const auto found = writings(participant);
    std::vector<PresentProcess> present;
    look_at<dds_builtintopic_participant_t>(
        participant, DDS_BUILTIN_TOPIC_DCPSPARTICIPANT, [&](const dds_builtintopic_participant_t& process) {
            for (const Writing& writing : found) {
                if (!std::ranges::equal(writing.participant.v, process.key.v)) { continue; }
                const std::string number = property(process.qos, "__Pid");
                PresentProcess one{writing.axis, property(process.qos, "__Hostname")};
                std::from_chars(number.data(), number.data() + number.size(), one.pid);
                present.push_back(std::move(one));
            }
        });
    return present;
}

}  // namespace lockstep
