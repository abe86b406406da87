// Reads a G-code file, or a pipe, while the coordinator runs it: as much at a time as the coordinator has room for.
//
// The lines behind a probing move depend on its touch. So the file is divided into parts: each part ends with a probing
// move, and is a program of its own.
#pragma once

#include <chrono>
#include <optional>
#include <vector>

#include "clients/session/upload/program_sender.hpp"
#include "core/gcode/gcode_stream.hpp"
#include "services/files/diagnostic.hpp"
#include "services/files/line_reader.hpp"

namespace lockstep {

class ProgramStream {
public:
    /// `revision`: the revision of the machine's values in `setup`.
    ProgramStream(LineReader lines, const GcodeSetup& setup, std::uint64_t revision);

    /// Of the present part.
    const ProgramHead& head() const { return head_; }
    gcode::ProgramValues values() const { return {.revision = revision_, .after = {}}; }

    /// Reads the first lines before anything moves. Fails if one of them has an error or cannot be read.
    std::expected<void, Diagnostics> read_first();
    /// Skips the lines before `line`. Returns a program with the last feed move and the last move before the line,
    /// which give the state there, and the first blocks from the line on, and the modal state at the line's beginning.
    /// Fails like read_first().
    struct Beginning {
        Program program;
        ModalState modal;
    };
    std::expected<Beginning, Diagnostics> skip_before(int line);
    /// Replaces the blocks read so far by a program that starts elsewhere.
    void replace_first(const Program& program);
    /// A ProgramUpload::Feed. If a pipe stays empty for kSettleAfter, the machine comes to rest at the end of the
    /// blocks received. At an error it cuts the program, and the machine runs the part before the error.
    void feed(ProgramSender& sender, std::chrono::nanoseconds now);

    /// The present part ends with a probing move.
    bool awaits_touch() const { return gcode_.awaits_touch(); }
    /// The present part changes the machine's offsets or tools.
    bool changes_values() const { return gcode_.values() != before_; }
    /// Begins the next part, behind the touch, and reads its first lines. `revision`: of the machine's values now.
    /// Fails like read_first().
    std::expected<void, Diagnostics> touched(const ProbeTouch& touch, std::uint64_t revision);
    /// Cuts the program behind the touch.
    void cannot_go_on(std::string why);
    /// Nothing is left to run.
    bool is_empty() const { return is_over_ && blocks_.empty() && !awaits_touch() && !changes_values(); }

    /// Why the program was cut, with the place; nullopt if it was not.
    const std::optional<Diagnostic>& trouble() const { return trouble_; }
    /// The value of #<_name> after the lines read so far; nullopt if they have not set it.
    std::optional<double> global(std::string_view name) const { return gcode_.global(name); }
    /// Ignored words, and messages, since the last call.
    std::vector<GcodeNote> take_notes() { return gcode_.take_notes(); }

    static constexpr std::size_t kLinesFirst = 100'000;  // takes some tenths of a second
    static constexpr std::size_t kLinesAtOnce = 5'000;
    static constexpr std::chrono::milliseconds kSettleAfter{200};

private:
    enum class Reading : std::uint8_t { Goes, Waits, Ends };
    Reading read_line();
    void take_line(std::string_view line);
    void take_blocks();
    void refuse_restart_behind_touch(int line);
    void append(ProgramSender& sender);
    void finish(ProgramSender& sender);
    void settle(ProgramSender& sender, std::chrono::nanoseconds now);

    LineReader lines_;
    GcodeStream gcode_;
    ProgramHead head_;
    gcode::KeptValues before_;  // values before the present part
    std::uint64_t revision_;
    std::vector<Block> blocks_;  // blocks read; those from next_ on are not appended yet
    std::size_t next_ = 0;
    int line_ = 0;  // number of the last line read
    bool is_over_ = false;
    bool is_settled_ = true;  // the appended blocks end with a rest
    std::optional<std::chrono::nanoseconds> waits_since_;
    std::optional<Diagnostic> trouble_;
};

}  // namespace lockstep
