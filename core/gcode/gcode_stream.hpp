// Reads a program line by line, for texts that do not fit in memory or are not complete yet.
//
// Unless the whole text is known, a subroutine must be before its call, or in a file of its name.
#pragma once

#include <memory>

#include "core/gcode/built_blocks.hpp"
#include "core/gcode/gcode.hpp"
#include "core/gcode/modal_state.hpp"

namespace lockstep {

class GcodeStream {
public:
    /// `text`: the whole text, if it is known. A subroutine may then be behind its call. It must outlive the stream.
    explicit GcodeStream(const GcodeSetup& setup, std::string_view text = {});
    ~GcodeStream();
    GcodeStream(GcodeStream&&) noexcept;
    GcodeStream& operator=(GcodeStream&&) noexcept;

    ProgramHead head() const;
    /// Reads the next line, without its line end. Returns its first error. After an error, further lines can be read
    /// only to find their errors.
    std::expected<void, GcodeError> take(std::string_view line, int number);
    /// True after the line of a probing move, with GcodeSetup::awaits_touches. The blocks up to it are a whole program,
    /// and no line may be taken before touched().
    bool awaits_touch() const;
    /// Gives the touch, and reads on in a loop or a subroutine, up to the next probing move. The blocks from here on
    /// are another program, with another head(). Returns errors like take().
    std::expected<void, GcodeError> touched(const ProbeTouch& touch);
    /// Ends the text.
    std::expected<void, GcodeError> finish();
    /// True after M2, M30 or the second %. Later lines are ignored.
    bool is_ended() const;

    /// The blocks of the lines since the last call.
    std::vector<Block> take_blocks();
    /// Moves them to `blocks`, whose memory is used for the next ones.
    void take_blocks(std::vector<Block>& blocks);
    /// From now on `take` gets the blocks of a line whenever many wait, before the line is done.
    void pass_on(TakeBlocks take);
    /// Skipped words, and messages, since the last call.
    std::vector<GcodeNote> take_notes();
    /// The values and modes after the lines taken so far.
    gcode::KeptValues values() const;
    ModalState modal() const;
    /// The value of #<_name>; nullopt if the lines so far have not set it.
    std::optional<double> global(std::string_view name) const;

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace lockstep
