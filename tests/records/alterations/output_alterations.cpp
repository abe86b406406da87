// Changes of outputs that are lost or are not those that happened. They are no motion: the steps stay as planned.
#include "tests/records/alterations/alterations.hpp"
#include "tests/records/alterations/places.hpp"

namespace lockstep::records {
namespace {

constexpr Expected kOtherOutput{kSaysBad, kSaysBad, kSaysGood | kSaysUnknown | kSaysBad, kReplayedAlike};
constexpr Expected kOutputLost{kSaysUnknown, kSaysUnknown, kSaysUnknown, kReplayedAlike};
constexpr Needs kOutputs{.outputs = true};

std::vector<std::size_t> changes(const Record& record, const std::string& kind) {
    return places_of<channel_event_t>(record, [&](const channel_event_t& event) { return event.kind == kind; });
}

/// The third change of an analog output, or of digital ones.
std::optional<std::size_t> change_place(const Record& record, const std::string& kind) {
    const auto places = changes(record, kind);
    return places.size() < 4 ? std::nullopt : std::optional(places[2]);
}

std::optional<std::size_t> first_change(const Record& record, const std::string& kind) {
    const auto places = changes(record, kind);
    return places.empty() ? std::nullopt : std::optional(places.front());
}

std::optional<std::size_t> last_change(const Record& record, const std::string& kind) {
    const auto places = changes(record, kind);
    return places.empty() ? std::nullopt : std::optional(places.back());
}

/// The device overwrote the change before its process read it: the messages have no gap.
bool lose_in_device(Record& record, std::optional<std::size_t> place) {
    if (!place) { return false; }
    const auto lost = decoded<channel_event_t>(record[*place]).value();
    change_each<channel_event_t>(record, [&](channel_event_t& event) {
        if (event.incarnation != lost.incarnation || event.sequence <= lost.sequence) { return false; }
        ++event.lost;
        --event.sequence;
        return true;
    });
    change_each<record_mark2_t>(record, [&](record_mark2_t& mark) {
        if (mark.incarnation != lost.incarnation || mark.channel_events <= lost.sequence) { return false; }
        --mark.channel_events;
        return true;
    });
    return erase_at(record, place);
}

struct OutputAlteration {
    const char* name;
    const char* kind;
    void (*change)(channel_event_t&);
};

const OutputAlteration kOutputAlterations[]{
    {"valve_a_tick_later", "digital", [](channel_event_t& event) { ++event.tick; }},
    {"valve_at_another_level", "digital", [](channel_event_t& event) { event.levels ^= 1; }},
    {"other_valve", "digital", [](channel_event_t& event) { event.levels ^= 4; }},
    {"laser_a_tick_earlier", "analog", [](channel_event_t& event) { --event.tick; }},
    {"laser_with_another_value", "analog", [](channel_event_t& event) { ++event.value; }},
    {"laser_with_another_slope", "analog", [](channel_event_t& event) { ++event.detail; }},
};

/// The device notes where pulses at places begin and end, and how many were not made.
const OutputAlteration kPulseAlterations[]{
    {"pulses_begin_a_tick_later", "compare-begins", [](channel_event_t& event) { ++event.tick; }},
    {"pulses_begin_with_one_more_to_make", "compare-begins", [](channel_event_t& event) { ++event.detail; }},
    {"pulses_end_a_tick_earlier", "compare-ends", [](channel_event_t& event) { --event.tick; }},
    {"pulses_end_with_one_less_made", "compare-ends", [](channel_event_t& event) { ++event.detail; }},
};

}  // namespace

std::vector<Alteration> output_alterations() {
    std::vector<Alteration> all;
    for (const OutputAlteration& one : kOutputAlterations) {
        all.push_back({one.name,
                       [=](Record& r) { return change_at<channel_event_t>(r, change_place(r, one.kind), one.change); },
                       kOtherOutput, kNoMotion, kOutputs});
    }
    for (const OutputAlteration& one : kPulseAlterations) {
        all.push_back({one.name,
                       [=](Record& r) { return change_at<channel_event_t>(r, first_change(r, one.kind), one.change); },
                       kOtherOutput, kNoMotion, kOutputs});
    }
    all.push_back({"last_pulses_end_with_one_more_made",
                   [](Record& r) {
                       return change_at<channel_event_t>(r, last_change(r, "compare-ends"),
                                                         [](channel_event_t& event) { --event.detail; });
                   },
                   kOtherOutput, kNoMotion, kOutputs});
    const auto lose = [&](const char* name, std::function<bool(Record&)> alter) {
        all.push_back({name, std::move(alter), kOutputLost, kNoMotion, kOutputs});
    };
    lose("laser_change_dropped", [](Record& r) { return erase_at(r, change_place(r, "analog")); });
    lose("first_laser_change_dropped", [](Record& r) { return erase_at(r, changes(r, "analog").front()); });
    lose("last_laser_change_dropped", [](Record& r) { return erase_at(r, changes(r, "analog").back()); });
    lose("first_begin_of_pulses_dropped", [](Record& r) { return erase_at(r, first_change(r, "compare-begins")); });
    lose("last_end_of_pulses_dropped", [](Record& r) { return erase_at(r, last_change(r, "compare-ends")); });
    lose("last_valve_change_dropped", [](Record& r) { return erase_at(r, changes(r, "digital").back()); });
    for (const char* motor : {"X", "Y"}) {
        lose(*motor == 'X' ? "laser_changes_all_dropped" : "valve_changes_all_dropped",
             [motor = std::string(motor)](Record& r) {
                 return leave_out<channel_event_t>(r, [&](const auto& event) { return event.axis == motor; }) > 0;
             });
    }
    lose("laser_change_lost_by_its_device", [](Record& r) { return lose_in_device(r, change_place(r, "analog")); });
    all.push_back({"laser_change_twice",
                   [](Record& r) { return repeat_at(r, change_place(r, "analog")); },
                   {kSaysGood, kSaysGood, kSaysGood, kReplayedAlike},
                   kNoMotion,
                   kOutputs});
    return all;
}

}  // namespace lockstep::records
