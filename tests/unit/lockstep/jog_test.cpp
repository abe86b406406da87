// The words and the keys of lockstep jog.
#include <gtest/gtest.h>

#include "clients/lockstep/jog/jog_keys.hpp"
#include "clients/lockstep/jog/jog_words.hpp"
#include "services/setup/machine_setup.hpp"

namespace lockstep {
namespace {

using namespace std::chrono_literals;

MachineSetup machine_to_jog() {
    MachineSetup machine{{.name = "mill"}};
    for (const char* name : {"X", "Y", "Z", "A"}) {
        machine.axes.push_back({.name = name,
                                .steps_per_mm = 100,
                                .max_velocity_mm_s = name[0] == 'Z' ? 4.0 : 50.0,
                                .position_min_mm = 0,
                                .position_max_mm = 100});
    }
    return machine;
}

TEST(JogWords, NameAxesAndDirections) {
    const auto jogs = jog_axes(machine_to_jog(), {.words = {"X+", "z-"}, .distance_mm = 3});
    ASSERT_TRUE(jogs) << jogs.error();
    EXPECT_EQ(*jogs, (std::vector<JogAxis>{{AxisIndex{0}, 10, 3}, {AxisIndex{2}, -4, 3}}));
    EXPECT_EQ(jog_axes(machine_to_jog(), {.words = {"Y-"}, .speed_mm_s = 50})->front(), (JogAxis{AxisIndex{1}, -50}));
}

TEST(JogWords, ThatMakeNoSenseAreRefusedWithTheReason) {
    const auto refusal = [](const JogOptions& options) {
        const auto jogs = jog_axes(machine_to_jog(), options);
        return jogs ? std::string("accepted") : jogs.error();
    };
    EXPECT_NE(refusal({.words = {"X"}}).find("such as X+"), std::string::npos);
    EXPECT_NE(refusal({.words = {"+"}}).find("such as X+"), std::string::npos);
    EXPECT_NE(refusal({.words = {"Q+"}}).find("Q"), std::string::npos);
    EXPECT_NE(refusal({.words = {"X+", "X-"}}).find("twice"), std::string::npos);
    EXPECT_NE(refusal({.words = {"Z+"}, .speed_mm_s = 5}).find("max_velocity_mm_s 4"), std::string::npos);
    EXPECT_NE(refusal({.words = {"X+"}, .speed_mm_s = 0}).find("from 1e-05 mm/s to"), std::string::npos);
    EXPECT_NE(refusal({.words = {"X+"}, .speed_mm_s = 1e-320}).find("from 1e-05 mm/s to"), std::string::npos);
    EXPECT_NE(refusal({.words = {"X+"}, .distance_mm = -1}).find("above 0"), std::string::npos);
}

class TypedKeys : public testing::Test {
protected:
    MachineSetup machine = machine_to_jog();
    JogKeys keys{machine};
};

TEST_F(TypedKeys, JogForAHundredAndFiftyMilliseconds) {
    keys.take("\x1b[C", 1s);
    EXPECT_EQ(keys.jogs(1s), (std::vector<JogAxis>{{AxisIndex{0}, 10}}));
    EXPECT_FALSE(keys.jogs(1s + 150ms).empty());
    EXPECT_TRUE(keys.jogs(1s + 151ms).empty());
    keys.take("\x1b[C", 1s + 140ms);
    EXPECT_FALSE(keys.jogs(1s + 280ms).empty()) << "a repetition holds it";
}

TEST_F(TypedKeys, OfSeveralAxesJogThemTogetherAndOppositeOnesReplaceEachOther) {
    keys.take("\x1b[C\x1b[Bu", 1s);
    EXPECT_EQ(keys.jogs(1s), (std::vector<JogAxis>{{AxisIndex{0}, 10}, {AxisIndex{1}, -10}, {AxisIndex{3}, 10}}));
    keys.take("\x1b[D", 1s);
    EXPECT_EQ(keys.jogs(1s).front(), (JogAxis{AxisIndex{0}, -10}));
}

TEST_F(TypedKeys, ComeInPartsAndInBothForms) {
    keys.take("\x1b", 1s);
    keys.take("[", 1s);
    EXPECT_TRUE(keys.jogs(1s).empty());
    keys.take("5~", 1s);
    EXPECT_EQ(keys.jogs(1s), (std::vector<JogAxis>{{AxisIndex{2}, 4}}));
    keys.take(" \x1bOA", 1s);
    EXPECT_EQ(keys.jogs(1s), (std::vector<JogAxis>{{AxisIndex{1}, 10}}));
}

TEST_F(TypedKeys, ChangeTheSpeedAndReleaseWhatIsHeld) {
    keys.take("\x1b[C+", 1s);
    EXPECT_TRUE(keys.jogs(1s).empty());
    EXPECT_EQ(keys.speed_mm_s(AxisIndex{0}), 20);
    EXPECT_EQ(keys.speed_mm_s(AxisIndex{2}), 4) << "what the axis can do";
    keys.take("---", 1s);
    EXPECT_EQ(keys.speed_mm_s(AxisIndex{0}), 2.5);
    keys.take("++++++++++++++++", 1s);
    EXPECT_EQ(keys.speed_mm_s(AxisIndex{0}), 50);
}

/// The screen does this when its loop comes late.
TEST_F(TypedKeys, ThatAreReleasedAtOnceDoNotJogButQuit) {
    keys.take("\x1b[Cq", 1s);
    keys.release_all();
    EXPECT_TRUE(keys.jogs(1s).empty());
    EXPECT_TRUE(keys.must_quit());
}

TEST_F(TypedKeys, OfNoMeaningDoNothing) {
    std::string all;
    for (int byte = 0; byte < 256; ++byte) {
        if (std::string("q\x03 +-juiklo").find(static_cast<char>(byte)) == std::string::npos) {
            all += static_cast<char>(byte);
        }
    }
    keys.take(all + all, 1s);
    keys.take("\x1b[999999999999999999999", 1s);
    EXPECT_TRUE(keys.jogs(1s).empty());
    EXPECT_FALSE(keys.must_quit());
    keys.take("q", 1s);
    EXPECT_TRUE(keys.must_quit());
}

TEST(JogKeys, WithADistanceEachPressIsOneStepAndWhatComesDuringAStepIsOneMore) {
    const MachineSetup machine = machine_to_jog();
    JogKeys keys(machine, 0.1);
    EXPECT_FALSE(keys.take_step());
    keys.take("\x1b[C", 1s);
    EXPECT_EQ(keys.take_step(), (JogAxis{AxisIndex{0}, 10, 0.1}));
    EXPECT_FALSE(keys.take_step()) << "once";
    for (int i = 0; i < 20; ++i) { keys.take("\x1b[D", 1s + i * 30ms); }
    EXPECT_EQ(keys.take_step(), (JogAxis{AxisIndex{0}, -10, 0.1}));
    EXPECT_FALSE(keys.take_step()) << "repetitions are not stored up";
    keys.take("\x1b[C ", 3s);
    EXPECT_FALSE(keys.take_step()) << "space drops it";
    EXPECT_TRUE(keys.take_stop());
    EXPECT_FALSE(keys.take_stop());
}

}  // namespace
}  // namespace lockstep
