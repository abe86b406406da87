// Settings that a sender has written: they replace values of the machine's file, must satisfy the rules for that file,
// and can be folded into it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <fstream>
#include <string>

#include "services/documents/edit/kept_settings.hpp"
#include "services/documents/machine_file.hpp"
#include "services/files/text_file.hpp"
#include "tests/temporary_directory.hpp"

namespace lockstep {
namespace {

using testing::HasSubstr;
using testing::SizeIs;

constexpr const char* kMachine = R"(# a mill
name: "m"
axis {
  name: "X"  # the bed
  steps_per_mm: 80
  start_velocity_mm_s: 10
	max_velocity_mm_s: 150	# of its motor
  max_accel_mm_s2: 1500
  position_min_mm: 0
  position_max_mm: 200
  homing { search_velocity_mm_s: 10 latch_velocity_mm_s: 2 }
}
axis {  # without homing
  name: "Y" steps_per_mm: 80 start_velocity_mm_s: 10 max_velocity_mm_s: 150 max_accel_mm_s2: 1500
  position_min_mm: 0 position_max_mm: 100
}
)";

std::string edited(const KeptSettings& settings) {
    const auto text = with_settings(kMachine, settings);
    EXPECT_TRUE(text) << to_text("machine", text.error());
    return text.value_or("");
}

TEST(KeptSettings, AreATextOfOneLineEach) {
    const KeptSettings settings{{"X", "max_velocity_mm_s", "50"}, {"Y", "homing.toward_min", "false"}};
    EXPECT_THAT(settings_text(settings), HasSubstr("\nX.max_velocity_mm_s: 50\nY.homing.toward_min: false\n"));
    EXPECT_EQ(settings_from_text(settings_text(settings)), settings);
    EXPECT_EQ(settings_from_text("\n# none\n  \n"), KeptSettings{});
}

TEST(KeptSettings, HaveTheValuesOfTheFileWithoutLoss) {
    const auto machine = parse_machine(edited({{"X", "max_velocity_mm_s", value_text(1000.0 / 60)}}));
    ASSERT_TRUE(machine);
    EXPECT_EQ(machine->axes[0].max_velocity_mm_s, 1000.0 / 60);
    EXPECT_EQ(value_of(machine->axes[0], "max_velocity_mm_s"), value_text(1000.0 / 60));
    EXPECT_EQ(value_of(machine->axes[0], "homing.toward_min"), "true");
    EXPECT_EQ(value_of(machine->axes[0], "homing.pulloff_mm"), "2");
    EXPECT_EQ(value_of(machine->axes[0], "name"), "");
}

TEST(KeptSettings, OfAnAxisWithMotorsAreThoseOfItsMotors) {
    const auto with_motors = [](const std::string& motors) {
        std::string text = kMachine;
        return text.replace(text.find("position_min_mm: 0 position_max_mm: 100"), 0, "max_skew_mm: 3 " + motors);
    };
    const KeptSettings settings{{"Y", "steps_per_mm", "160"}};
    const auto same =
        parse_machine(with_settings(with_motors("motor { name: \"Y1\" } motor { name: \"Y2\" } "), settings).value());
    ASSERT_TRUE(same);
    EXPECT_EQ(value_of(same->axes[1], "steps_per_mm"), "160");
    EXPECT_EQ(why_without_effect(*same, settings), "");
    const auto own = parse_machine(
        with_settings(with_motors("motor { name: \"Y1\" } motor { name: \"Y2\" steps_per_mm: 100 } "), settings)
            .value());
    ASSERT_TRUE(own);
    EXPECT_EQ(why_without_effect(*own, settings),
              "motor Y2 has its own steps_per_mm, 100, in the machine's file: change it there");
}

TEST(KeptSettings, OfAnotherFormAreErrorsWithTheirLine) {
    for (const char* line : {"nonsense", "X.name: 3", "X.steps_per_mm: fast", "X.steps_per_mm: 80 81",
                             "X.homing.toward_min: 1", "X.max_velocity_mm_s: inf", ": X.", "X.steps_per_mm"}) {
        const auto read = settings_from_text("# one\nX.steps_per_mm: 80\n" + std::string(line));
        ASSERT_FALSE(read) << line;
        EXPECT_EQ(read.error().front().line, 3) << line;
    }
}

TEST(KeptSettings, ReplaceTheValueOfTheSameKey) {
    KeptSettings settings;
    set(settings, {"X", "steps_per_mm", "80"});
    set(settings, {"Y", "steps_per_mm", "81"});
    set(settings, {"X", "steps_per_mm", "82"});
    EXPECT_EQ(settings, (KeptSettings{{"X", "steps_per_mm", "82"}, {"Y", "steps_per_mm", "81"}}));
}

TEST(KeptSettings, ChangeValuesAndKeepEverythingElse) {
    std::string expected = kMachine;
    expected.replace(expected.find("150"), 3, "16.666666666666668");
    EXPECT_EQ(edited({{"X", "max_velocity_mm_s", "16.666666666666668"}}), expected);
    EXPECT_EQ(edited({}), kMachine);
}

TEST(KeptSettings, AddKeysAndBlocksThatTheFileDoesNotHave) {
    const std::string text = edited(
        {{"X", "homing.pulloff_mm", "1.5"}, {"Y", "homing.pulloff_mm", "0.5"}, {"Y", "homing.toward_min", "false"}});
    const auto machine = parse_machine(text);
    ASSERT_TRUE(machine);
    EXPECT_EQ(machine->axes[0].homing.pulloff_mm, 1.5);
    EXPECT_EQ(machine->axes[1].homing.pulloff_mm, 0.5);
    EXPECT_FALSE(machine->axes[1].homing.toward_min);
    EXPECT_THAT(text, HasSubstr("# without homing\n"));
    EXPECT_THAT(text, HasSubstr("# the bed\n"));
}

TEST(KeptSettings, MustSatisfyTheRulesOfTheMachinesFile) {
    const auto fast = with_settings(kMachine, {{"X", "max_velocity_mm_s", "1e9"}});
    ASSERT_FALSE(fast);
    EXPECT_THAT(fast.error().front().message, HasSubstr("axis X: max_velocity_mm_s is 1e+09; it must be from"));
    EXPECT_EQ(fast.error().front().line, 0);
    EXPECT_FALSE(with_settings(kMachine, {{"X", "max_velocity_mm_s", "5"}})) << "below its start velocity";
    const auto other = with_settings(kMachine, {{"Q", "max_velocity_mm_s", "50"}});
    ASSERT_FALSE(other);
    EXPECT_THAT(other.error().front().message, HasSubstr("no axis Q"));
}

TEST(KeptSettings, AreRefusedWhereACommentStandsInTheWay) {
    std::string text = kMachine;
    text.replace(text.find(": 150"), 5, ": # 5\n 150");
    const auto split = with_settings(text, {{"X", "max_velocity_mm_s", "50"}});
    ASSERT_FALSE(split);
    EXPECT_THAT(split.error().front().message, HasSubstr("a comment is between"));
}

class KeptSettingsFile : public testing::Test {
protected:
    void SetUp() override { std::ofstream(file_) << kMachine; }
    TemporaryDirectory folder_;
    std::filesystem::path file_ = folder_.path() / "m.textproto";
};

TEST_F(KeptSettingsFile, AppliesBesideTheMachinesFileUntilItIsGone) {
    EXPECT_EQ(load_machine(file_)->config.axes[0].max_velocity_mm_s, 150);
    ASSERT_TRUE(write_settings(settings_file(file_), {{"X", "max_velocity_mm_s", "50"}}));
    const auto loaded = load_machine(file_);
    ASSERT_TRUE(loaded);
    EXPECT_EQ(loaded->config.axes[0].max_velocity_mm_s, 50);
    EXPECT_THAT(settings_notice(loaded->settings), HasSubstr("X.max_velocity_mm_s: 50"));
    EXPECT_EQ(load_machine_file(file_)->axes[0].max_velocity_mm_s, 150);
    ASSERT_TRUE(write_settings(settings_file(file_), {}));
    EXPECT_FALSE(std::filesystem::exists(settings_file(file_)));
    EXPECT_THAT(load_machine(file_)->settings, SizeIs(0));
}

TEST_F(KeptSettingsFile, ThatIsWrongIsNamedInTheError) {
    std::ofstream(settings_file(file_)) << "X.steps_per_mm: 80\nnonsense\n";
    const auto wrong = load_machine(file_);
    ASSERT_FALSE(wrong);
    EXPECT_THAT(wrong.error().front().message, HasSubstr("m.textproto.settings, line 2: 'nonsense' is not a setting"));
    ASSERT_TRUE(write_settings(settings_file(file_), {{"X", "max_velocity_mm_s", "5"}}));
    const auto slow = load_machine(file_);
    ASSERT_FALSE(slow);
    EXPECT_THAT(slow.error().front().message, HasSubstr("below start_velocity_mm_s 10"));
}

TEST_F(KeptSettingsFile, ThatCannotBeWrittenStaysAsItIs) {
    const auto file = settings_file(file_);
    ASSERT_TRUE(write_settings(file, {{"X", "max_velocity_mm_s", "50"}}));
    std::signal(SIGXFSZ, SIG_IGN);  // a file of at most 8 bytes, as on a full disk
    rlimit before{};
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
    const rlimit full_disk{.rlim_cur = 8, .rlim_max = before.rlim_max};
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &full_disk), 0);
    const auto full = write_settings(file, {{"X", "max_velocity_mm_s", "60"}});
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
    ASSERT_FALSE(full);
    EXPECT_THAT(full.error(), HasSubstr("cannot be written"));
    EXPECT_EQ(read_settings(file)->front().value, "50");
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_.path()), {}), 2) << "nothing is left over";
}

}  // namespace
}  // namespace lockstep
