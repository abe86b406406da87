// Prints what verify, analyze, merge and replay say about every kind of record and every alteration, as Markdown, or
// with --show what they say about one kind of record, in full.
//
// A verdict that is not the expected one is followed by the expected one. Verdicts that the tests have kept
// (LOCKSTEP_VERDICTS) are not computed again.
#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <string_view>

#include "tests/records/alterations/alterations.hpp"
#include "tests/records/kept_verdicts.hpp"
#include "tests/records/kinds/kinds.hpp"

namespace lockstep::records {
namespace {

constexpr Tool kColumns[]{Tool::Verify, Tool::Analyze, Tool::Merge, Tool::Replay};

void print_head(std::string_view title, std::string_view first) {
    fmt::print("\n## {}\n\n| {} |", title, first);
    for (const Tool tool : kColumns) { fmt::print(" {} |", name_of(tool)); }
    fmt::print("\n|---|---|---|---|---|\n");
}

/// `said`: all verdicts of one tool, of one or several records.
std::string cell(Tool tool, Verdicts said, Verdicts expected) {
    const bool is_expected = (said & ~expected) == 0;
    return words_of(tool, said) + (is_expected ? "" : fmt::format(" (**must be {}**)", words_of(tool, expected)));
}

void print_row(std::string name, const std::vector<ToolVerdicts>& judged, const Expected& expected) {
    std::ranges::replace(name, '_', ' ');
    fmt::print("| {} |", name);
    for (const Tool tool : kColumns) {
        Verdicts said = 0;
        for (const ToolVerdicts& verdicts : judged) { said |= verdicts[static_cast<std::size_t>(tool)]; }
        fmt::print(" {} |", cell(tool, said, expected.of(tool)));
    }
    fmt::print("\n");
}

void print_kinds() {
    print_head("Valid records", "record");
    for (const RecordKind& kind : record_kinds()) {
        print_row(kind.name, {verdicts_about("valid " + kind.name, [&] { return judge(kind.make()); })}, kind.expected);
    }
}

/// The tests require that the record has a place for its alteration.
Judgement judge_altered(const AlteredBase& altered) {
    Record record = record_of(altered.base);
    altered.alteration.alter(record);
    return judge(record);
}

void print_alterations() {
    std::map<std::string, std::vector<ToolVerdicts>> judged;
    for (const AlteredBase& altered : altered_bases()) {
        judged[altered.alteration.name].push_back(
            verdicts_about(altered.name(), [&] { return judge_altered(altered); }));
    }
    print_head("Altered records", "alteration");
    for (const Alteration& alteration : alterations()) {
        print_row(alteration.name, judged[alteration.name], alteration.expected);
    }
}

void print_files() {
    print_head("Damaged files", "damage");
    for (const FileAlteration& damage : file_alterations()) {
        const auto verdicts = verdicts_about("damaged " + damage.name, [&] { return judge_damaged(damage); });
        print_row(damage.name, {verdicts}, damage.expected);
    }
}

/// Prints the full text of each tool about one kind of record.
int show(std::string_view name) {
    for (const RecordKind& kind : record_kinds()) {
        if (kind.name != name) { continue; }
        const Judgement judgement = judge(kind.make());
        for (const Tool tool : kColumns) { fmt::print("== {}\n{}\n", name_of(tool), judgement.text_of(tool)); }
        return 0;
    }
    fmt::print("no kind of record is named {}\n", name);
    return 2;
}

}  // namespace
}  // namespace lockstep::records

int main(int count, char** arguments) {
    if (count == 3 && std::string_view(arguments[1]) == "--show") { return lockstep::records::show(arguments[2]); }
    if (count != 2 || std::string_view(arguments[1]) != "--print") {
        fmt::print("usage: records_table --print | --show KIND\n");
        return 2;
    }
    fmt::print(
        "# What the tools say about a log\n\nWritten by `records_table --print` from the records that tests/records "
        "makes, and checked by its tests.\n");
    lockstep::records::print_kinds();
    lockstep::records::print_alterations();
    lockstep::records::print_files();
    return 0;
}
