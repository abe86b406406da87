#include "core/gcode/gcode_stream.hpp"

#include <optional>
#include <utility>

#include "core/gcode/interpreter.hpp"
#include "core/gcode/program_builder.hpp"

namespace lockstep {

struct GcodeStream::Parts {
    Parts(const GcodeSetup& given, std::string_view text)
        : setup(given),
          builder(setup),
          interpreter(gcode::interpreter_setup(setup, text), gcode::start_state(setup),
                      [this](const gcode::Action& action, int line) { take(action, line); }) {}

    void take(const gcode::Action& action, int line) {
        builder.take(action, line, interpreter);
        for (GcodeError& error : builder.take_errors()) {
            if (!wrong) { wrong = std::move(error); }
        }
        if (builder.is_full()) { interpreter.stop(); }
    }
    std::expected<void, GcodeError> outcome(const gcode::Result& done) {
        if (!wrong && !done) { wrong = done.error(); }
        if (!wrong) { return {}; }
        return std::unexpected(*std::exchange(wrong, std::nullopt));
    }

    GcodeSetup setup;
    gcode::ProgramBuilder builder;
    gcode::Interpreter interpreter;
    std::optional<GcodeError> wrong;  // in the present line
};

GcodeStream::GcodeStream(const GcodeSetup& setup, std::string_view text)
    : parts_(std::make_unique<Parts>(setup, text)) {}
GcodeStream::~GcodeStream() = default;
GcodeStream::GcodeStream(GcodeStream&&) noexcept = default;
GcodeStream& GcodeStream::operator=(GcodeStream&&) noexcept = default;

ProgramHead GcodeStream::head() const { return parts_->builder.head(); }

std::expected<void, GcodeError> GcodeStream::take(std::string_view line, int number) {
    auto done = parts_->outcome(parts_->interpreter.take(line, number));
    if (!done) { return done; }
    if (auto slow = gcode::slow_feed(parts_->interpreter)) { return std::unexpected(*std::move(slow)); }
    return {};
}

bool GcodeStream::awaits_touch() const { return parts_->interpreter.awaits_touch(); }

std::expected<void, GcodeError> GcodeStream::touched(const ProbeTouch& touch) {
    const gcode::Touch known = parts_->builder.go_on_behind(touch);
    return parts_->outcome(parts_->interpreter.go_on_behind(known));
}

std::expected<void, GcodeError> GcodeStream::finish() { return parts_->outcome(parts_->interpreter.finish()); }

bool GcodeStream::is_ended() const { return parts_->interpreter.ended(); }

std::vector<Block> GcodeStream::take_blocks() { return parts_->builder.blocks().take(); }

void GcodeStream::take_blocks(std::vector<Block>& blocks) { parts_->builder.blocks().take(blocks); }

void GcodeStream::pass_on(TakeBlocks take) { parts_->builder.blocks().pass_on(std::move(take)); }

std::vector<GcodeNote> GcodeStream::take_notes() { return parts_->builder.take_notes(); }

gcode::KeptValues GcodeStream::values() const {
    return gcode::kept_values(parts_->interpreter.state(), gcode::park_place(parts_->setup));
}

ModalState GcodeStream::modal() const { return gcode::modal_of(parts_->interpreter.state(), parts_->setup); }

std::optional<double> GcodeStream::global(std::string_view name) const {
    const gcode::NamedValues& values = parts_->interpreter.state().parameters.global;
    const auto found = values.find(name);
    return found == values.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace lockstep
