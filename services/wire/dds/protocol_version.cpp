#include "services/wire/dds/protocol_version.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <map>
#include <memory>
#include <mutex>

#include "services/wire/dds/dds_log.hpp"
#include "services/wire/dds/partitions.hpp"

namespace lockstep {
namespace {

constexpr std::string_view kMark = "lockstep ";

/// DDS calls it on one of its threads.
void on_participants(dds_entity_t reader, void* machine) {
    std::array<void*, 1> samples{};
    dds_sample_info_t info{};
    while (dds_take(reader, samples.data(), &info, 1, 1) == 1) {
        const bool alive = info.valid_data && info.instance_state == DDS_IST_ALIVE;
        const auto* participant = static_cast<const dds_builtintopic_participant_t*>(samples[0]);
        const std::string card = alive ? user_data(participant->qos) : "";
        if (const auto text = other_version(card, *static_cast<const std::string*>(machine))) {
            add_dds_message(*text);
        }
        (void)dds_return_loan(reader, samples.data(), 1);
    }
}

/// Returns a copy of the name that is never freed. A reader's callback uses it, and may still run while the reader is
/// deleted with its participant.
std::string* kept_name(const std::string& machine) {
    static std::mutex mutex;
    static auto& names = *new std::map<std::string, std::string>;
    const std::lock_guard lock(mutex);
    return &names.try_emplace(machine, machine).first->second;
}

}  // namespace

std::string calling_card(int protocol, const std::string& machine) {
    return fmt::format("{}{} {}", kMark, protocol, machine);
}

std::optional<std::string> other_version(std::string_view card, const std::string& machine) {
    if (!card.starts_with(kMark)) { return std::nullopt; }
    card.remove_prefix(kMark.size());
    int protocol = 0;
    const auto [end, error] = std::from_chars(card.data(), card.data() + card.size(), protocol);
    if (error != std::errc{} || protocol == kProtocol) { return std::nullopt; }
    if (std::string_view(end, card.data() + card.size()) != " " + machine) { return std::nullopt; }
    return fmt::format(
        "a process of machine '{}' uses protocol {}, this one {}: they do not receive each other's messages; install "
        "the same version of Lockstep on all hosts",
        machine, protocol, kProtocol);
}

void announce_version(dds_qos_t& participant, int protocol, const std::string& machine) {
    const std::string card = calling_card(protocol, machine);
    dds_qset_userdata(&participant, card.data(), card.size());
}

void watch_versions(dds_entity_t participant, const std::string& machine) {
    std::string* const name = kept_name(machine);
    const std::unique_ptr<dds_listener_t, decltype(&dds_delete_listener)> listener(dds_create_listener(name),
                                                                                   &dds_delete_listener);
    dds_lset_data_available(listener.get(), on_participants);
    const dds_entity_t reader =
        dds_create_reader(participant, DDS_BUILTIN_TOPIC_DCPSPARTICIPANT, nullptr, listener.get());
    if (reader > 0) { on_participants(reader, name); }  // the processes that are already present
}

}  // namespace lockstep
