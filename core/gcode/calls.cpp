// Interpreter: subroutines, of the program itself and of files.
#include <utility>

#include "core/gcode/interpreter.hpp"
#include "core/gcode/run/steps.hpp"
#include "core/gcode/text_lines.hpp"

namespace lockstep::gcode {
namespace {

std::string shown_call(const std::string& label) { return "o<" + label + "> call"; }

}  // namespace

Result Interpreter::call(Reader& reader, const OWord& word) {
    std::array<double, kArguments> arguments{};
    std::size_t count = 0;
    while (reader.peek() == '[') {
        const std::size_t place = reader.place();
        const double value = reader.expression();
        if (count == kArguments) {
            reader.fail(place, "a call has at most " + std::to_string(kArguments) + " arguments");
        }
        if (!reader.error()) { arguments[count++] = value; }
    }
    if (auto empty = rest_is_empty(reader); !empty) { return empty; }
    if (!subroutines_.contains(word.label)) {
        if (auto loaded = load(word); !loaded) { return loaded; }
    }
    if (calls_ >= setup_.limits.call_depth) {
        return error(word.place, shown_call(word.label) + " is nested deeper than " +
                                     std::to_string(setup_.limits.call_depth) + " calls, the limit call_depth");
    }
    ++calls_;
    has_returned_ = false;
    returned_ = 0;
    parameters_.enter(arguments);
    frames_.push_back(
        {.body = &subroutines_.find(word.label)->second, .next = 1, .is_call = true, .kept = {}, .repeats = {}});
    return {};
}

/// Return or endsub, with a value or without.
Result Interpreter::leave(Frame& frame, Reader& reader) {
    if (reader.peek() == '[') {
        returned_ = reader.expression();
        has_returned_ = true;
    }
    if (auto empty = rest_is_empty(reader); !empty) { return empty; }
    frame.next = frame.body->lines.size();
    return {};
}

void Interpreter::end_call() {
    if (frames_.back().is_call) {
        const KeptModes kept = frames_.back().kept;
        if (kept.modal && kept.restores_at_return) {
            Context here = context();
            restore(here, *kept.modal);
        }
        parameters_.leave();
        --calls_;
    }
    frames_.pop_back();
}

void Interpreter::unwind() {
    for (; !frames_.empty(); frames_.pop_back()) {
        if (!frames_.back().is_call) { continue; }
        parameters_.leave();
        --calls_;
    }
}

/// From a file of the subroutine's name, which may have others beside it.
Result Interpreter::load(const OWord& word) {
    const auto text = setup_.find_subroutine ? setup_.find_subroutine(word.label) : std::nullopt;
    if (!text) {
        return error(word.place, shown_call(word.label) +
                                     " calls what is not there; write the subroutine before the call" +
                                     (setup_.find_subroutine ? ", or a file " + word.label + ".ngc" : ""));
    }
    const std::string file = word.label + ".ngc";
    Recorder recorder;
    Line line;
    std::optional<GcodeError> wrong;
    for_each_line(*text, [&](std::string_view one, int number) {
        wrong = keep_line_of_file(recorder, line, one, number, file);
        return !wrong && kept_lines_ <= setup_.limits.kept_lines;
    });
    if (!wrong) { wrong = recorder.unclosed(); }
    if (!wrong && kept_lines_ > setup_.limits.kept_lines) {
        wrong =
            GcodeError{1, 1, "more than " + std::to_string(setup_.limits.kept_lines) + " lines, the limit kept_lines"};
    }
    if (wrong) {
        return error(word.place, file + ", line " + std::to_string(wrong->line) + ", column " +
                                     std::to_string(wrong->column) + ": " + wrong->message);
    }
    if (subroutines_.contains(word.label)) { return {}; }
    return error(word.place, file + " does not contain o<" + word.label + "> sub; name the subroutine like its file");
}

std::optional<GcodeError> Interpreter::keep_line_of_file(Recorder& recorder, Line& line, std::string_view text,
                                                         int number, const std::string& file) {
    if (auto wrong = line.read(text, number)) { return wrong; }
    Reader reader(line, parameters_);
    (void)skip_head(line, reader);
    OWord word;
    if (reader.peek() == 'O') { word = read_o_word(reader); }
    if (reader.error()) { return reader.error(); }
    if (!recorder.active() && word.keyword != Keyword::Sub) { return std::nullopt; }
    ++kept_lines_;
    if (auto wrong = recorder.take(line, word, text)) { return wrong; }
    if (recorder.active()) { return std::nullopt; }
    Body body = recorder.take_body();
    body.file = file;
    subroutines_.insert_or_assign(body.label, std::move(body));
    return std::nullopt;
}

}  // namespace lockstep::gcode
