// Samples of positions that contradict the steps, are wrong, or are lost. A machine in virtual time records no health.
#include "tests/records/alterations/alterations.hpp"
#include "tests/records/alterations/places.hpp"
#include "tests/records/record_times.hpp"

namespace lockstep::records {
namespace {

/// The steps are as planned, but a sample contradicts them.
constexpr Expected kWrongSample{kSaysGood | kSaysBad | kSaysUnknown, kSaysDoubtful | kSaysBad, kSaysGood, kSaysGood};
constexpr Expected kSampleLost{kSaysGood | kSaysUnknown, kSaysGood | kSaysDoubtful, kSaysUnknown, kSaysGood};

template <typename Type>
std::optional<std::size_t> sample_in_job(const Record& record) {
    const RecordedSpan span = first_span(record, "run");
    const auto places =
        places_of<Type>(record, [&](const Type& sample) { return sample.axis == "X" && span.contains(sample.utime); });
    return places.empty() ? std::nullopt : std::optional(places[places.size() / 2]);
}

template <typename Type>
Alteration changed(std::string name, void (*change)(Type&), const Expected& expected) {
    return {std::move(name), [=](Record& r) { return change_at<Type>(r, sample_in_job<Type>(r), change); }, expected,
            kNoMotion};
}

template <typename Type>
void add_lost_sample(const std::string& what, std::vector<Alteration>& all) {
    all.push_back(
        {what + "_dropped", [](Record& r) { return erase_at(r, sample_in_job<Type>(r)); }, kSampleLost, kNoMotion});
    all.push_back({what + "_twice", [](Record& r) { return repeat_at(r, sample_in_job<Type>(r)); }, kValid, kNoMotion});
    all.push_back({what + "_all_dropped",
                   [](Record& r) { return leave_out<Type>(r, [](const Type&) { return true; }) > 0; },
                   {kSaysGood | kSaysUnknown, kSaysGood | kSaysDoubtful | kSaysUnknown, kSaysUnknown, kSaysGood},
                   kNoMotion});
}

}  // namespace

std::vector<Alteration> sample_alterations() {
    using Sample = axis_position_t;
    std::vector<Alteration> all{
        changed<Sample>(
            "position_a_thousand_steps_off", [](Sample& s) { s.position_steps += 1000; }, kWrongSample),
        changed<Sample>(
            "position_five_mm_off", [](Sample& s) { s.position_mm += 5; }, kWrongSample),
        changed<Sample>(
            "following_error_of_500_steps", [](Sample& s) { s.following_error_steps = 500; }, kWrongSample),
        changed<Sample>(
            "position_with_a_fault",
            [](Sample& s) {
                s.fault = 12;
                s.state = "Fault";
            },
            kWrongSample),
    };
    add_lost_sample<Sample>("position", all);
    return all;
}

}  // namespace lockstep::records
