// Outputs change in frames: at the places of the program's events, and in proportion to the speed of the path.
#include "core/coordinator/path/output_planner.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/coordinator/path/program_plan.hpp"
#include "tests/unit/coordinator/long_axes.hpp"

namespace lockstep {
namespace {

using Kind = ProgramEvent::Kind;

constexpr double kFeed_mm_s = 100;

MachineConfig laser_machine() {
    MachineConfig machine = two_long_axes();
    machine.outputs = {
        {.name = "laser",
         .motor = "X",
         .use = OutputUse::Spindle,
         .pwm = PwmConfig{.hz = 5000, .full_scale = 1000, .follows_speed = true},
         .stays_at_interruption = false},
        {.name = "valve", .motor = "Y", .channel = 3, .number = 7},
        {.name = "air", .motor = "Y", .channel = 1, .use = OutputUse::Flood},
        {.name = "heat", .motor = "Y", .channel = 1, .number = 2, .pwm = PwmConfig{.hz = 100, .full_scale = 10}},
    };
    return machine;
}

Block move_to(double x, double y, double feed_mm_s = kFeed_mm_s) {
    return {{}, ProgramMove{{x, y}, feed_mm_s, feed_mm_s == 0}};
}
Block word(Kind kind, std::int32_t index = 0, double value = 0) { return {{}, ProgramEvent{kind, index, value}}; }

/// The outputs of one motor's device, which run as a device runs them.
struct Outputs {
    std::uint16_t digital = 0;
    std::array<RampAnalog, kMostAnalogOutputs> ramps{};
    std::array<Tick, kMostAnalogOutputs> since{};

    void change(const OutputChange& change, Tick start) {
        if (const auto* levels = std::get_if<SetDigital>(&change.what)) {
            digital = static_cast<std::uint16_t>((digital & ~levels->mask) | levels->levels);
        } else if (const auto* ramp = std::get_if<RampAnalog>(&change.what)) {
            ramps[ramp->channel] = *ramp;
            since[ramp->channel] = start + change.at;
        }
    }
    /// Of full scale.
    double analog(std::size_t channel, Tick now) const {
        const double value =
            static_cast<double>(ramps[channel].value) +
            static_cast<double>(ramps[channel].slope) * static_cast<double>((now - since[channel]).value);
        return std::clamp(value / static_cast<double>(kFullScale), 0.0, 1.0);
    }
};

class Planned : public testing::Test {
protected:
    explicit Planned(MachineConfig config = laser_machine()) : machine(std::move(config)) {}

    /// Plans all frames of a program.
    void plan(const std::vector<Block>& blocks, const ProgramDevices& devices = {}) {
        program_ = blocks;
        const auto program = std::make_shared<const Program>(
            Program{.name = "burn", .axes = {"X", "Y"}, .start_mm = {0, 0}, .blocks = blocks});
        const auto leg = ProgramPlanner(machine).plan(*program, {0, 0}).value()[0];
        OwnedSource source = ProgramPlanner(machine).frames(program, leg);
        source->resume({0, {}}, std::vector<Position>(2), {});
        OutputPlanner planner(machine);
        planner.begin(devices);
        for (source->read_ahead(); !source->is_done(); source->read_ahead()) {
            frames.push_back(*source->next().value());
            planner.plan(frames.back(), {source->events(), source->tail_events()}, outputs.emplace_back());
            for (const FrameEvent& event : source->events()) {
                events.push_back({starts.back() + event.at, event.event});
            }
            for (const MoveBegin& begin : source->begins()) {
                begins.emplace_back(starts.back() + Ticks{std::llround(begin.at)}, begin.block);
            }
            starts.push_back(starts.back() + frames.back().ticks);
        }
    }

