// Jogs: which client holds which axis, and the orders that the axes get meanwhile.
#include "core/coordinator/jogs/jogs.hpp"

#include "coordinator_parts.hpp"
#include "core/coordinator/jogs/path_jog.hpp"

namespace lockstep {
namespace {

class Jogged : public CoordinatorParts {
protected:
    Jogged() { receive_all(); }
    static Command pressed(std::uint64_t sequence, std::optional<double> distance_mm = {}) {
        return {.client = 1,
                .sequence = sequence,
                .kind = CommandKind::Jog,
                .jogs = {{.axis = AxisIndex{0}, .speed_mm_s = 5, .distance_mm = distance_mm}}};
    }
    void press(const Command& command, bool is_late = false) {
        CoordinatorLoop l = loop();
        l.is_late = is_late;
        ASSERT_TRUE(jogs.press(command, l));
        EXPECT_FALSE(jogs.advance(l, orders, out.axis_commands));
    }
    bool renew(const Command& command) { return jogs.renew(command, loop()); }
    void advance() {
        CoordinatorLoop l = loop();
        EXPECT_FALSE(jogs.advance(l, orders, out.axis_commands));
    }
    bool was_halted() const {
        return std::ranges::count(out.axis_commands, AxisCommandKind::Halt, &AxisCommand::kind) != 0;
    }
    Jogs jogs{machine};
};

TEST(JogTarget, IsTheDistanceOrTheEndOfTheTravel) {
    const AxisConfig axis{.name = "X", .steps_per_mm = 100, .position_min_mm = 0, .position_max_mm = 100};
    const auto target = [&](double speed_mm_s, std::optional<double> distance_mm, std::int64_t here,
                            bool homed = true) {
        return jog_target({AxisIndex{0}, speed_mm_s, distance_mm}, axis, here, homed);
    };
    EXPECT_EQ(target(10, 2.5, 700), 950);
    EXPECT_EQ(target(-10, 2.5, 100), 0);
    EXPECT_EQ(target(10, {}, 700), 10'000);
    EXPECT_EQ(target(10, 1e300, 700), 10'000);
    EXPECT_EQ(target(10, 0.001, 700), 701) << "a jog moves by a step at least";
    EXPECT_EQ(target(-10, 2.5, 100, false), -150) << "only a homed axis knows the ends of its travel";
}

TEST_F(Jogged, AnAxisIsOrderedAtOnceAndForAsLongAsAJogHolds) {
    press(pressed(1));
    ASSERT_EQ(out.axis_commands.size(), 1u);
    EXPECT_EQ(out.axis_commands[0].kind, AxisCommandKind::Jog);
    EXPECT_EQ(out.axis_commands[0].until, Tick{slot * 1000} + machine.jog_hold_ticks());
    EXPECT_EQ(out.axis_commands[0].target_steps, 10'000) << "to the end of its travel";
}

TEST_F(Jogged, PressReceivedAfterAStallMovesOnlyOnceRenewed) {
    press(pressed(1), true);
    EXPECT_TRUE(out.axis_commands.empty()) << "its client may be dead";
    ++slot;
    EXPECT_TRUE(renew(pressed(1)));
    advance();
    EXPECT_EQ(out.axis_commands.size(), 1u);
}

TEST_F(Jogged, AKeyIsRenewedOnlyByItsClientAndItsCommand) {
    press(pressed(1));
    EXPECT_TRUE(renew(pressed(1)));
    EXPECT_FALSE(renew(pressed(2)));
    Command other = pressed(1);
    other.client = 2;
    EXPECT_FALSE(renew(other));
}

/// The client presses a second key. An axis with an unchanged jog must not stop.
TEST_F(Jogged, AnAxisThatIsAskedForTheSameAgainGoesOn) {
    AxisState state = state_of(0);
    state.homed = false;  // no end of travel is known: the target is a distance from where the key was pressed
    axes.take(state, slot);
    machine.axes[0].unhomed_jog_mm_s = 5;
    press(pressed(1));
    ++slot;
    state.stamp = slot;
    state.position = Position::steps(50);
    state.at_rest = false;
    axes.take(state, slot);
    press(pressed(2));
    EXPECT_FALSE(was_halted());
    press(pressed(3, 20));
    EXPECT_TRUE(was_halted()) << "for another way it stops first";
}

TEST_F(Jogged, ASpeedOfNoneOrAboveTheAxissIsRefused) {
    const double most = machine.axes[0].max_velocity_mm_s;
    const auto answer = [&](std::uint64_t sequence, double speed_mm_s) {
        Command command = pressed(sequence);
        command.jogs[0].speed_mm_s = speed_mm_s;
        CoordinatorLoop l = loop();
        return jogs.press(command, l);
    };
    EXPECT_TRUE(answer(1, most));
    for (const double speed : {0.0, 1.001 * most, -1.001 * most}) {
        ASSERT_FALSE(answer(2, speed)) << speed;
        EXPECT_EQ(answer(2, speed).error().why, FaultCode::BadProgram);
    }
    EXPECT_TRUE(renew(pressed(1))) << "a refused command changes nothing";
}

TEST_F(Jogged, NothingIsHeldWhenAllIsReleased) {
    press(pressed(1));
    EXPECT_FALSE(jogs.none());
    jogs.release_all();
    EXPECT_TRUE(jogs.none());
    EXPECT_FALSE(renew(pressed(1)));
}

/// A jog of several axes goes on with a further line when one of them is at its end. That is no renewal.
TEST_F(Jogged, APathJogIsNotRenewedByAFurtherLine) {
    const Command held{.client = 1, .kind = CommandKind::Jog, .jogs = {{.axis = AxisIndex{0}, .speed_mm_s = 5}}};
    const Tick pressed_at{1'000'000};
    CoordinatorLoop later = loop();
    later.now = pressed_at + machine.jog_hold_ticks();
    const PathJog first(held, pressed_at, later);
    ASSERT_TRUE(first.next(later));
    const PathJog second(*first.next(later), first.renewed(), later);
    EXPECT_FALSE(second.is_released(later.now));
    later.now += Ticks{1};
    EXPECT_TRUE(second.is_released(later.now));
    EXPECT_FALSE(second.next(later));
}

}  // namespace
}  // namespace lockstep
