// No bytes make the reader of a document fail; an accepted document is valid, and a refused one has an error text.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "services/documents/machine_file.hpp"
#include "services/documents/machine_rules.hpp"
#include "services/documents/program_document.hpp"
#include "services/files/text_file.hpp"

namespace lockstep {
namespace {

const std::string& example() {
    static const std::string text =
        read_text_file(std::filesystem::path(LOCKSTEP_EXAMPLES) / "three-axis.textproto").value();
    return text;
}

void check_machine(const std::string& text) {
    const auto machine = parse_machine(text);
    if (!machine) {
        RC_ASSERT(!machine.error().empty());
        for (const Diagnostic& error : machine.error()) {
            RC_ASSERT(error.line >= 1 && error.column >= 1 && !error.message.empty());
        }
        return;
    }
    RC_ASSERT(machine_problems(*machine).empty());
    for (std::size_t axis = 0; axis < machine->axes.size(); ++axis) {
        RC_ASSERT(axis_problems(*machine, axis).empty());
    }
    RC_ASSERT(config_hash(parse_machine(machine_text(*machine)).value()) == config_hash(*machine));
}

RC_GTEST_PROP(DocumentsOfAnyBytes, AMachineIsReadOrRefused, (const std::string& text)) { check_machine(text); }

/// Overwrites, removes or inserts bytes. Digits are more frequent, so that not only the syntax but also values are
/// wrong.
RC_GTEST_PROP(DocumentsOfAnyBytes, AChangedMachineIsValidOrRefused, ()) {
    std::string text = example();
    const auto changes = *rc::gen::inRange(1, 5);
    for (int i = 0; i < changes; ++i) {
        const auto at = *rc::gen::inRange<std::size_t>(0, text.size());
        const char byte = *rc::gen::weightedOneOf<char>(
            {{5, rc::gen::elementOf(std::string("0123456789.-"))}, {1, rc::gen::arbitrary<char>()}});
        switch (*rc::gen::inRange(0, 3)) {
            case 0: text[at] = byte; break;
            case 1: text.erase(at, 1); break;
            default: text.insert(at, 1, byte); break;
        }
    }
    check_machine(text);
}

/// Replaces one number of the example by any number.
RC_GTEST_PROP(DocumentsOfAnyBytes, AMachineOfAnyNumbersIsValidOrRefused, ()) {
    std::string text = example();
    const auto keys = static_cast<std::size_t>(std::ranges::count(text, ':'));
    std::size_t at = 0;
    for (auto skip = *rc::gen::inRange<std::size_t>(0, keys); at != std::string::npos && skip > 0; --skip) {
        at = text.find(": ", at + 1);
    }
    at = std::min(at, text.size());
    const std::size_t from = text.find_first_of("0123456789", at);
    if (from == std::string::npos) { return; }
    const std::size_t end = text.find_first_not_of("0123456789.", from);
    text.replace(from, end - from, std::to_string(*rc::gen::arbitrary<double>() * *rc::gen::element(1.0, 1e-6, 1e6)));
    check_machine(text);
}

RC_GTEST_PROP(DocumentsOfAnyBytes, AProgramIsReadOrRefused, (const std::vector<std::uint8_t>& bytes)) {
    const auto program = program_from_bytes(bytes);
    if (!program) {
        RC_ASSERT(!program.error().empty());
        return;
    }
    RC_ASSERT(program_from_bytes(program_bytes(*program)).has_value());
}

}  // namespace
}  // namespace lockstep
