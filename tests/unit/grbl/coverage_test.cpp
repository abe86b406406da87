// docs/grbl.md and the tables that senders load agree with the code. This command writes the tables again:
//   LOCKSTEP_WRITE_GRBL_TABLES=1 build/bin/unit_grbl --gtest_filter=GrblTables.*
#include <fmt/format.h>

#include <cstdlib>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "clients/grbl/protocol/code_table.hpp"
#include "clients/grbl/protocol/settings.hpp"
#include "services/files/text_file.hpp"
#include "tests/unit/grbl/hand_sender.hpp"

namespace lockstep::grbl {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

std::string document() { return read_text_file("docs/grbl.md").value(); }

/// The first and second column of the table that has this title in its first column.
std::map<std::string, std::string> rows_of(const std::string& title) {
    std::map<std::string, std::string> rows;
    std::istringstream text(document());
    bool is_in = false;
    for (std::string line; std::getline(text, line);) {
        if (line.starts_with("| " + title + " |")) { is_in = true; }
        if (!line.starts_with("|")) { is_in = false; }
        const std::size_t middle = line.find(" | ", 2);
        if (is_in && !line.starts_with("|---")) { rows[line.substr(2, middle - 2)] = line.substr(middle + 3); }
    }
    return rows;
}

/// The numbers behind a prefix. Two numbers joined by "to" stand for all between them too.
std::set<int> numbers_in(const std::string& text, const std::string& prefix, int base) {
    std::set<int> numbers;
    const std::regex range(prefix + R"(([0-9A-F]+)`?(?: to `?)" + prefix + R"(([0-9A-F]+))?)");
    for (std::sregex_iterator at(text.begin(), text.end(), range), end; at != end; ++at) {
        const int first = std::stoi((*at)[1], nullptr, base);
        const int last = (*at)[2].matched ? std::stoi((*at)[2], nullptr, base) : first;
        for (int n = first; n <= last; ++n) { numbers.insert(n); }
    }
    return numbers;
}

std::string code_rows(const std::string& what, std::span<const Code> codes) {
    std::string text = "| " + what + " | name | meaning | here |\n|---|---|---|---|\n";
    for (const Code& code : codes) {
        text += "| " + std::to_string(code.number) + " | " + std::string(code.name) + " | " + std::string(code.text) +
                " | " + (code.why_never.empty() ? "sent" : "never: " + std::string(code.why_never)) + " |\n";
    }
    return text;
}

/// The table as senders expect it.
std::string csv(std::string_view what, std::span<const Code> codes) {
    std::string text = fmt::format("\"{0} Code in v1.1+\",\"{0} Message in v1.0-\",\"{0} Description\"\n", what);
    for (const Code& code : codes) { text += fmt::format("\"{}\",\"{}\",\"{}\"\n", code.number, code.name, code.text); }
    return text;
}

bool is_to_write() { return std::getenv("LOCKSTEP_WRITE_GRBL_TABLES") != nullptr; }

void expect_file(const std::string& file, const std::string& text) {
    if (is_to_write()) { ASSERT_TRUE(write_text_file(file, text)); }
    EXPECT_EQ(read_text_file(file), text) << file;
}

TEST(GrblTables, AreThoseOfTheCode) {
    expect_file("deploy/grbl/error_codes_en_US.csv", csv("Error", error_codes()));
    expect_file("deploy/grbl/alarm_codes_en_US.csv", csv("Alarm", alarm_codes()));
}

TEST(GrblTables, AreInTheDocument) {
    const std::string text = document();
    const std::string tables = code_rows("error", error_codes()) + "\n" + code_rows("alarm", alarm_codes());
    const std::size_t at = text.find("| error | name |");
    if (is_to_write() && at != text.npos) { ASSERT_TRUE(write_text_file("docs/grbl.md", text.substr(0, at) + tables)); }
    EXPECT_THAT(document(), HasSubstr(tables));
}

TEST(GrblTables, NameEveryNumberThatIsSent) {
    std::set<int> sent;
    for (const Error error : kAllErrors) { sent.insert(static_cast<int>(error)); }
    for (const Code& code : error_codes()) { EXPECT_EQ(code.why_never.empty(), sent.contains(code.number)); }
    std::set<int> alarms{kTravelAlarm, kAbortAlarm, kTouchedEarlyAlarm, kNotTouchedAlarm};
    for (int fault = 0; fault < 1000; ++fault) { alarms.insert(alarm_of(static_cast<FaultCode>(fault))); }
    for (const Code& code : alarm_codes()) { EXPECT_EQ(code.why_never.empty(), alarms.contains(code.number)); }
    EXPECT_EQ(find_code(error_codes(), 20)->name, "Unsupported command");
    EXPECT_EQ(find_code(error_codes(), 99), nullptr);
}

TEST(GrblCoverage, HasEverySettingAndWhetherItIsFixed) {
    MachineSetup machine = mill();
    machine.axes.resize(6, machine.axes[0]);
    const auto rows = rows_of("setting");
    std::set<int> documented;
    for (const Setting& setting : settings_of(machine, {})) {
        for (const auto& [first, second] : rows) {
            if (!numbers_in(first, "\\$", 10).contains(setting.number)) { continue; }
            documented.insert(setting.number);
            const bool is_fixed = second.starts_with("fixed") || second.starts_with("always");
            EXPECT_EQ(is_fixed, !setting.why_fixed.empty()) << setting.number;
        }
        EXPECT_TRUE(documented.contains(setting.number)) << setting.number;
    }
    std::set<int> all;
    for (const auto& [first, second] : rows) { all.merge(numbers_in(first, "\\$", 10)); }
    EXPECT_EQ(all, documented) << "no other is in the document";
}

TEST_F(Sender, DoesWhatTheDocumentSaysOfEveryByte) {
    std::set<int> done;
    for (const auto& [first, second] : rows_of("bytes")) {
        if (!second.starts_with("ignored")) { done.merge(numbers_in(first, "0x", 16)); }
    }
    EXPECT_EQ(done.size(), 11) << "0x18, 0x84, 0x85, 0x90 to 0x97";
    for (int byte = 0x80; byte <= 0xFF; ++byte) {
        change(MachinePhase::Running);
        (void)send(std::string(1, static_cast<char>(byte)));
        const bool is_of_jogs = byte == 0x85;
        if (is_of_jogs) { continue; }
        EXPECT_EQ(!asked().empty(), done.contains(byte)) << byte;
    }
}

TEST_F(Sender, HasEveryCommandOfItsHelpInTheDocument) {
    std::string documented;
    for (const auto& [first, second] : rows_of("line")) { documented += first + " "; }
    std::istringstream words(send("$\n")[0].substr(5));
    for (std::string word; words >> word && word.starts_with("$");) {
        const std::string name = word == "$x=val" ? "$n=" : word == "$Nx=line" ? "$N0=" : word.substr(0, 3);
        EXPECT_THAT(documented, HasSubstr("`" + name)) << word;
    }
}

}  // namespace
}  // namespace lockstep::grbl
