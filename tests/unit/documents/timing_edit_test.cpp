// The edit rewrites the slots of a machine's file and leaves everything else.
#include <gtest/gtest.h>

#include <string>

#include "services/documents/edit/timing_edit.hpp"
#include "services/documents/machine_file.hpp"

namespace lockstep {
namespace {

const ProtocolTiming kFast{.slot_us = 2000,
                           .stall_slots = 3,
                           .late_check_slots = 1,
                           .freshness_slots = 4,
                           .send_ahead_slots = 16,
                           .frame_slots = 4};

std::string machine_with(const std::string& timing) {
    return "# a mill\nname: \"m\"\n" + timing +
           "axis {\n  name: \"X\"  # the bed\n  steps_per_mm: 80\n  start_velocity_mm_s: 10\n"
           "  max_velocity_mm_s: 150\n  max_accel_mm_s2: 1500\n  position_min_mm: 0\n  position_max_mm: 200\n"
           "  homing { search_velocity_mm_s: 10 latch_velocity_mm_s: 2 pulloff_mm: 2 }\n}\n";
}

ProtocolTiming timing_of(const std::string& text) {
    const auto machine = parse_machine(text);
    EXPECT_TRUE(machine) << to_text("machine", machine.error());
    return machine ? machine->timing : ProtocolTiming{};
}

void expect_fast(const ProtocolTiming& timing) {
    EXPECT_EQ(timing.slot_us, 2000);
    EXPECT_EQ(timing.stall_slots, 3);
    EXPECT_EQ(timing.late_check_slots, 1);
    EXPECT_EQ(timing.freshness_slots, 4);
    EXPECT_EQ(timing.send_ahead_slots, 16);
    EXPECT_EQ(timing.frame_slots, 4);
}

TEST(TimingEdit, AddsABlockWhereThereIsNone) {
    const std::string text = machine_with("");
    const auto edited = with_slots(text, kFast);
    ASSERT_TRUE(edited) << to_text("machine", edited.error());
    EXPECT_TRUE(edited->starts_with(text));
    expect_fast(timing_of(*edited));
}

TEST(TimingEdit, ReplacesNumbersAndKeepsCommentsAndOtherKeys) {
    const std::string text = machine_with(
        "timing {  # of the old host\n\tslot_us: 10000\t# long\n  stall_slots:10\n"
        "  time_source: NETWORK\n}\n");
    const auto edited = with_slots(text, kFast);
    ASSERT_TRUE(edited) << to_text("machine", edited.error());
    expect_fast(timing_of(*edited));
    EXPECT_EQ(timing_of(*edited).time_source, TimeSource::Network);
    EXPECT_TRUE(edited->contains("# of the old host\n"));
    EXPECT_TRUE(edited->contains("\tslot_us: 2000\t# long\n"));
    EXPECT_TRUE(edited->contains("stall_slots:3\n"));
    EXPECT_TRUE(edited->ends_with(text.substr(text.find("axis"))));
}

TEST(TimingEdit, LowersTheLimitOfTheClockErrorWithTheSlot) {
    const auto edited = with_slots(machine_with("timing { time_source: NETWORK clock_error_limit_us: 2500 }\n"), kFast);
    ASSERT_TRUE(edited) << to_text("machine", edited.error());
    EXPECT_EQ(timing_of(*edited).clock_error_limit_us, 500);
}

TEST(TimingEdit, RefusesATextThatIsNoMachineAndACommentInAKey) {
    EXPECT_FALSE(with_slots("nonsense {", kFast));
    const auto split = with_slots(machine_with("timing { slot_us: # 5\n 10000 }\n"), kFast);
    ASSERT_FALSE(split);
    EXPECT_TRUE(split.error().front().message.contains("a comment is between"));
}

}  // namespace
}  // namespace lockstep
