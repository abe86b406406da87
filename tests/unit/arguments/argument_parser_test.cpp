#include "services/arguments/argument_parser.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <gmock/gmock.h>

namespace lockstep {
namespace {

using ::testing::ContainsRegex;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr int kNothingRan = 0;

struct Ended {
    int code = 0;
    std::string error;
};

/// A program with verbs of each kind, as the command has them.
class ArgumentParserTest : public ::testing::Test {
protected:
    ArgumentParserTest() {
        parser_.version("mill 1.2");
        const Verb move = parser_.under("Verbs of motion").add_verb("move", "moves\nAlong a line.");
        move.add_option("targets", targets_, "where to").required();
        move.add_option("--feed", feed_, "how fast").in_range(1.0, 100.0);
        const Argument slow = move.add_flag("--slow", slow_, "slowly");
        move.add_option("--mode", mode_, "how").one_of({"exact", "smooth"}).needs(slow).with_default();
        move.action([this] { return ran_ = 11; });
        const Verb tools = parser_.add_verb("tools", "shows tools");
        tools.action([this] { return ran_ = 12; });
        tools.add_verb("set", "changes a tool").action([this] { return ran_ = 13; });
        const Verb keys = parser_.add_verb("keys", "keys");
        keys.add_verb("make", "makes keys").action([this] { return ran_ = 14; });
        const Verb place = parser_.add_verb("serve", "serves").add_choice("where", "where to listen");
        place.add_option("--port", port_, "a TCP port");
        place.add_option("--file", file_, "a socket");
    }

    Ended end_of(std::vector<const char*> words) {
        words.insert(words.begin(), "/usr/bin/mill");
        std::string message;
        const int code = parser_.run(static_cast<int>(words.size()), words.data(), [&](const std::string& error) {
            message = error;
            return ArgumentParser::kWrongUsage;
        });
        return {code, message};
    }
    /// The error of a wrong command line. Nothing may run.
    std::string error_of(const std::vector<const char*>& words) {
        const Ended ended = end_of(words);
        EXPECT_EQ(ended.code, ArgumentParser::kWrongUsage);
        EXPECT_EQ(ran_, kNothingRan);
        return ended.error;
    }
    std::string printed_by(const std::vector<const char*>& words) {
        ::testing::internal::CaptureStdout();
        const Ended ended = end_of(words);
        EXPECT_EQ(ended.code, 0) << ended.error;
        EXPECT_EQ(ran_, kNothingRan);
        return ::testing::internal::GetCapturedStdout();
    }

    ArgumentParser parser_{"Runs a mill.", "mill"};
    std::vector<std::string> targets_;
    std::optional<double> feed_;
    bool slow_ = false;
    std::string mode_ = "exact";
    std::uint16_t port_ = 0;
    std::string file_;
    int ran_ = kNothingRan;
};

TEST_F(ArgumentParserTest, RunsTheActionOfTheLastVerb) {
    EXPECT_EQ(end_of({"move", "X=1", "Y=2", "--feed", "2.5", "--slow", "--mode", "smooth"}).code, 11);
    EXPECT_THAT(targets_, ElementsAre("X=1", "Y=2"));
    EXPECT_EQ(feed_, 2.5);
    EXPECT_TRUE(slow_);
    EXPECT_EQ(mode_, "smooth");
    EXPECT_EQ(end_of({"tools"}).code, 12);
    EXPECT_EQ(end_of({"tools", "set"}).code, 13);
    EXPECT_EQ(end_of({"keys", "make"}).code, 14);
}

TEST_F(ArgumentParserTest, RefusesAWrongCommandLineAndNamesTheHelpToRead) {
    EXPECT_THAT(error_of({"move"}), StartsWith("targets is required; see: mill move --help"));
    EXPECT_THAT(error_of({"move", "X=1", "--feed", "200"}), HasSubstr("see: mill move --help"));
    EXPECT_THAT(error_of({"move", "X=1", "--slow", "--mode", "fast"}), HasSubstr("fast not in {exact,smooth}; see: "));
    EXPECT_THAT(error_of({"move", "X=1", "--mode", "exact"}), HasSubstr("--mode requires --slow"));
    EXPECT_EQ(error_of({"mvoe", "X=1"}), "there is no verb 'mvoe'; see: mill --help");
    EXPECT_THAT(error_of({"--fast"}), HasSubstr("see: mill --help"));
}

TEST_F(ArgumentParserTest, PrintsAnErrorToStandardErrorUnlessTheProgramReportsIt) {
    const std::vector<const char*> words{"mill", "mvoe"};
    ::testing::internal::CaptureStderr();
    EXPECT_EQ(parser_.run(static_cast<int>(words.size()), words.data()), ArgumentParser::kWrongUsage);
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "there is no verb 'mvoe'; see: mill --help\n");
    EXPECT_EQ(ran_, kNothingRan);
}

TEST_F(ArgumentParserTest, RequiresAVerbWhereThereIsNoAction) {
    EXPECT_THAT(error_of({}), HasSubstr("see: mill --help"));
    EXPECT_THAT(error_of({"keys"}), HasSubstr("see: mill keys --help"));
    EXPECT_THAT(error_of({"tools", "make"}), HasSubstr("see: mill tools --help"));
    EXPECT_THAT(error_of({"tools", "keys", "make"}), HasSubstr("see: mill tools --help"));
}

TEST_F(ArgumentParserTest, RequiresExactlyOneOptionOfAChoice) {
    EXPECT_THAT(error_of({"serve"}), HasSubstr("see: mill serve --help"));
    EXPECT_THAT(error_of({"serve", "--port", "1", "--file", "x"}), HasSubstr("see: mill serve --help"));
}

TEST_F(ArgumentParserTest, PrintsHelpAndVersion) {
    EXPECT_EQ(printed_by({"--version"}), "mill 1.2\n");
    EXPECT_THAT(printed_by({"--help"}), HasSubstr("Runs a mill."));
    EXPECT_THAT(printed_by({"move", "--help"}), HasSubstr("{exact,smooth}=exact"));
}

TEST_F(ArgumentParserTest, ListsVerbsUnderTheirHeadingsByTheFirstLineOfTheirHelp) {
    const std::string list = printed_by({"--help"});
    EXPECT_THAT(list, ContainsRegex("Verbs of motion:\n  move +moves\n"));
    EXPECT_THAT(list, ContainsRegex("Verbs:\n  tools +shows tools\n"));
    EXPECT_THAT(printed_by({"move", "--help"}), StartsWith("moves\nAlong a line.\n"));
}

}  // namespace
}  // namespace lockstep
