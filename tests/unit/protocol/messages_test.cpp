// Fields that nobody has filled in say nothing. Otherwise an unknown value would be taken for a known one.
#include "core/protocol/messages.hpp"

#include <gtest/gtest.h>

#include "core/protocol/timing.hpp"

namespace lockstep {
namespace {

TEST(Messages, OfAnAxisThatNobodyFilledInSayNothing) {
    const AxisState axis;
    EXPECT_EQ(axis.identity, 0u);
    EXPECT_EQ(axis.stamp, 0);
    EXPECT_EQ(axis.epoch, 0u);
    EXPECT_EQ(axis.held, 0u);
    EXPECT_EQ(axis.ran, 0u);
    EXPECT_TRUE(axis.at_rest);
    EXPECT_FALSE(axis.homed);
    EXPECT_EQ(axis.fault, FaultCode::None);
    EXPECT_EQ(axis.following_error_steps, 0);
    EXPECT_EQ(axis.command_done, 0u);
    EXPECT_EQ(axis.command_fault, FaultCode::None);
    EXPECT_EQ(axis.refused_frames, 0u);
    EXPECT_FALSE(axis.hears_owner);
    EXPECT_EQ(axis.unproved, FaultCode::None);
    EXPECT_FALSE(axis.switches.any());
    EXPECT_EQ(axis.term, Term{});
    EXPECT_EQ(axis.term.number, 0u) << "nobody's";
    EXPECT_EQ(axis.term.coordinator, 0u);
}

TEST(Messages, OfAMachineThatNobodyFilledInSayNothing) {
    const MachineState machine{};
    EXPECT_EQ(machine.stamp, 0);
    EXPECT_EQ(machine.fault, FaultCode::None);
    EXPECT_EQ(machine.fault_motor, std::nullopt);
    EXPECT_EQ(machine.epoch, 0u);
    EXPECT_EQ(machine.sent, 0u);
    EXPECT_EQ(machine.job, 0u);
    EXPECT_FALSE(machine.line);
    EXPECT_EQ(machine.job_fault, FaultCode::None);
    EXPECT_FALSE(machine.lacks_blocks);
    EXPECT_EQ(machine.progress, 0);
    EXPECT_EQ(machine.remaining_s, 0);
    EXPECT_TRUE(machine.motors_present.empty());
    EXPECT_FALSE(machine.program);
    EXPECT_EQ(machine.events_from, 0u);
    EXPECT_EQ(machine.lost_records, 0u);
    const RecordCounts& record = machine.published;
    EXPECT_EQ(record.steps + record.runs + record.positions + record.figures + record.channel_events +
                  record.job_events + record.program_parts,
              0u);
    EXPECT_EQ(machine.process.reopened + machine.process.lost_log_lines, 0u);
}

TEST(Messages, OfFramesAndTheirRestsThatNobodyFilledInSayNothing) {
    const Frame frame;
    EXPECT_EQ(frame.epoch, 0u);
    EXPECT_EQ(frame.number, 0u);
    EXPECT_FALSE(frame.last);
    const FrameRest rest;
    EXPECT_EQ(rest.frame, 0u) << "where the epoch starts";
    EXPECT_EQ(rest.place, (PathPlace{0, {}}));
    EXPECT_FALSE(rest.last);
    EXPECT_EQ(rest.digest, 0u);
}

TEST(Messages, OfAnEventThatNobodyFilledInSayThatAProgramAskedForItAndNoMore) {
    const PublishedEvent event;
    EXPECT_EQ(event.sequence, 0u);
    EXPECT_EQ(event.job, 0u);
    EXPECT_EQ(event.epoch, 0u);
    EXPECT_FALSE(event.at_rest);
    EXPECT_TRUE(event.is_of_program);
    EXPECT_EQ(event.block, 0u);
    EXPECT_FALSE(event.line);
}

TEST(Messages, OfAClientAndToItThatNobodyFilledInAskForNothing) {
    const Command command;
    EXPECT_EQ(command.kind, CommandKind::Stop);
    EXPECT_TRUE(command.axes.empty());
    EXPECT_EQ(command.program, 0u);
    EXPECT_FALSE(command.ticks);
    EXPECT_FALSE(command.feed_percent);
    EXPECT_FALSE(command.rapid_percent);
    EXPECT_EQ(command.writer.id, 0u);
    EXPECT_FALSE(command.takes_over);
    const AxisCommand order;
    EXPECT_EQ(order.sequence, 0u);
    EXPECT_EQ(order.axis, 0u);
    EXPECT_EQ(order.target_steps, 0);
    EXPECT_FALSE(order.ticks);
    EXPECT_EQ(order.speed_mm_s, 0);
    const ProgramChunk chunk;
    EXPECT_EQ(chunk.index, 0u);
    EXPECT_FALSE(chunk.count) << "more follow";
    EXPECT_FALSE(chunk.share);
    EXPECT_EQ(chunk.writer, 0u);
    const ProgramPart part;
    EXPECT_EQ(part.client, 0u);
    EXPECT_EQ(part.sequence, 0u);
    EXPECT_EQ(part.program, 0u);
    EXPECT_EQ(part.index, 0u);
    EXPECT_FALSE(part.is_question);
    EXPECT_FALSE(part.is_last);
    EXPECT_FALSE(part.share);
    const Reply reply;
    EXPECT_EQ(reply.fault, FaultCode::None);
    EXPECT_EQ(reply.job, 0u);
    EXPECT_EQ(reply.parts, 0u);
    EXPECT_EQ(reply.free_blocks, 0u);
}

/// docs/configuration.md states these defaults.
TEST(ProtocolTiming, WithoutAConfigurationIsThatOfTheDocumentation) {
    const ProtocolTiming timing;
    EXPECT_EQ(timing.slot_us, 10'000);
    EXPECT_EQ(timing.stall_slots, 10);
    EXPECT_EQ(timing.late_check_slots, 2);
    EXPECT_EQ(timing.freshness_slots, 11);
    EXPECT_EQ(timing.send_ahead_slots, 31);
    EXPECT_EQ(timing.frame_slots, 5);
    EXPECT_EQ(timing.time_source, TimeSource::Shared);
    EXPECT_EQ(timing.jog_hold_us, 20'000);
    EXPECT_EQ(timing.clock_error_limit_us, 2500);
}

}  // namespace
}  // namespace lockstep
