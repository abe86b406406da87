#include "core/gcode/gcode.hpp"

#include "core/gcode/block.hpp"
#include "core/gcode/interpreter.hpp"
#include "core/gcode/words.hpp"

namespace lockstep {
namespace {

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

    std::expected<Program, std::vector<GcodeError>> read(std::string_view text) {
        for (int number = 1; !text.empty() && !ended_ && interpreter_.errors().size() < kMaxGcodeErrors; ++number) {
            read_line(take_line(text), number);
        }
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
    return GcodeReader(setup).read(text);
}

}  // namespace lockstep
