// Reads a G-code file, or a pipe, while the coordinator runs it: as much at a time as the coordinator has room for.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "clients/session/program_sender.hpp"
#include "core/gcode/gcode_stream.hpp"
#include "services/files/diagnostic.hpp"
#include "services/files/line_reader.hpp"

namespace lockstep {

class ProgramStream {
public:
    /// `revision`: of the machine's values in the setup.
    ProgramStream(LineReader lines, const GcodeSetup& setup, std::uint64_t revision);

    const ProgramHead& head() const { return head_; }
    gcode::ProgramValues values() const { return {.revision = revision_, .after = {}}; }

    /// Reads the first lines, before anything moves. Error: one of them is wrong, or none can be read.
    std::expected<void, Diagnostics> read_first();
    /// Passes over the lines before this one. Returns the program's beginning, without what is not needed to go on
    /// there: the last moves before the line, and the first ones from it on. Error: as read_first().
    std::expected<Program, Diagnostics> skip_before(int line);
    /// As that line finds it.
    const ModalState& modal() const { return modal_; }
    /// Instead of what was read so far, from another start.
    void replace_first(const Program& program);
    /// As Session::Feed. A pipe in which nothing is left for a moment lets the machine come to rest at the end of what
    /// came. At an error the program is cut, and the machine runs what is before it.
    void feed(ProgramSender& sender, std::chrono::nanoseconds now);

    /// Why it was cut, with its place; nothing: it was not.
    const std::optional<Diagnostic>& trouble() const { return trouble_; }
    /// Words that were passed over, and messages, since the last call.
    std::vector<GcodeNote> take_notes() { return gcode_.take_notes(); }

    static constexpr std::size_t kLinesFirst = 100'000;  // some tenths of a second
    static constexpr std::size_t kLinesAtOnce = 5'000;
    static constexpr std::chrono::milliseconds kSettleAfter{200};

private:
    enum class Reading : std::uint8_t { Goes, Waits, Ends };
    Reading read_line();
    void take_line(std::string_view line);
    void append(ProgramSender& sender);
    void finish(ProgramSender& sender);
    void settle(ProgramSender& sender, std::chrono::nanoseconds now);

    LineReader lines_;
    GcodeStream gcode_;
    ProgramHead head_;
    ModalState modal_;
    gcode::KeptValues before_;  // the program
    std::uint64_t revision_;
    std::vector<Block> blocks_;  // read, from next_ on not appended yet
    std::size_t next_ = 0;
    int line_ = 0;  // the last one read
    bool is_over_ = false;
    bool is_settled_ = true;  // what was appended ends with a rest
    std::optional<std::chrono::nanoseconds> waits_since_;
    std::optional<Diagnostic> trouble_;
};

}  // namespace lockstep
