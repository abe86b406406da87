// The recorded events of programs are compared with their programs: each once, in order, at its place.
#include <gtest/gtest.h>

#include <algorithm>

#include "clients/verification/verification.hpp"
#include "tests/unit/verification/altered_log.hpp"
#include "tests/unit/verification/recorded_machine.hpp"

namespace lockstep::verification {
namespace {

using EventKind = ProgramEvent::Kind;

class EventsInARecord : public testing::Test {
protected:
    static std::filesystem::path path() { return test::test_directory() / "events.lcm"; }

    Block event(EventKind kind, std::int32_t index = 0, double value = 0) {
        return {++line, ProgramEvent{kind, index, value}};
    }
    Block move(double x, double y, PathMode mode = PathMode::Blend) {
        return {++line, ProgramMove{.target_mm = {x, y}, .feed_mm_s = 50, .mode = mode}};
    }
    Program program_from(std::vector<double> start_mm) {
        line = 0;
        return {.name = "events.gcode", .axes = {"X", "Y"}, .start_mm = std::move(start_mm), .blocks = {}};
    }
    /// A program of four moves with five events: one before, three between and one behind the moves.
    Program square(double x, double y) {
        Program program = program_from({x, y});
        program.blocks.push_back(event(EventKind::SpindleForward, 0, 1200));
        program.blocks.push_back(move(x + 30, y));
        program.blocks.push_back(event(EventKind::FloodOn));
        program.blocks.push_back(move(x + 30, y + 30, PathMode::ExactStop));
        program.blocks.push_back(event(EventKind::OutputOn, 7));
        program.blocks.push_back(move(x, y + 30));
        program.blocks.push_back(event(EventKind::SpindleSpeed, 0, 900));
        program.blocks.push_back(move(x, y));
        program.blocks.push_back(event(EventKind::Tool, 3));
        return program;
    }
    /// Holds the first program and resumes it, runs one with pauses and many events, and stops one with the spindle on.
    void record() {
        const MachineSetup machine = test::example("two-axis");
        const std::vector<double> start = parked_mm(machine);
        test::RecordedMachine recorded(machine, path());
        recorded.home();
        recorded.begin(square(start[0], start[1]));
        for (int k = 0; k < 4; ++k) {
            recorded.advance_ms(270);
            recorded.command(CommandKind::Hold);
            ASSERT_TRUE(recorded.reaches(MachinePhase::Holding));
            recorded.command(CommandKind::Resume);
        }
        ASSERT_TRUE(recorded.reaches(MachinePhase::Idle));
        ASSERT_EQ(recorded.vm().state()->outcome, JobOutcome::Done);
        Program paused = program_from(start);
        paused.blocks.push_back(event(EventKind::MistOn));
        paused.blocks.push_back({++line, Pause{}});
        for (int k = 1; k <= 60; ++k) {
            paused.blocks.push_back(move(start[0] + 0.2 * k, start[1]));
            paused.blocks.push_back(event(EventKind::AnalogOutput, 1, k));
        }
        paused.blocks.push_back({++line, Pause{}});
        paused.blocks.push_back(event(EventKind::OutputOff, 7));
        paused.blocks.push_back(move(start[0], start[1]));
        recorded.vm().give_program(50, paused);
        recorded.command(CommandKind::Run, 50);
        ASSERT_TRUE(recorded.reaches(MachinePhase::Paused));
        recorded.command(CommandKind::Resume);
        recorded.advance_ms(200);
        recorded.command(CommandKind::Hold);
        ASSERT_TRUE(recorded.reaches(MachinePhase::Holding));
        recorded.command(CommandKind::Resume);
        ASSERT_TRUE(recorded.reaches(MachinePhase::Paused));
        recorded.command(CommandKind::Resume);
        ASSERT_TRUE(recorded.reaches(MachinePhase::Idle));
        ASSERT_EQ(recorded.vm().state()->outcome, JobOutcome::Done);
        recorded.begin(square(start[0], start[1]));
        recorded.advance_ms(900);
        recorded.command(CommandKind::Stop);
        ASSERT_TRUE(recorded.reaches(MachinePhase::Idle));
        recorded.advance_ms(1500);
    }
    Findings altered(const std::function<void(test::AlteredLog&)>& alter) {
        test::AlteredLog log(path());
        alter(log);
        return verify_log(log.write(test::test_directory() / "altered.lcm")).value();
    }
    /// Changes the event with this number in its term.
    static auto numbered(std::int64_t number, std::function<void(program_event_t&)> change) {
        return [number, change](test::AlteredLog& log) {
            EXPECT_EQ(log.change<program_event_t>("_EVENTS",
                                                  [&](program_event_t& event) {
                                                      if (event.number != number) { return false; }
                                                      change(event);
                                                      return true;
                                                  }),
                      1);
        };
    }
    /// Gives the messages of jobs and events from the second one with this number on the next numbers.
    static void renumber(test::AlteredLog& log, std::int64_t from) {
        bool is_first = true;
        for (test::AlteredLog::Event& event : log.events()) {
            const auto raise = [&](auto message) {
                if (message.sequence < from || std::exchange(is_first, false)) { return; }
                ++message.sequence;
                message.encode(event.data.data(), 0, static_cast<int>(event.data.size()));
            };
            if (event.channel.ends_with("_EVENTS")) { raise(decode_lcm<program_event_t>(event.data).value()); }
            if (event.channel.ends_with("_JOB")) { raise(decode_lcm<job_t>(event.data).value()); }
        }
    }
    std::vector<program_event_t> recorded() {
        std::vector<program_event_t> events;
        test::AlteredLog(path()).change<program_event_t>("_EVENTS", [&](program_event_t& event) {
            events.push_back(event);
            return false;
        });
        return events;
    }
    std::int32_t line = 0;
};

TEST_F(EventsInARecord, AreExact) {
    record();
    const Findings findings = verify_log(path()).value();
    EXPECT_TRUE(findings.is_exact()) << to_text(findings);
    const auto events = recorded();
    EXPECT_EQ(findings.events, static_cast<std::int64_t>(events.size()));
    EXPECT_GT(events.size(), 5U + 62U + 3U);
    EXPECT_EQ(std::ranges::count(events, 0, &program_event_t::of_program), 2);
    EXPECT_GT(std::ranges::count(events, 1, &program_event_t::at_rest), 4);
    EXPECT_NE(to_text(findings).find(std::to_string(events.size()) + " events"), std::string::npos);
    EXPECT_EQ(to_report(findings).events_compared(), static_cast<std::int64_t>(events.size()));
}

TEST_F(EventsInARecord, AtAnotherTickAreFound) {
    record();
    const Findings findings = altered(numbered(3, [](program_event_t& event) { ++event.tick; }));
    ASSERT_TRUE(findings.difference);
    ASSERT_TRUE(findings.difference->tick_expected && findings.difference->tick_seen);
    EXPECT_EQ(findings.difference->tick_seen->value, findings.difference->tick_expected->value + 1);
    EXPECT_NE(findings.difference->text.find("line 5"), std::string::npos) << findings.difference->text;
    EXPECT_NE(findings.difference->commanded.find("events.gcode, line 5"), std::string::npos)
        << findings.difference->commanded;
}

TEST_F(EventsInARecord, WithAnyOtherValueAreFound) {
    record();
    const std::vector<std::function<void(program_event_t&)>> changes{
        [](program_event_t& event) { event.kind = "spindle-reverse"; },
        [](program_event_t& event) { ++event.index; },
        [](program_event_t& event) { event.value += 0.5; },
        [](program_event_t& event) { ++event.line; },
        [](program_event_t& event) { ++event.block; },
        [](program_event_t& event) { ++event.epoch; },
        [](program_event_t& event) { ++event.job; },
        [](program_event_t& event) { event.at_rest = 1; },
        [](program_event_t& event) { event.of_program = 0; },
    };
    for (std::size_t i = 0; i < changes.size(); ++i) {
        EXPECT_TRUE(altered(numbered(1, changes[i])).difference) << "change " << i;
    }
}

TEST_F(EventsInARecord, ThatAreMissingAreFound) {
    record();
    const auto events = recorded();
    const auto count = static_cast<std::int64_t>(events.size());
    for (const std::int64_t number : {std::int64_t{1}, std::int64_t{3}, std::int64_t{5}, std::int64_t{6}, count - 30,
                                      count - 3, count - 1, count}) {
        const Findings findings = altered([&](test::AlteredLog& log) {
            EXPECT_EQ(log.leave_out<program_event_t>(
                          "_EVENTS", [&](const program_event_t& event) { return event.number == number; }),
                      1U);
        });
        EXPECT_EQ(findings.verdict(), Verdict::Unknown) << "event " << number << " of " << count << to_text(findings);
    }
}

TEST_F(EventsInARecord, ThatAreRecordedTwiceAreFound) {
    record();
    for (const std::int64_t number : {std::int64_t{1}, std::int64_t{4}, std::int64_t{40}}) {
        const Findings findings = altered([&](test::AlteredLog& log) {
            auto& events = log.events();
            const auto found = std::ranges::find_if(events, [&](const test::AlteredLog::Event& event) {
                return event.channel.ends_with("_EVENTS") &&
                       decode_lcm<program_event_t>(event.data).value().number == number;
            });
            ASSERT_NE(found, events.end());
            const test::AlteredLog::Event again = *found;
            const std::int64_t from = decode_lcm<program_event_t>(again.data).value().sequence;
            events.insert(found, again);
            renumber(log, from);
        });
        EXPECT_TRUE(findings.difference) << "event " << number;
    }
}

/// Logs that are cut anywhere are never found to differ.
TEST_F(EventsInARecord, OfALogThatEndsEarlyAreComparedAsFarAsTheyGo) {
    record();
    const std::size_t all = test::AlteredLog(path()).events().size();
    for (std::size_t part = 1; part < 40; ++part) {
        const Findings findings = altered([&](test::AlteredLog& log) { log.cut_to(all * part / 40); });
        EXPECT_FALSE(findings.difference) << part << "\n" << to_text(findings);
    }
}

TEST_F(EventsInARecord, OfALogThatBeginsLateAreComparedFromItsFirstJob) {
    record();
    const std::size_t all = test::AlteredLog(path()).events().size();
    for (std::size_t part = 1; part < 20; ++part) {
        test::AlteredLog log(path());
        auto& events = log.events();
        events.erase(events.begin(), events.begin() + static_cast<std::ptrdiff_t>(all * part / 20));
        const auto findings = verify_log(log.write(test::test_directory() / "altered.lcm"));
        if (!findings) {
            EXPECT_NE(findings.error().find("no step, run or job"), std::string::npos) << findings.error();
            continue;
        }
        EXPECT_FALSE(findings->difference) << part << "\n" << to_text(*findings);
    }
}

class EventsOfTwo : public EventsInARecord {
protected:
    void record_takeover(std::int64_t crash_ms) {
        const MachineSetup machine = test::example("two-axis");
        const std::vector<double> start = parked_mm(machine);
        test::RecordedMachine recorded({.machine = machine,
                                        .config_hash = config_hash(machine),
                                        .on_takeover = OnTakeover::Continue,
                                        .coordinators = 2},
                                       path());
        recorded.home();
        recorded.begin(square(start[0], start[1]));
        recorded.advance_ms(crash_ms);
        VirtualMachine& vm = recorded.vm();
        vm.schedule(
            {.kind = VirtualFault::Kind::Crash, .process = *vm.owner(), .at = vm.now(), .lasts = {100'000'000}});
        const Term term = vm.state()->term;
        ASSERT_TRUE(vm.advance_until([&] { return vm.state()->term > term && vm.state()->phase == MachinePhase::Idle; },
                                     Ticks{20'000'000}));
        ASSERT_EQ(vm.state()->outcome, JobOutcome::Done);
        recorded.advance_ms(1500);
    }
};

TEST_F(EventsOfTwo, AreExact) {
    for (std::int64_t crash_ms = 150; crash_ms < 2400; crash_ms += 150) {
        record_takeover(crash_ms);
        if (HasFatalFailure()) { return; }
        const Findings findings = verify_log(path()).value();
        EXPECT_FALSE(findings.difference) << crash_ms << "\n" << to_text(findings);
        EXPECT_TRUE(findings.unknown.empty()) << crash_ms << "\n" << to_text(findings);
        EXPECT_EQ(findings.events, 5) << crash_ms << "\n" << to_text(findings);
    }
}

}  // namespace
}  // namespace lockstep::verification
