// The events of programs are published once each, in order, when the motion comes to their places.
#include <algorithm>
#include <map>

#include "tests/unit/virtual/rig.hpp"

namespace lockstep {
namespace {

using EventKind = ProgramEvent::Kind;

/// Events in the order in which coordinators published them.
class Published : public VirtualObserver {
public:
    void on_coordinator(std::size_t /*process*/, Tick /*now*/, const CoordinatorOutputs& out) override {
        events.insert(events.end(), out.events.begin(), out.events.end());
    }
    std::vector<PublishedEvent> of_program() const {
        std::vector<PublishedEvent> of_program;
        std::ranges::copy_if(events, std::back_inserter(of_program), &PublishedEvent::is_of_program);
        return of_program;
    }
    std::vector<PublishedEvent> events;
};

class Events : public Rig {
protected:
    explicit Events(const VirtualOptions& options = {.machine = small_machine()}) : Rig(options) {
        vm.observe(published);
        vm.observe(log);
    }

    static Block event(std::int32_t line, EventKind kind, std::int32_t index = 0, double value = 0) {
        return {line, ProgramEvent{kind, index, value}};
    }
    static Block move(std::int32_t line, double x, double y, PathMode mode = PathMode::ExactStop) {
        return {line, ProgramMove{.target_mm = {x, y}, .feed_mm_s = 40, .mode = mode}};
    }
    /// X alone, then Y alone, then X alone.
    static Program program(PathMode mode = PathMode::ExactStop) {
        Program program = program_of({}, 0);
        program.blocks = {event(1, EventKind::SpindleForward, 0, 1000),
                          move(2, 25, 5, mode),
                          event(3, EventKind::FloodOn),
                          move(4, 25, 25, mode),
                          event(5, EventKind::OutputOn, 3),
                          event(6, EventKind::SpindleSpeed, 0, 2000),
                          move(7, 45, 25, mode),
                          event(8, EventKind::SpindleStop),
                          event(9, EventKind::CoolantOff)};
        return program;
    }
    static std::vector<Block> events_of(const Program& program) {
        std::vector<Block> events;
        std::ranges::copy_if(program.blocks, std::back_inserter(events),
                             [](const Block& block) { return std::holds_alternative<ProgramEvent>(block.action); });
        return events;
    }
    void expect_each_once(const Program& program) const {
        const std::vector<Block> wanted = events_of(program);
        const std::vector<PublishedEvent> got = published.of_program();
        ASSERT_EQ(got.size(), wanted.size());
        for (std::size_t i = 0; i < wanted.size(); ++i) {
            EXPECT_EQ(got[i].line, wanted[i].line);
            EXPECT_EQ(got[i].event, std::get<ProgramEvent>(wanted[i].action));
            EXPECT_EQ(program.blocks[got[i].block].line, wanted[i].line);
        }
    }
    const PublishedEvent& at_line(std::int32_t line) const {
        const auto found = std::ranges::find(published.events, line, &PublishedEvent::line);
        EXPECT_NE(found, published.events.end()) << "line " << line;
        return *found;
    }
    /// The first and last steps of an axis since the program began.
    std::vector<std::int64_t> steps_of(std::size_t axis, std::size_t from) const {
        std::vector<std::int64_t> ticks;
        for (std::size_t i = from; i < log.steps.size(); ++i) {
            if (log.steps[i].axis == axis) { ticks.push_back(log.steps[i].tick); }
        }
        return ticks;
    }