    double seconds() const { return static_cast<double>(starts.back().value) / machine.ticks_per_second(); }
    /// The speed along the path at a tick of a body or tail, in mm/s, by the pieces of both motors.
    template <typename Pieces>
    double speed_at(const PathFrame& frame, Pieces AxisTrack::*part, Ticks at) const {
        double square = 0;
        for (std::size_t i = 0; i < frame.axes.size(); ++i) {
            Ticks gone;
            for (const Piece& piece : frame.axes[i].*part) {
                if (at <= gone + piece.ticks) {
                    const double steps = static_cast<double>(piece.velocity_after(at - gone)) * 0x1p-64;
                    const double mm_s = steps * machine.ticks_per_second() / machine.axes[i].steps_per_mm;
                    square += mm_s * mm_s;
                    break;
                }
                gone += piece.ticks;
            }
        }
        return std::sqrt(square);
    }
    /// Runs the bodies up to frame `last`, and calls visit(frame, tick in it, outputs of X, outputs of Y) for each
    /// tenth tick. Then runs the tail of `last`, and calls `visit_tail` in the same way.
    template <typename Visit, typename VisitTail>
    void run(std::size_t last, Visit visit, VisitTail visit_tail) {
        std::array<Outputs, 2> devices;
        for (std::size_t k = 0; k <= last; ++k) {
            run_part(outputs[k], &OutputTrack::body, starts[k], frames[k].ticks, devices,
                     [&](Ticks at) { visit(frames[k], at, devices); });
        }
        Ticks tail;
        for (const AxisTrack& track : frames[last].axes) { tail = std::max(tail, total_ticks(track.tail)); }
        run_part(outputs[last], &OutputTrack::tail, starts[last + 1], tail, devices,
                 [&](Ticks at) { visit_tail(frames[last], at, devices); });
    }
    template <typename Changes, typename Visit>
    static void run_part(const std::vector<MotorOutputs>& of, Changes OutputTrack::*part, Tick start, Ticks ticks,
                         std::array<Outputs, 2>& devices, Visit visit) {
        std::array<std::size_t, 2> next{};
        for (Ticks at{1}; at <= ticks; at += Ticks{1}) {
            for (std::size_t m = 0; m < 2; ++m) {
                const auto& changes = of[m].track.*part;
                for (; next[m] < changes.size() && changes[next[m]].at <= at; ++next[m]) {
                    devices[m].change(changes[next[m]], start);
                }
            }
            if (at.value % 10 == 0 || at == ticks) { visit(at); }
        }
    }
    /// The power at a tick by the program's words: that at the feed, and the feed in mm/s. nullopt beside the begin of
    /// a move.
    struct Settings {
        double share = 0;
        double feed_mm_s = 0;
    };
    std::optional<Settings> settings_at(Tick now) const {
        std::uint32_t block = 0;
        for (const auto& [tick, begun] : begins) {
            if (length_of(now - tick) <= Ticks{10}) { return std::nullopt; }
            if (tick < now) { block = begun; }
        }
        ProgramDevices devices;
        for (std::uint32_t k = 0; k < block; ++k) {
            if (const auto* event = std::get_if<ProgramEvent>(&program_[k].action)) { devices.apply(*event); }
        }
        const auto& move = std::get<ProgramMove>(program_[block].action);
        const bool burns = devices.spindle == SpindleDirection::Reverse && !move.rapid;
        return Settings{burns ? devices.spindle_rpm / 1000 : 0, move.rapid ? 1 : move.feed_mm_s};
    }

