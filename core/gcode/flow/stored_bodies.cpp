#include "core/gcode/flow/stored_bodies.hpp"

#include <utility>

#include "core/gcode/line_words.hpp"
#include "core/gcode/text_lines.hpp"

namespace lockstep::gcode {

/// A text with subroutines: a file, or the rest of the program.
struct StoredBodies::Text {
    std::string_view text;
    int first_line = 1;  // the number of its first line
    std::string only;    // the subroutine to store; empty: all
    std::string file;
};

std::expected<const Body*, GcodeError> StoredBodies::take(const Line& line, const OWord& word, std::string_view text) {
    if (word.keyword == Keyword::Sub && word.label && called_early_.contains(*word.label)) {
        return std::unexpected(line.error(
            word.place, "the subroutine " + *word.label +
                            " is defined after its call, in lines that the program runs; define it before the call, "
                            "or after M2"));
    }
    if (++lines_ > setup_.limits.kept_lines) {
        recorder_.clear();
        return std::unexpected(line.error(0, "loops and subroutines have more than " +
                                                 std::to_string(setup_.limits.kept_lines) +
                                                 " lines; divide the program"));
    }
    if (auto wrong = recorder_.take(line, word, text)) { return std::unexpected(*std::move(wrong)); }
    if (recorder_.active()) { return nullptr; }
    const bool is_subroutine = recorder_.is_subroutine();
    Body body = recorder_.take_body();
    if (!is_subroutine) { return &loop_.emplace(std::move(body)); }
    subroutines_.insert_or_assign(body.label, std::move(body));
    return nullptr;
}

void StoredBodies::remove_loop() {
    if (loop_) { lines_ -= loop_->lines.size(); }
    loop_.reset();
}

Result StoredBodies::finish() {
    auto wrong = recorder_.unclosed();
    if (!wrong) { return {}; }
    recorder_.clear();
    return std::unexpected(*std::move(wrong));
}

std::expected<const Body*, GcodeError> StoredBodies::find(const OWord& call, const Line& line, int program_line) {
    auto found = subroutines_.find(*call.label);
    if (found == subroutines_.end()) {
        const auto text = setup_.find_subroutine ? setup_.find_subroutine(*call.label) : std::nullopt;
        auto read = text ? read_file(call, line, *text) : read_behind(call, line, program_line);
        if (!read) { return std::unexpected(std::move(read.error())); }
        found = subroutines_.find(*call.label);
    }
    return &found->second;
}

/// Reads a file with the subroutine's name. The file may contain other subroutines too.
Result StoredBodies::read_file(const OWord& call, const Line& line, std::string_view text) {
    const std::string file = *call.label + ".ngc";
    if (const auto wrong = store_subroutines({.text = text, .only = {}, .file = file})) {
        return std::unexpected(line.error(call.place, file + ", line " + std::to_string(wrong->line) + ", column " +
                                                          std::to_string(wrong->column) + ": " + wrong->message));
    }
    if (subroutines_.contains(*call.label)) { return {}; }
    return std::unexpected(line.error(
        call.place, file + " does not contain o<" + *call.label + "> sub; name the subroutine like its file"));
}

Result StoredBodies::read_behind(const OWord& call, const Line& line, int program_line) {
    auto wrong = store_subroutines(text_behind(*call.label, program_line));
    if (wrong) { return std::unexpected(*std::move(wrong)); }
    if (subroutines_.contains(*call.label)) {
        called_early_.insert(*call.label);
        return {};
    }
    return std::unexpected(
        line.error(call.place, shown_call(call) + " calls a subroutine that does not exist; define it" +
                                   (setup_.find_subroutine ? ", or add a file " + *call.label + ".ngc" : "")));
}

/// The program from the first subroutine of this label behind the line.
StoredBodies::Text StoredBodies::text_behind(const std::string& label, int program_line) {
    if (!std::exchange(has_beginnings_, true)) { find_beginnings(); }
    for (const Beginning& beginning : beginnings_[label]) {
        if (beginning.line <= program_line) { continue; }
        return {
            .text = setup_.program.substr(beginning.place), .first_line = beginning.line, .only = label, .file = {}};
    }
    return {.text = {}, .only = label, .file = {}};
}

/// Finds the lines of the program that begin subroutines.
void StoredBodies::find_beginnings() {
    Line line;
    for_each_line(setup_.program, [&](std::string_view text, int number) {
        if (line.read(text, number)) { return true; }
        Reader reader(line, parameters_);
        if (!skip_head(line, reader, setup_.skip_deletable) || reader.peek() != 'O') { return true; }
        const OWord word = read_o_word(reader);
        if (word.keyword == Keyword::Sub && word.label) {
            beginnings_[*word.label].push_back({number, static_cast<std::size_t>(text.data() - setup_.program.data())});
        }
        return true;
    });
}

/// Stores the subroutines of a text. Ignores errors outside them.
std::optional<GcodeError> StoredBodies::store_subroutines(const Text& source) {
    Recorder recorder;
    Line line;
    std::optional<GcodeError> wrong;
    for_each_line(source.text, [&](std::string_view text, int number) {
        wrong = line.read(text, number + source.first_line - 1);
        Reader reader(line, parameters_);
        OWord word;
        if (!wrong && skip_head(line, reader, setup_.skip_deletable) && reader.peek() == 'O') {
            word = read_o_word(reader);
        }
        if (!wrong) { wrong = reader.error(); }
        const bool begins =
            word.keyword == Keyword::Sub && word.label && (source.only.empty() || *word.label == source.only);
        if (!recorder.active() && (wrong || !begins)) {
            wrong.reset();
            return true;
        }
        if (!wrong && ++lines_ > setup_.limits.kept_lines) {
            wrong = line.error(0, "the subroutines have more than " + std::to_string(setup_.limits.kept_lines) +
                                      " lines; divide the program");
        }
        if (!wrong) { wrong = recorder.take(line, word, text); }
        if (wrong) { return false; }
        if (recorder.active()) { return true; }
        Body body = recorder.take_body();
        body.file = source.file;
        subroutines_.insert_or_assign(body.label, std::move(body));
        return source.only.empty();
    });
    return wrong ? wrong : recorder.unclosed();
}

}  // namespace lockstep::gcode
