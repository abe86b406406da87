// Events of programs that are lost or are not those that happened. They are no motion: the steps stay as planned.
#include "tests/records/alterations/alterations.hpp"
#include "tests/records/alterations/places.hpp"

namespace lockstep::records {
namespace {

constexpr Verdicts kEventAnyGrade = kSaysGood | kSaysDoubtful | kSaysUnknown | kSaysBad;
constexpr Expected kEventOtherEvent{kSaysBad, kEventAnyGrade, kSaysGood | kSaysUnknown | kSaysBad, kReplayedAlike};
constexpr Expected kEventLost{kSaysUnknown, kSaysDoubtful | kSaysUnknown, kSaysUnknown, kReplayedAlike};
constexpr Needs kEvents{.events = true};

/// The second event of a program in motion.
std::optional<std::size_t> event_place(const Record& record) {
    const auto places = places_of<program_event_t>(record, [](const program_event_t& e) { return e.at_rest == 0; });
    return places.size() < 2 ? std::nullopt : std::optional(places[1]);
}

struct EventChange {
    const char* name;
    void (*change)(program_event_t&);
};

const EventChange kEventChanges[]{
    {"a_tick_later", [](program_event_t& event) { ++event.tick; }},
    {"a_second_later", [](program_event_t& event) { event.tick += 1'000'000; }},
    {"of_another_kind", [](program_event_t& event) { event.kind = event.kind == "mist-on" ? "flood-on" : "mist-on"; }},
    {"of_another_index", [](program_event_t& event) { ++event.index; }},
    {"of_another_value", [](program_event_t& event) { event.value += 1; }},
    {"of_another_block", [](program_event_t& event) { ++event.block; }},
    {"of_another_line", [](program_event_t& event) { ++event.line; }},
    {"marked_at_rest", [](program_event_t& event) { event.at_rest = 1; }},
    {"of_another_epoch", [](program_event_t& event) { ++event.epoch; }},
    {"of_another_job", [](program_event_t& event) { event.job += 50; }},
    {"not_of_the_program", [](program_event_t& event) { event.of_program = 0; }},
    {"of_an_unknown_kind", [](program_event_t& event) { event.kind = "nothing"; }},
};

}  // namespace

std::vector<Alteration> event_alterations() {
    std::vector<Alteration> all;
    for (const EventChange& change : kEventChanges) {
        all.push_back({"event_" + std::string(change.name),
                       [=](Record& r) { return change_at<program_event_t>(r, event_place(r), change.change); },
                       kEventOtherEvent, kNoMotion, kEvents});
    }
    all.push_back(
        {"event_dropped", [](Record& r) { return erase_at(r, event_place(r)); }, kEventLost, kNoMotion, kEvents});
    all.push_back({"events_all_dropped",
                   [](Record& r) { return leave_out<program_event_t>(r, [](const auto&) { return true; }) > 0; },
                   kEventLost, kNoMotion, kEvents});
    all.push_back({"event_twice",
                   [](Record& r) { return repeat_at(r, event_place(r)); },
                   {kSaysGood, kSaysGood, kSaysGood, kReplayedAlike},
                   Altered{.motion = false, .must_be_mentioned = true},
                   kEvents});
    return all;
}

}  // namespace lockstep::records
