// Reads a program line by line: for texts that are longer than memory, or not known yet.
//
// A subroutine stands before its call, or in a file of its name.
#pragma once

#include <memory>

#include "core/gcode/gcode.hpp"
#include "core/gcode/modal_state.hpp"

namespace lockstep {

class GcodeStream {
public:
    explicit GcodeStream(const GcodeSetup& setup);
    ~GcodeStream();
    GcodeStream(GcodeStream&&) noexcept;
    GcodeStream& operator=(GcodeStream&&) noexcept;

    ProgramHead head() const;
    /// The next line, without its end. Error: the first thing wrong with it. Behind it lines can be read for their
    /// errors only.
    std::expected<void, GcodeError> take(std::string_view line, int number);
    /// The end of the text.
    std::expected<void, GcodeError> finish();
    /// M2, M30 or the second %: lines behind it are ignored.
    bool is_ended() const;

    /// What the lines since the last call have become.
    std::vector<Block> take_blocks();
    /// Words that were passed over, and messages, since the last call.
    std::vector<GcodeNote> take_notes();
    /// As the lines taken so far leave them.
    gcode::KeptValues values() const;
    ModalState modal() const;

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace lockstep
