// Other machines, missing axes and messages of another version.
#include <algorithm>

#include "tests/records/alterations/alterations.hpp"
#include "tests/records/alterations/places.hpp"

namespace lockstep::records {
namespace {

template <typename Type>
void rename(Message& message, const std::string& machine) {
    auto content = decoded<Type>(message);
    if (!content) { return; }
    content->machine = machine;
    message.data = encoded(*content);
}

Message of_machine(Message message, const std::string& machine) {
    rename<step_batch_t>(message, machine);
    rename<run_t>(message, machine);
    rename<job_t>(message, machine);
    rename<program_event_t>(message, machine);
    rename<channel_event_t>(message, machine);
    rename<program_part_t>(message, machine);
    rename<record_mark2_t>(message, machine);
    rename<axis_position_t>(message, machine);
    rename<axis_health_t>(message, machine);
    const std::size_t at = message.channel.find("_MILL_");
    if (at != std::string::npos) { message.channel.replace(at, 6, "_LATHE_"); }
    return message;
}

bool add_second_machine(Record& record, bool is_at_the_end) {
    Record both;
    for (const Message& message : record) {
        both.push_back(message);
        if (!is_at_the_end) { both.push_back(of_machine(message, "lathe")); }
    }
    if (is_at_the_end) {
        for (const Message& message : record) { both.push_back(of_machine(message, "lathe")); }
    }
    record = std::move(both);
    return true;
}

/// The axis is as if it had never been there.
bool erase_axis(Record& record, const std::string& axis, bool with_marks) {
    return std::erase_if(record, [&](const Message& message) {
               const auto mark = decoded<record_mark2_t>(message);
               if (mark) { return with_marks && (mark->process == axis || mark->witness == axis); }
               return message.channel.find("_" + axis + "_") != std::string::npos;
           }) > 0;
}

bool change_version(Record& record, const std::string& ending) {
    for (Message& message : record) {
        if (is_on(message, ending) && !message.data.empty()) { message.data[3] ^= 0x40; }
    }
    return true;
}

bool add_foreign(Record& record) {
    for (std::size_t at = 0; at < record.size(); at += 50) {
        record.insert(record.begin() + static_cast<std::ptrdiff_t>(at), {"CAMERA", record[at].utime, {1, 2, 3}});
    }
    return true;
}

bool add_loss(Record& record) {
    record_loss_t loss{};
    const std::size_t at = record.size() / 2;
    loss.utime = loss.first_utime = record[at].utime;
    loss.machine = "mill";
    loss.axis = "X";
    loss.messages = 4;
    record.insert(record.begin() + static_cast<std::ptrdiff_t>(at),
                  {"LOCKSTEP_MILL_X_LOSS", record[at].utime, encoded(loss)});
    return true;
}

}  // namespace

std::vector<Alteration> machine_alterations() {
    const Expected two{kSaysGood, kSaysDoubtful | kSaysUnknown | kSaysRefused, kSaysGood, kSaysGood};
    const Expected absent{kSaysUnknown, kSaysUnknown, kSaysUnknown, kSaysGood | kSaysUnknown};
    const Expected other_version{kSaysUnknown | kSaysRefused, kSaysDoubtful | kSaysUnknown | kSaysRefused,
                                 kSaysUnknown | kSaysRefused, kSaysUnknown | kSaysRefused};
    return {
        {"two_machines_side_by_side", [](Record& r) { return add_second_machine(r, false); }, two, kNoMotion},
        {"two_machines_one_after_the_other",
         [](Record& r) { return add_second_machine(r, true); },
         {kSaysGood, kSaysDoubtful | kSaysUnknown | kSaysRefused, kSaysGood | kSaysBad, kSaysGood},
         kNoMotion},
        {"axis_y_absent", [](Record& r) { return erase_axis(r, "Y", true); }, absent},
        {"axis_y_absent_but_for_its_marks", [](Record& r) { return erase_axis(r, "Y", false); }, absent},
        {"all_of_another_version",
         [](Record& r) { return change_version(r, ""); },
         {kSaysRefused, kSaysUnknown | kSaysRefused, kSaysRefused | kSaysUnknown, kSaysRefused}},
        {"steps_of_another_version", [](Record& r) { return change_version(r, "_STEPS"); }, other_version},
        {"runs_of_another_version", [](Record& r) { return change_version(r, "_RUN"); }, other_version},
        {"jobs_of_another_version",
         [](Record& r) { return change_version(r, "_JOB"); },
         {kSaysUnknown | kSaysRefused, kSaysDoubtful | kSaysUnknown | kSaysRefused, kSaysUnknown | kSaysRefused,
          kSaysGood | kSaysUnknown}},
        {"foreign_channels", add_foreign, kValid, kNoMotion},
        {"loss_message",
         add_loss,
         {kSaysGood | kSaysUnknown, kSaysGood | kSaysDoubtful | kSaysUnknown, kSaysGood | kSaysUnknown,
          kSaysGood | kSaysUnknown},
         kNoMotion},
    };
}

}  // namespace lockstep::records
