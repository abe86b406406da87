// Interpreter: subroutines, in the program itself and in files.
#include <utility>

#include "core/gcode/interpreter.hpp"
#include "core/gcode/run/steps.hpp"
#include "core/gcode/text_lines.hpp"

namespace lockstep::gcode {
namespace {

std::string shown_call(const OWord& word) { return "o<" + *word.label + "> call"; }

}  // namespace

Result Interpreter::call(Reader& reader, const OWord& word) {
    if (!word.label) { return std::unexpected(word.label.error()); }
    std::array<double, kArguments> arguments{};
    std::size_t count = 0;
    while (!reader.done() && (reader.peek() == '[' || reader.peek() == '(')) {
        if (reader.peek() == '(') {
            reader.skip_comment();
            continue;
        }
        const std::size_t place = reader.place();
        const double value = reader.expression();
        if (count == kArguments) {
            reader.fail(place, "a call has at most " + std::to_string(kArguments) + " arguments");
        }
        if (!reader.error()) { arguments[count++] = value; }
    }
    if (auto empty = rest_is_empty(reader); !empty) { return empty; }
    if (!subroutines_.contains(*word.label)) {
        if (auto found = find_subroutine(word); !found) { return found; }
    }
    if (calls_ >= setup_.limits.call_depth) {
        return error(word.place, shown_call(word) + " is nested deeper than " +
                                     std::to_string(setup_.limits.call_depth) +
                                     " calls; check that it ends before it calls itself again");
    }
    ++calls_;
    has_returned_ = false;
    returned_ = 0;
    parameters_.enter(arguments);
    levels_.push_back(
        {.body = &subroutines_.find(*word.label)->second, .next = 1, .is_call = true, .kept = {}, .repeats = {}});
    return {};
}

/// Handles return or endsub, with a value or without.
Result Interpreter::leave(Level& level, Reader& reader) {
    if (reader.peek() == '[') {
        returned_ = reader.expression();
        has_returned_ = true;
    }
    if (auto empty = rest_is_empty(reader); !empty) { return empty; }
    level.next = level.body->lines.size();
    return {};
}

void Interpreter::end_call() {
    if (levels_.back().is_call) {
        const KeptModes kept = levels_.back().kept;
        if (kept.modal && kept.restores_at_return) {
            Context here = context();
            restore(here, *kept.modal);
        }
        parameters_.leave();
        --calls_;
    }
    levels_.pop_back();
}

void Interpreter::unwind() {
    for (; !levels_.empty(); levels_.pop_back()) {
        if (!levels_.back().is_call) { continue; }
        parameters_.leave();
        --calls_;
    }
}

/// A text with subroutines: a file, or the rest of the program.
struct Interpreter::SubroutineText {
    std::string_view text;
    int first_line = 1;  // the number of its first line
    std::string only;    // the subroutine to store; empty: all
    std::string file;
};

/// Searches as LinuxCNC does: in a file of its name, otherwise behind the call.
Result Interpreter::find_subroutine(const OWord& word) {
    const auto text = setup_.find_subroutine ? setup_.find_subroutine(*word.label) : std::nullopt;
    return text ? load(word, *text) : load_later(word);
}

/// Loads a file with the subroutine's name. The file may contain other subroutines too.
Result Interpreter::load(const OWord& word, std::string_view text) {
    const std::string file = *word.label + ".ngc";
    if (const auto wrong = keep_subroutines({.text = text, .only = {}, .file = file})) {
        return error(word.place, file + ", line " + std::to_string(wrong->line) + ", column " +
                                     std::to_string(wrong->column) + ": " + wrong->message);
    }
    if (subroutines_.contains(*word.label)) { return {}; }
    return error(word.place, file + " does not contain o<" + *word.label + "> sub; name the subroutine like its file");
}

/// Finds the lines of the program that begin subroutines.
void Interpreter::find_beginnings() {
    Line line;
    for_each_line(setup_.program, [&](std::string_view text, int number) {
        if (line.read(text, number)) { return true; }
        Reader reader(line, parameters_);
        if (!skip_head(line, reader) || reader.peek() != 'O') { return true; }
        const OWord word = read_o_word(reader);
        if (word.keyword == Keyword::Sub && word.label) {
            beginnings_[*word.label].push_back({number, static_cast<std::size_t>(text.data() - setup_.program.data())});
        }
        return true;
    });
}

/// The program from the first subroutine of this label behind the present line.
Interpreter::SubroutineText Interpreter::text_behind(const std::string& label) {
    if (!std::exchange(has_beginnings_, true)) { find_beginnings(); }
    for (const Beginning& beginning : beginnings_[label]) {
        if (beginning.line <= program_line_) { continue; }
        return {
            .text = setup_.program.substr(beginning.place), .first_line = beginning.line, .only = label, .file = {}};
    }
    return {.text = {}, .only = label, .file = {}};
}

Result Interpreter::load_later(const OWord& word) {
    auto wrong = keep_subroutines(text_behind(*word.label));
    if (wrong) { return std::unexpected(*std::move(wrong)); }
    if (subroutines_.contains(*word.label)) {
        called_early_.insert(*word.label);
        return {};
    }
    return error(word.place, shown_call(word) + " calls a subroutine that does not exist; define it" +
                                 (setup_.find_subroutine ? ", or add a file " + *word.label + ".ngc" : ""));
}

/// Stores the subroutines of a text. Ignores errors outside them.
std::optional<GcodeError> Interpreter::keep_subroutines(const SubroutineText& source) {
    Recorder recorder;
    Line line;
    std::optional<GcodeError> wrong;
    for_each_line(source.text, [&](std::string_view text, int number) {
        wrong = line.read(text, number + source.first_line - 1);
        Reader reader(line, parameters_);
        OWord word;
        if (!wrong && skip_head(line, reader) && reader.peek() == 'O') { word = read_o_word(reader); }
        if (!wrong) { wrong = reader.error(); }
        const bool begins =
            word.keyword == Keyword::Sub && word.label && (source.only.empty() || *word.label == source.only);
        if (!recorder.active() && (wrong || !begins)) {
            wrong.reset();
            return true;
        }
        if (!wrong && ++kept_lines_ > setup_.limits.kept_lines) {
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
