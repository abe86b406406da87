// Changes of outputs that are lost or are not those that happened. They are no motion: the steps stay as planned.
#include "tests/records/alterations/alterations.hpp"
#include "tests/records/alterations/places.hpp"

namespace lockstep::records {
namespace {

constexpr Expected kOtherOutput{kSaysBad, kSaysBad, kSaysGood | kSaysUnknown | kSaysBad, kReplayedAlike};
constexpr Expected kOutputLost{kSaysUnknown, kSaysUnknown | kSaysBad, kSaysGood | kSaysUnknown, kReplayedAlike};
constexpr Needs kOutputs{.outputs = true};

/// The third change of an analog output, or of digital ones.
std::optional<std::size_t> change_place(const Record& record, const std::string& kind) {
    const auto places = places_of<channel_event_t>(record, [&](const channel_event_t& e) { return e.kind == kind; });
    return places.size() < 4 ? std::nullopt : std::optional(places[2]);
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

}  // namespace

std::vector<Alteration> output_alterations() {
    std::vector<Alteration> all;
    for (const OutputAlteration& one : kOutputAlterations) {
        all.push_back({one.name,
                       [=](Record& r) { return change_at<channel_event_t>(r, change_place(r, one.kind), one.change); },
                       kOtherOutput, kNoMotion, kOutputs});
    }
    all.push_back({"laser_change_dropped", [](Record& r) { return erase_at(r, change_place(r, "analog")); },
                   kOutputLost, kNoMotion, kOutputs});
    all.push_back({"laser_change_twice",
                   [](Record& r) { return repeat_at(r, change_place(r, "analog")); },
                   {kSaysGood, kSaysGood, kSaysGood, kReplayedAlike},
                   kNoMotion,
                   kOutputs});
    return all;
}

}  // namespace lockstep::records
