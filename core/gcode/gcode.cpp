#include "core/gcode/gcode.hpp"

#include "core/gcode/block.hpp"
#include "core/gcode/interpreter.hpp"
#include "core/gcode/words.hpp"

namespace lockstep {
namespace {

constexpr int kNoEnd = 0;  // lines are numbered from 1

/// Cuts the next line off the text, without its LF or CR LF.
std::string_view take_line(std::string_view& text) {
    const std::size_t end = text.find('\n');
    std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (line.ends_with('\r')) { line.remove_suffix(1); }
    return line;
}

class GcodeReader {
public:
    explicit GcodeReader(const GcodeSetup& setup) : setup_(setup), letters_(axis_letters(setup)), interpreter_(setup) {}

    void read_lines(std::string_view text, int end) {
        constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
        if (text.starts_with(kByteOrderMark)) { text.remove_prefix(kByteOrderMark.size()); }
        for (int number = 1; number != end && !text.empty() && !ended_; ++number) {
            if (interpreter_.errors().size() >= kMaxGcodeErrors) { return; }
            read_line(take_line(text), number);
        }
    }
    ModalState modal_state() const { return interpreter_.modal_state(); }
    std::expected<Program, std::vector<GcodeError>> program() const {
        if (!interpreter_.errors().empty()) { return std::unexpected(interpreter_.errors()); }
        return interpreter_.program();
    }

private:
    void read_line(std::string_view text, int number) {
        const auto line = split_gcode_line(text, number);
        if (!line) { return interpreter_.report(line.error()); }
        if (line->tape_mark) {
            ended_ = begun_;
            return;
        }
        if (line->words.empty() || (line->deletable && setup_.switches.skip_deletable)) { return; }
        begun_ = true;
        const auto block = read_gcode_block(line->words, letters_, number);
        if (!block) { return interpreter_.report(block.error()); }
        interpreter_.execute(*block, number);
        ended_ = block->stop == gcode::Stop::End;
    }

    const GcodeSetup& setup_;
    std::string letters_;
    GcodeInterpreter interpreter_;
    bool begun_ = false;  // a block has been read: the next % ends the program
    bool ended_ = false;
};

}  // namespace

std::expected<Program, std::vector<GcodeError>> parse_gcode(std::string_view text, const GcodeSetup& setup) {
    GcodeReader reader(setup);
    reader.read_lines(text, kNoEnd);
    return reader.program();
}

ModalState modal_state_at(std::string_view text, const GcodeSetup& setup, int line) {
    GcodeReader reader(setup);
    reader.read_lines(text, line);
    return reader.modal_state();
}

}  // namespace lockstep