    Published published;
    StepLog log;
};

/// Only one axis moves at a time, so the steps show where each move begins.
TEST_F(Events, HappenAtTheTickAtWhichTheirNextMoveBegins) {
    for (const PathMode mode : {PathMode::ExactStop, PathMode::ExactPath}) {
        if (published.events.empty()) { home(); }
        published.events.clear();
        const std::size_t before = log.steps.size();
        Program its = program(mode);
        if (mode == PathMode::ExactPath) {
            its.start_mm = {45, 25};
            for (Block& block : its.blocks) {
                if (auto* move = std::get_if<ProgramMove>(&block.action)) {
                    move->target_mm = {50 - move->target_mm[0], 30 - move->target_mm[1]};
                }
            }
        }
        ASSERT_EQ(run(its).status, ReplyStatus::Accepted);
        ASSERT_TRUE(reaches(MachinePhase::Idle, 20)) << describe();
        expect_each_once(its);
        const auto x = steps_of(0, before);
        const auto y = steps_of(1, before);
        ASSERT_EQ(x.size(), 4000U);
        ASSERT_EQ(y.size(), 2000U);
        EXPECT_LT(at_line(1).tick.value, x.front());
        EXPECT_GT(at_line(1).tick.value, x.front() - 5000);
        EXPECT_GE(at_line(3).tick.value, x[1999]);
        EXPECT_LT(at_line(3).tick.value, y.front());
        EXPECT_GE(at_line(5).tick.value, y.back());
        EXPECT_EQ(at_line(6).tick, at_line(5).tick);
        EXPECT_LT(at_line(6).tick.value, x[2000]);
        EXPECT_GE(at_line(8).tick.value, x.back());
        for (const PublishedEvent& event : published.events) {
            EXPECT_FALSE(event.at_rest) << "line " << event.line.value_or(0);
        }
        EXPECT_EQ(vm.state()->devices, (ProgramDevices{.outputs = 8}));
    }
}

TEST_F(Events, AreNumberedAndNameTheirJobAndEpoch) {
    home();
    const Reply reply = run(program());
    ASSERT_TRUE(reaches(MachinePhase::Idle, 20)) << describe();
    for (std::size_t i = 0; i < published.events.size(); ++i) {
        EXPECT_EQ(published.events[i].sequence, i + 1);
        EXPECT_EQ(published.events[i].job, reply.job);
        EXPECT_EQ(published.events[i].term, vm.state()->term);
        EXPECT_EQ(published.events[i].epoch, vm.state()->epoch);
    }
}

TEST_F(Events, HappenOnceEachHoweverOftenTheJobIsHeld) {
    home();
    const Program its = program(PathMode::Blend);
    ASSERT_EQ(run(its).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Running, 1));
    int holds = 0;
    while (vm.state()->phase != MachinePhase::Idle && holds < 40) {
        wait(0.071);
        if (ask(CommandKind::Hold).status != ReplyStatus::Accepted) { continue; }
        ++holds;
        wait(0.25);
        if (vm.state()->phase != MachinePhase::Idle) { (void)ask(CommandKind::Resume); }
    }
    ASSERT_TRUE(reaches(MachinePhase::Idle, 20)) << describe();
    EXPECT_GT(holds, 10);
    expect_each_once(its);
}

/// The motion passes some places on its way to the rest.
TEST_F(Events, BetweenShortMovesHappenOnceEachHoweverOftenTheJobIsHeld) {
    home();
    Program its = program_of({}, 0);
    for (int k = 1; k <= 300; ++k) {
        its.blocks.push_back(move(2 * k, 5 + 0.1 * k, 5 + (k % 2) * 0.02, PathMode::Blend));
        its.blocks.push_back(event(2 * k + 1, k % 2 == 0 ? EventKind::OutputOn : EventKind::OutputOff, 1));
    }
    ASSERT_EQ(run(its).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Running, 1));
    for (int holds = 0; holds < 12 && vm.state()->phase != MachinePhase::Idle; ++holds) {
        wait(0.05);
        (void)ask(CommandKind::Hold);
        wait(0.25);
        (void)ask(CommandKind::Resume);
    }
    ASSERT_TRUE(reaches(MachinePhase::Idle, 20)) << describe();
    expect_each_once(its);
    EXPECT_TRUE(std::ranges::any_of(published.events, &PublishedEvent::at_rest));
    EXPECT_FALSE(std::ranges::all_of(published.events, &PublishedEvent::at_rest));
}

TEST_F(Events, BehindAPauseHappenWhenAPersonGoesOn) {
    home();
    Program its = program_of({{20, 5}}, 40);
    its.blocks.push_back(event(2, EventKind::Tool, 4));
    its.blocks.push_back({3, Pause{}});
    its.blocks.push_back(event(4, EventKind::MistOn));
    ASSERT_EQ(run(its).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Paused, 10));
    ASSERT_EQ(published.events.size(), 1U);
    EXPECT_EQ(vm.state()->devices.tool, 4);
    ASSERT_EQ(ask(CommandKind::Resume).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 10));
    expect_each_once(its);
    EXPECT_TRUE(published.events.back().at_rest);
    EXPECT_TRUE(vm.state()->devices.mist) << "a job that was done leaves it on";
}