    MachineConfig machine;
    std::vector<PathFrame> frames;
    std::vector<std::vector<MotorOutputs>> outputs;  // by frame
    std::vector<Tick> starts{Tick{}};                // by frame, and the end
    struct At {
        Tick tick;
        PathEvent event;
    };
    std::vector<At> events;
    std::vector<std::pair<Tick, std::uint32_t>> begins;  // of moves, by block

private:
    std::vector<Block> program_;
};

const std::vector<Block> kBurn{word(Kind::SpindleReverse, 0, 600),
                               move_to(20, 0),
                               move_to(20, 15, 40),
                               word(Kind::SpindleSpeed, 0, 900),
                               move_to(5, 15),
                               move_to(5, 5, 0),
                               move_to(40, 30),
                               word(Kind::SpindleStop),
                               move_to(50, 30)};

TEST_F(Planned, AnEventSwitchesItsOutputAtTheTickOfItsPlaceAndNoOther) {
    plan({move_to(20, 0), word(Kind::OutputOn, 7), word(Kind::FloodOn), move_to(20, 20), word(Kind::OutputOff, 7),
          move_to(0, 20)});
    ASSERT_EQ(events.size(), 3u);
    std::vector<std::pair<Tick, std::uint16_t>> changes;
    for (std::size_t k = 0; k < outputs.size(); ++k) {
        ASSERT_EQ(outputs[k].size(), 2u);
        for (const OutputChange& change : outputs[k][1].track.body) {
            const auto* levels = std::get_if<SetDigital>(&change.what);
            if (levels != nullptr) { changes.emplace_back(starts[k] + change.at, levels->levels); }
        }
    }
    ASSERT_EQ(changes.size(), 3u);
    EXPECT_EQ(changes[0], std::pair(Tick{1}, std::uint16_t{0})) << "the first frame states all levels";
    EXPECT_EQ(changes[1], std::pair(events[0].tick, std::uint16_t{0b1010})) << "both events change one word";
    EXPECT_EQ(changes[2], std::pair(events[2].tick, std::uint16_t{0}));
}

TEST_F(Planned, TheFirstFrameRestoresTheLevelsThatTheProgramHadLeft) {
    ProgramDevices devices;
    devices.apply({Kind::OutputOn, 7, 0});
    devices.apply({Kind::AnalogOutput, 2, 2.5});
    plan({move_to(5, 0)}, devices);
    const auto& body = outputs[0][1].track.body;
    ASSERT_EQ(body.size(), 2u);
    EXPECT_EQ(body[0], (OutputChange{{1}, SetDigital{0b1000, 0b1010}}));
    EXPECT_EQ(body[1], (OutputChange{{1}, RampAnalog{1, kFullScale / 4, 0}}));
}

TEST_F(Planned, AnOutputThatFollowsTheSpeedIsInProportionToItAtEachTickOfBodiesAndTails) {
    plan(kBurn);
    ASSERT_GT(frames.size(), 5u);
    std::size_t compared = 0;
    for (std::size_t last = 0; last + 1 < frames.size(); last += 3) {
        std::size_t k = 0;
        const auto visit = [&](const PathFrame& frame, Ticks at, const std::array<Outputs, 2>& devices) {
            const Tick now = starts[k] + at;
            const double speed = speed_at(frame, &AxisTrack::body, at);
            if (at == frame.ticks) { ++k; }
            const auto settings = settings_at(now);
            if (!settings) { return; }
            ++compared;
            const double wanted = std::min(settings->share * speed / settings->feed_mm_s, 1.0);
            ASSERT_NEAR(devices[0].analog(0, now), wanted, 0.004) << now.value << " at " << speed << " mm/s";
        };
        const auto visit_tail = [&](const PathFrame& frame, Ticks at, const std::array<Outputs, 2>& devices) {
            const double power = devices[0].analog(0, starts[last + 1] + at);
            EXPECT_LE(power, 0.9 * speed_at(frame, &AxisTrack::tail, at) / 40 + 0.004);
            if (at == total_ticks(frame.axes[0].tail)) { EXPECT_EQ(power, 0) << "at rest"; }
        };
        run(last, visit, visit_tail);
    }
    EXPECT_GT(compared, 10'000u);
}

TEST_F(Planned, AnOutputThatFollowsTheSpeedIsOffInRapidMovesAndAfterTheEnd) {
    plan(kBurn);
    const OutputTrack& last = outputs.back()[0].track;
    Outputs x;
    for (std::size_t k = 0; k < outputs.size(); ++k) {
        for (const OutputChange& change : outputs[k][0].track.body) { x.change(change, starts[k]); }
    }
    EXPECT_TRUE(last.tail.empty()) << "the path ends at rest";
    EXPECT_EQ(x.analog(0, starts.back()), 0);
    EXPECT_EQ(x.ramps[0].slope, 0);
}

/// Events at each of many short moves.
std::vector<Block> raster(int pixels, double pitch_mm, double feed_mm_s) {
    std::vector<Block> blocks{word(Kind::SpindleForward, 0, 0)};
    for (int k = 1; k <= pixels; ++k) {
        blocks.push_back(word(Kind::SpindleSpeed, 0, k % 7 * 100));
        blocks.push_back(move_to(pitch_mm * k, 0, feed_mm_s));
    }
    return blocks;
}

TEST_F(Planned, EventsFasterThanTheRingOfADeviceSlowThePathDown) {
    plan(raster(3000, 0.01, 100));
    const OutputRoom room = output_room(machine.timing);
    std::size_t changes = 0;
    for (const auto& of : outputs) {
        EXPECT_LE(of[0].track.body.size(), room.body);
        EXPECT_LE(of[0].track.tail.size(), room.tail);
        changes += of[0].track.body.size();
    }
    EXPECT_GE(changes, 3000u) << "no pixel is left out";
    EXPECT_GT(seconds(), 1.0) << "at the feed, it would take 0.3 s";
}

/// Both analog outputs and a digital one of one device.
class PlannedForOneDevice : public Planned {
protected:
    PlannedForOneDevice() : Planned(with_all_on_x()) {}
    static MachineConfig with_all_on_x() {
        MachineConfig machine = laser_machine();
        for (OutputConfig& output : machine.outputs) { output.motor = "X"; }
        return machine;
    }
};

TEST_F(PlannedForOneDevice, EventsOfSeveralOutputsFitAndAreExactWhileOneFollowsTheSpeed) {
    std::vector<Block> blocks{word(Kind::SpindleReverse, 0, 0)};
    for (int k = 1; k <= 1500; ++k) {
        blocks.push_back(word(Kind::SpindleSpeed, 0, k % 7 * 100));
        blocks.push_back(word(Kind::AnalogOutput, 2, k % 3));
        blocks.push_back(word(k % 2 == 0 ? Kind::OutputOn : Kind::OutputOff, 7));
        blocks.push_back(move_to(0.02 * k, k / 500));
    }
    plan(blocks);
    const OutputRoom room = output_room(machine.timing);
    Outputs x;
    ProgramDevices devices;
    std::size_t next = 0;
    for (std::size_t k = 0; k < outputs.size(); ++k) {
        const OutputTrack& track = outputs[k][0].track;
        ASSERT_LE(track.body.size(), room.body);
        ASSERT_LE(track.tail.size(), room.tail);
        for (std::size_t c = 0; c < track.body.size(); ++c) {
            x.change(track.body[c], starts[k]);
            const Tick now = starts[k] + track.body[c].at;
            const bool is_last_of_tick = c + 1 == track.body.size() || track.body[c + 1].at != track.body[c].at;
            if (!is_last_of_tick) { continue; }
            for (; next < events.size() && events[next].tick <= now; ++next) {
                devices.apply(events[next].event.event);
            }
            ASSERT_EQ(x.digital >> 3 & 1, devices.output_is_on(7)) << now.value;
            ASSERT_NEAR(x.analog(1, now), devices.analog_output(2) / 10, 0x1p-20) << now.value;
        }
    }
    EXPECT_EQ(next, events.size());
    EXPECT_EQ(events.size(), 4501u);
}

TEST_F(Planned, PixelsThatARingCanTakeKeepTheirFeed) {
    plan(raster(1000, 0.1, 100));
    EXPECT_LT(seconds(), 1.2);
}

TEST_F(Planned, AnAxisThatRestsDoesNotSlowThePixelsOfAnother) {
    machine.axes[1].max_decel_mm_s2 = machine.axes[1].max_accel_mm_s2 = 10;
    plan(raster(1000, 0.1, 100));
    EXPECT_LT(seconds(), 1.2);
}

TEST_F(Planned, AWordBeforeAWholeCircleDoesNotSlowIt) {
    ProgramMove circle{.target_mm = {40, 30}, .feed_mm_s = 50, .arc = ArcShape{.first = 0, .second = 1}};
    circle.arc->centre_first_mm = 40;
    circle.arc->centre_second_mm = 20;
    plan({move_to(40, 30), word(Kind::OutputOn, 7), {{}, circle}, word(Kind::OutputOff, 7)});
    EXPECT_LT(seconds(), 50 / kFeed_mm_s + 20 * 3.15 / 50 + 1);
}

TEST_F(Planned, WordsBetweenTheShortestRestsFit) {
    std::vector<Block> blocks{move_to(10, 10)};
    for (int k = 0; k < 600; ++k) {
        blocks.push_back(word(k % 2 == 0 ? Kind::OutputOn : Kind::OutputOff, 7));
        Block rest{{}, Dwell{1e-6}};
        if (k % 3 == 0) {
            rest = move_to(10, 10);
            std::get<ProgramMove>(rest.action).mode = PathMode::ExactStop;
        }
        blocks.push_back(rest);
    }
    plan(blocks);
    EXPECT_EQ(events.size(), 600u);
    for (const auto& of : outputs) { EXPECT_LE(of[1].track.body.size(), output_room(machine.timing).body); }
}

}  // namespace
}  // namespace lockstep
