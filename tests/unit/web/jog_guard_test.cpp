// The dead-man switch of jogs.
#include "clients/web/machine/jog_guard.hpp"

#include <gtest/gtest.h>

#include "clients/web/state/limits.hpp"

namespace lockstep::web {
namespace {

using namespace std::chrono_literals;
using Press = JogGuard::Press;

JogOrder press(const std::string& stream, std::uint64_t number) {
    return {.jogs = {{.axis = AxisIndex{0}, .speed_mm_s = 5}}, .stream = stream, .press = number};
}

JogOrder release(const std::string& stream, std::uint64_t number) {
    return {.jogs = {}, .stream = stream, .press = number};
}

std::string refusal(const std::expected<Press, Problem>& taken) { return taken ? "" : taken.error().code; }

TEST(JogGuard, AJogLastsAsLongAsItIsRenewed) {
    JogGuard guard;
    EXPECT_EQ(guard.take(press("a", 1), 0ms), Press::New);
    EXPECT_EQ(guard.take(press("a", 1), 100ms), Press::Renewed);
    EXPECT_FALSE(guard.runs_out(100ms + kJogLife - 1ns));
    EXPECT_TRUE(guard.runs_out(100ms + kJogLife));
    EXPECT_FALSE(guard.runs_out(1s)) << "once";
    EXPECT_FALSE(guard.is_pressed());
}

TEST(JogGuard, ALateRenewalStartsNothing) {
    JogGuard guard;
    (void)guard.take(press("a", 3), 0ms);
    (void)guard.runs_out(1s);
    EXPECT_EQ(refusal(guard.take(press("a", 3), 1s)), "jog-over");
    EXPECT_EQ(refusal(guard.take(press("a", 2), 1s)), "jog-over");
    EXPECT_EQ(guard.take(press("a", 4), 1s), Press::New);
}

TEST(JogGuard, ANewPressOfTheSameKeyIsNoRenewal) {
    JogGuard guard;
    (void)guard.take(press("a", 1), 0ms);
    EXPECT_EQ(guard.take(press("a", 2), 50ms), Press::New) << "the machine may have ended the press before by itself";
}

TEST(JogGuard, AReleaseEndsThePressAlsoWhenItComesFirst) {
    JogGuard guard;
    EXPECT_EQ(guard.take(release("a", 5), 0ms), Press::Released);
    EXPECT_EQ(refusal(guard.take(press("a", 5), 1ms)), "jog-over");
}

TEST(JogGuard, OneClientJogsAtATime) {
    JogGuard guard;
    (void)guard.take(press("a", 1), 0ms);
    EXPECT_EQ(refusal(guard.take(press("b", 1), 1ms)), "busy");
    EXPECT_EQ(guard.take(release("b", 1), 2ms), Press::Released);
    EXPECT_TRUE(guard.is_pressed()) << "another's release changes nothing";
    (void)guard.take(release("a", 1), 3ms);
    EXPECT_EQ(guard.take(press("b", 2), 4ms), Press::New);
}

TEST(JogGuard, AJogEndsWithItsEventStream) {
    JogGuard guard;
    (void)guard.take(press("a", 1), 0ms);
    EXPECT_FALSE(guard.end_stream("b"));
    EXPECT_FALSE(guard.end_stream(""));
    EXPECT_TRUE(guard.end_stream("a"));
    EXPECT_EQ(refusal(guard.take(press("a", 1), 1ms)), "jog-over");
}

TEST(JogGuard, ForgetsTheOldestClientsFirst) {
    JogGuard guard;
    for (int i = 0; i < 300; ++i) {
        (void)guard.take(press(std::to_string(i), 1), 0ms);
        guard.end();
    }
    EXPECT_EQ(refusal(guard.take(press("299", 1), 1ms)), "jog-over");
    EXPECT_EQ(guard.take(press("0", 1), 1ms), Press::New) << "bounded memory";
}

TEST(JogGuard, AStepGoesOnWithoutRenewalsAndWithoutItsStream) {
    JogGuard guard;
    JogOrder step = press("a", 1);
    step.is_step = true;
    EXPECT_EQ(guard.take(step, 0ms), Press::New);
    EXPECT_FALSE(guard.runs_out(1h));
    EXPECT_FALSE(guard.end_stream("a"));
    EXPECT_EQ(guard.take(step, 1h), Press::Renewed) << "asks whether it is complete";
    EXPECT_EQ(refusal(guard.take(press("a", 2), 1h)), "busy") << "another press would change its target";
    guard.complete(1h);
    EXPECT_EQ(guard.take(step, 1h + 10ms), Press::Renewed);
    EXPECT_EQ(guard.take(press("a", 2), 1h + 20ms), Press::New);
    EXPECT_TRUE(guard.runs_out(1h + 20ms + kJogLife)) << "the next one is no step";
}

TEST(JogGuard, AReleaseEndsAStepToo) {
    JogGuard guard;
    JogOrder step = press("a", 1);
    step.is_step = true;
    (void)guard.take(step, 0ms);
    EXPECT_EQ(guard.take(release("a", 1), 1ms), Press::Released);
    EXPECT_FALSE(guard.is_pressed());
    EXPECT_FALSE(guard.is_step());
}

}  // namespace
}  // namespace lockstep::web
