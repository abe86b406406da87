// machine.proto states the ranges and defaults of the code. docs/configuration.md is made from the same comments.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <optional>
#include <regex>
#include <sstream>

#include "services/documents/machine_file.hpp"
#include "tests/unit/documents/machine_text_examples.hpp"

namespace lockstep {
namespace {

struct Key {
    std::string block;  // the message
    std::string type;
    std::string name;
    std::string comment;
};

/// The scalar keys of machine.proto with the comment above each.
std::vector<Key> keys() {
    std::ifstream file(LOCKSTEP_MACHINE_PROTO);
    std::vector<Key> found;
    std::string block;
    std::string comment;
    static const std::regex kBlock(R"(message (\w+) \{)");
    static const std::regex kKey(R"(\s*optional (\w+) (\w+) = \d+;)");
    std::smatch match;
    for (std::string line; std::getline(file, line);) {
        const std::size_t text = line.find("// ");
        if (std::regex_match(line, match, kBlock)) {
            block = match[1];
        } else if (std::regex_match(line, match, kKey)) {
            found.push_back({block, match[1], match[2], comment});
        }
        comment = text == std::string::npos ? "" : comment + line.substr(text + 3) + " ";
    }
    return found;
}

/// What a workpiece needs.
const std::string kWithWorkpiece = [] {
    std::string text;
    for (const char* name : {"Y", "Z"}) {
        text += std::regex_replace(std::string(kShortest), std::regex("name: \"m\"\n|\\n"), " ");
        text = std::regex_replace(text, std::regex("\"X\""), '"' + std::string(name) + '"');
    }
    return text + R"(input { name: "tip" motor: "X" channel: 3 use: PROBE } )";
}();

/// The shortest machine with this key set; nullopt if the block is not in the table.
std::optional<std::string> machine_with_key(const Key& key, const std::string& value) {
    static const std::map<std::string, std::pair<std::string, std::string>> kAround{
        {"Machine", {"", ""}},
        {"Timing", {"timing { ", " }"}},
        {"Network", {"network { ", " }"}},
        {"Record", {"record { ", " }"}},
        {"Flight", {"record { flight { ", " } }"}},
        {"RealTime", {"real_time { ", " }"}},
        {"Unassigned", {"unassigned { ", " }"}},
        {"Web", {"web { ", " }"}},
        {"Homing", {"homing { ", " }"}},
        {"Plant", {"plant { ", " }"}},
        {"Pins", {"pins { ", " }"}},
        {"Backlash", {"homing { pulloff_mm:20 } backlash { mm: 0.1 ", " }"}},
        {"Input", {"input { name: \"s\" motor: \"X\" channel: 3 use: PROBE number: 1 ", " }"}},
        {"Output", {"output { name: \"o\" motor: \"X\" channel: 0 number: 0 ", " }"}},
        {"Pwm", {"output { name: \"o\" motor: \"X\" use: SPINDLE pwm { hz: 100 ", " } }"}},
        {"Workpiece", {kWithWorkpiece + "workpiece { ", " }"}},
        {"WorkBlock",
         {kWithWorkpiece + "workpiece { block { x_min_mm: 0 x_max_mm: 1 y_min_mm: 0 y_max_mm: 1 top_mm: 0 ", " } }"}},
        {"WorkPost", {kWithWorkpiece + "workpiece { post { x_mm: 0 y_mm: 0 diameter_mm: 1 top_mm: 0 ", " } }"}},
        {"Axis", {"", ""}}};
    const auto around = kAround.find(key.block);
    if (around == kAround.end()) { return std::nullopt; }
    const std::string before = std::regex_replace(around->second.first, std::regex(key.name + R"(: \S+ )"), "");
    const std::string line = before + key.name + ": " + value + around->second.second;
    const bool in_axis = key.block == "Axis" || key.block == "Homing" || key.block == "Plant" || key.block == "Pins" ||
                         key.block == "Backlash";
    const std::string given = std::regex_replace(std::string(kShortest), std::regex("  " + key.name + ": .*"), "");
    return in_axis ? with("\n}", "\n  " + line + "\n}", given) : given + line + "\n";
}

/// Whether the file is refused for this key's value.
bool is_refused(const Key& key, const std::string& value) {
    const auto machine = parse_machine(machine_with_key(key, value).value());
    if (machine) { return false; }
    const std::string text = to_text("machine", machine.error());
    return text.contains(key.name + " is ") || text.contains("Expected integer");
}

bool is_whole(const Key& key) { return key.type != "double"; }

std::string number(const Key& key, double value) {
    std::ostringstream text;
    text.precision(12);
    text << value;
    return is_whole(key) ? std::to_string(std::llround(value)) : text.str();
}

TEST(MachineReference, EveryRangeStatedIsTheOneChecked) {
    static const std::regex kRange(R"((-?\d[\d.]*) to (-?\d+(?:\.\d+)?))");
    int checked = 0;
    for (const Key& key : keys()) {
        std::smatch range;
        if (key.type == "string" || !std::regex_search(key.comment, range, kRange)) { continue; }
        ASSERT_TRUE(machine_with_key(key, "1")) << key.block << " is not in this test's table";
        const double least = std::stod(range[1]);
        const double most = std::stod(range[2]);
        EXPECT_FALSE(is_refused(key, number(key, least))) << key.name << " at its least, " << range[0];
        EXPECT_FALSE(is_refused(key, number(key, most))) << key.name << " at its most, " << range[0];
        EXPECT_TRUE(
            is_refused(key, number(key, is_whole(key) || least == 0 ? least - 1 : least - std::abs(least) * 0.01)))
            << key.name << " below " << range[0];
        EXPECT_TRUE(is_refused(key, number(key, is_whole(key) ? most + 1 : most * 1.01)))
            << key.name << " above " << range[0];
        ++checked;
    }
    EXPECT_GE(checked, 10);
}

TEST(MachineReference, EveryGreatestValueStatedIsTheOneChecked) {
    static const std::regex kMost(R"(at most (\d+))");
    int checked = 0;
    for (const Key& key : keys()) {
        std::smatch most;
        if (key.type == "string" || !std::regex_search(key.comment, most, kMost)) { continue; }
        ASSERT_TRUE(machine_with_key(key, "1")) << key.block << " is not in this test's table";
        const auto value = std::stoll(most[1]);
        const auto beyond = parse_machine(machine_with_key(key, std::to_string(value + 1)).value());
        ASSERT_FALSE(beyond) << key.name << " above " << most[0];
        EXPECT_TRUE(to_text("machine", beyond.error()).contains(" to " + std::to_string(value))) << key.name;
        ++checked;
    }
    EXPECT_GE(checked, 3);
}

TEST(MachineReference, EveryDefaultStatedIsTheOneTaken) {
    static const std::regex kDefault(R"([Dd]efault (true|false|-?\d+(?:\.\d+)?|[A-Z]{3,})(?=[.,;]? |[.,;]?$))");
    int checked = 0;
    for (const Key& key : keys()) {
        std::smatch stated;
        if (!std::regex_search(key.comment, stated, kDefault) || stated.suffix().str().starts_with(" times")) {
            continue;
        }
        const auto text = machine_with_key(key, stated[1]);
        ASSERT_TRUE(text) << key.block << " is not in this test's table";
        const auto given = parse_machine(*text);
        ASSERT_TRUE(given) << to_text("machine", given.error());
        std::string without = std::string(kShortest) + (key.block == "Web" ? "web { }\n" : "");
        if (key.block == "Input" || key.block == "Output" || key.block == "Pwm" || key.block.starts_with("Work")) {
            without = std::regex_replace(*text, std::regex(key.name + ": " + stated[1].str() + " \\}"), "}");
        }
        EXPECT_EQ(machine_text(*given), machine_text(parse_machine(without).value())) << key.name << " " << stated[0];
        ++checked;
    }
    EXPECT_GE(checked, 18);
}

}  // namespace
}  // namespace lockstep
