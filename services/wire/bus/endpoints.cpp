#include "services/wire/bus/endpoints.hpp"

#include <dds/ddsc/dds_statistics.h>

#include "services/wire/dds/present_processes.hpp"

namespace lockstep::detail {
namespace {

using Qos = std::unique_ptr<dds_qos_t, decltype(&dds_delete_qos)>;
using Listener = std::unique_ptr<dds_listener_t, decltype(&dds_delete_listener)>;

Qos qos_for(const TopicSpec& spec) {
    Qos qos{dds_create_qos(), &dds_delete_qos};
    const bool reliable = spec.delivery == Delivery::Reliable;
    dds_qset_reliability(qos.get(), reliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT,
                         0);  // a loop never waits for the network
    dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, spec.depth);
    dds_qset_durability(qos.get(), DDS_DURABILITY_VOLATILE);
    dds_qset_ignorelocal(qos.get(), DDS_IGNORELOCAL_PARTICIPANT);  // an axis does not need its own state
    return qos;
}

/// Topics belong to the participant and are deleted with it.
dds_entity_t make_topic(Participant& participant, const TopicSpec& spec) {
    return dds_create_topic(participant.handle(), spec.type, spec.name, nullptr, nullptr);
}

Entity checked(Participant& participant, const TopicSpec& spec, dds_entity_t handle) {
    Entity entity(handle);
    if (!entity.good()) {
        participant.note_failure(std::string("cannot open the DDS topic ") + spec.name + ": " + entity.why_not() +
                                 "; with security, check that the permissions allow it");
    }
    return entity;
}

void on_data_available(dds_entity_t, void* arrived) {
    Arrival& arrival = *static_cast<Arrival*>(arrived);
    arrival.has_come = true;
    if (arrival.on_data) { arrival.on_data(); }
}

Listener listener_for(Arrival& arrival) {
    Listener listener{dds_create_listener(&arrival), &dds_delete_listener};
    dds_lset_data_available(listener.get(), on_data_available);
    return listener;
}

}  // namespace

Entity make_writer(Participant& participant, const TopicSpec& spec) {
    const dds_entity_t topic = make_topic(participant, spec);
    if (topic < 0) { return checked(participant, spec, topic); }
    const Qos qos = qos_for(spec);
    announce_process(*qos);
    return checked(participant, spec, dds_create_writer(participant.publisher(), topic, qos.get(), nullptr));
}

Entity make_reader(Participant& participant, const TopicSpec& spec, Arrival& arrival) {
    const dds_entity_t topic = make_topic(participant, spec);
    if (topic < 0) { return checked(participant, spec, topic); }
    const Listener listener = listener_for(arrival);
    return checked(participant, spec,
                   dds_create_reader(participant.subscriber(), topic, qos_for(spec).get(), listener.get()));
}

std::uint32_t matched_readers(const Entity& writer) {
    dds_publication_matched_status_t status{};
    dds_get_publication_matched_status(writer.handle(), &status);
    return status.current_count;
}

std::uint32_t matched_writers(const Entity& reader) {
    dds_subscription_matched_status_t status{};
    dds_get_subscription_matched_status(reader.handle(), &status);
    return status.current_count;
}

std::uint64_t discarded_bytes(const Entity& reader) {
    const std::unique_ptr<dds_statistics, decltype(&dds_delete_statistics)> figures(
        dds_create_statistics(reader.handle()), &dds_delete_statistics);
    const dds_stat_keyvalue* discarded = dds_lookup_statistic(figures.get(), "discarded_bytes");
    return discarded == nullptr ? 0 : discarded->u.u64;
}

}  // namespace lockstep::detail