TEST_F(Events, OfAProgramWithoutMovesHappenAtRest) {
    home();
    Program its = program_of({}, 0);
    its.blocks = {event(1, EventKind::SpindleReverse, 0, 300), event(2, EventKind::SpindleStop)};
    ASSERT_EQ(run(its).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 10));
    expect_each_once(its);
    EXPECT_EQ(published.events.front().epoch, 0U);
    EXPECT_TRUE(published.events.front().at_rest);
}

TEST_F(Events, AStopSwitchesSpindleAndCoolantOffAndLeavesOutputs) {
    home();
    Program its = program();
    its.blocks.insert(its.blocks.begin(), event(100, EventKind::OutputOn, 5));
    const Reply reply = run(its);
    ASSERT_TRUE(vm.advance_until([&] { return vm.state()->devices.flood; }, Ticks{5'000'000}));
    ASSERT_EQ(vm.state()->devices.spindle, SpindleDirection::Forward);
    ASSERT_EQ(ask(CommandKind::Stop).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 5));
    wait(0.01);
    EXPECT_EQ(vm.state()->devices, (ProgramDevices{.outputs = 32}));
    ASSERT_EQ(published.events.size(), 5U);
    for (const std::size_t i : {3U, 4U}) {
        EXPECT_FALSE(published.events[i].is_of_program);
        EXPECT_TRUE(published.events[i].at_rest);
        EXPECT_EQ(published.events[i].job, reply.job);
    }
    EXPECT_EQ(published.events[3].event.kind, EventKind::SpindleStop);
    EXPECT_EQ(published.events[4].event.kind, EventKind::CoolantOff);
}

/// Axes X (process 0) and Y (1), the coordinators (2, 3).
class EventsOfTwo : public Events {
protected:
    EventsOfTwo() : Events({.machine = small_machine(), .on_takeover = OnTakeover::Continue, .coordinators = 2}) {}

    void crash_at(double seconds) {
        home();
        Program its = program(PathMode::Blend);
        ASSERT_EQ(run(its).status, ReplyStatus::Accepted);
        wait(seconds);
        const Term term = vm.state()->term;
        vm.schedule(
            {.kind = VirtualFault::Kind::Crash, .process = *vm.owner(), .at = vm.now(), .lasts = {100'000'000}});
        ASSERT_TRUE(vm.advance_until([&] { return vm.state()->term > term && vm.state()->phase == MachinePhase::Idle; },
                                     Ticks{12'000'000}))
            << describe();
        EXPECT_EQ(vm.state()->outcome, JobOutcome::Done);
        expect_each_once(its);
        EXPECT_EQ(vm.state()->devices, (ProgramDevices{.outputs = 8}));
        std::map<Term, std::uint64_t> numbers;
        for (const PublishedEvent& event : published.events) { EXPECT_EQ(event.sequence, ++numbers[event.term]); }
    }
};

TEST_F(EventsOfTwo, HappenOnceEachWhenTheOwnerEndsInTheFirstMove) { crash_at(0.2); }
TEST_F(EventsOfTwo, HappenOnceEachWhenTheOwnerEndsJustBeforeAnEvent) { crash_at(0.52); }
TEST_F(EventsOfTwo, HappenOnceEachWhenTheOwnerEndsNearAnEvent) { crash_at(0.56); }
TEST_F(EventsOfTwo, HappenOnceEachWhenTheOwnerEndsJustBehindAnEvent) { crash_at(0.6); }
TEST_F(EventsOfTwo, HappenOnceEachWhenTheOwnerEndsInTheSecondMove) { crash_at(0.8); }
TEST_F(EventsOfTwo, HappenOnceEachWhenTheOwnerEndsInTheLastMove) { crash_at(1.4); }
TEST_F(EventsOfTwo, HappenOnceEachWhenTheOwnerEndsNearTheEnd) { crash_at(1.6); }

}  // namespace
}  // namespace lockstep
