#include "core/gcode/gcode.hpp"

#include "core/gcode/interpreter.hpp"
#include "core/gcode/modal_state.hpp"
#include "core/gcode/program_builder.hpp"
#include "core/gcode/text_lines.hpp"

namespace lockstep {
namespace {

constexpr int kNoEnd = 0;  // lines are numbered from 1

/// Reads a text's lines until one ends the program, or there are too many errors.
class GcodeReader {
public:
    GcodeReader(std::string_view text, const GcodeSetup& setup, gcode::Sink sink)
        : text_(text),
          interpreter_(gcode::interpreter_setup(setup, text), gcode::start_state(setup), std::move(sink)) {}

    template <typename AfterLine>
    void read(int end, AfterLine after_line) {
        gcode::for_each_line(text_, [&](std::string_view line, int number) {
            if (number == end) { return false; }
            if (auto done = interpreter_.take(line, number); !done) { report(done.error()); }
            after_line(number);
            return !interpreter_.ended() && errors_.size() < kMaxGcodeErrors;
        });
        if (errors_.size() >= kMaxGcodeErrors) { return; }
        if (auto done = interpreter_.finish(); !done) { report(done.error()); }
    }

    void report(const GcodeError& error) {
        if (error.repeats && std::exchange(repeated_, true)) { return; }
        errors_.push_back(error);
    }
    void stop() { interpreter_.stop(); }
    const gcode::Interpreter& interpreter() const { return interpreter_; }
    std::vector<GcodeError>& errors() { return errors_; }

private:
    std::string_view text_;
    gcode::Interpreter interpreter_;
    std::vector<GcodeError> errors_;
    bool repeated_ = false;
};

/// Builds the program. Returns the values at its end.
std::expected<gcode::KeptValues, std::vector<GcodeError>> build(std::string_view text, const GcodeSetup& setup,
                                                                gcode::ProgramBuilder& builder) {
    GcodeReader* reading = nullptr;
    GcodeReader reader(text, setup, [&](const gcode::Action& action, int line) {
        builder.take(action, line, reading->interpreter());
        for (const GcodeError& error : builder.take_errors()) { reading->report(error); }
        if (builder.is_full()) { reading->stop(); }
    });
    reading = &reader;
    reader.read(kNoEnd, [&](int) {
        if (auto wrong = gcode::slow_feed(reader.interpreter())) { reader.report(*wrong); }
    });
    if (!reader.errors().empty()) { return std::unexpected(std::move(reader.errors())); }
    return gcode::kept_values(reader.interpreter().state(), gcode::park_place(setup));
}

}  // namespace

std::expected<GcodeReading, std::vector<GcodeError>> read_gcode(std::string_view text, const GcodeSetup& setup) {
    gcode::ProgramBuilder builder(setup);
    auto values = build(text, setup, builder);
    if (!values) { return std::unexpected(std::move(values.error())); }
    GcodeReading result = std::move(builder).reading();
    result.values = *std::move(values);
    return result;
}

std::vector<GcodeError> check_gcode(std::string_view text, const GcodeSetup& setup) {
    gcode::ProgramBuilder builder(setup);
    builder.blocks().pass_on([](std::vector<Block>& blocks) { blocks.clear(); });
    auto values = build(text, setup, builder);
    return values ? std::vector<GcodeError>{} : std::move(values.error());
}

std::expected<Program, std::vector<GcodeError>> parse_gcode(std::string_view text, const GcodeSetup& setup) {
    auto reading = read_gcode(text, setup);
    if (!reading) { return std::unexpected(std::move(reading.error())); }
    return std::move(reading->program);
}

std::expected<void, std::vector<GcodeError>> gcode_actions(std::string_view text, const GcodeSetup& setup,
                                                           const TakeAction& take) {
    GcodeReader reader(text, setup, take);
    reader.read(kNoEnd, [](int) {});
    if (!reader.errors().empty()) { return std::unexpected(std::move(reader.errors())); }
    return {};
}

ModalState modal_state_at(std::string_view text, const GcodeSetup& setup, int line) {
    GcodeReader reader(text, setup, [](const gcode::Action&, int) {});
    reader.read(line, [](int) {});
    return gcode::modal_of(reader.interpreter().state(), setup);
}

}  // namespace lockstep
