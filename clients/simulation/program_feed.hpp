// Sends a program to a machine in virtual time while the machine runs it: part by part, as far as the coordinator has
// room, as clients/session/upload/program_sender.hpp does live. The virtual network loses nothing, so one part at a
// time is under way and none is repeated.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>

#include "clients/planning/program_text.hpp"
#include "services/virtual/virtual_machine.hpp"

namespace lockstep {

/// "plate.gcode:7:3: ..."
std::string place_and_text(const std::string& file, const Diagnostic& error);

class ProgramFeed {
public:
    /// `make_room` makes the coordinator keep so many more blocks from now on. The text and the machine must outlive
    /// this object.
    ProgramFeed(VirtualMachine& vm, std::uint64_t program, ProgramText& text,
                std::function<void(std::size_t blocks)> make_room);

    /// Call it often. Sends the next part if the one before was taken and there is room. Otherwise asks for the room
    /// now and then.
    void tend();

    /// The coordinator has answered the first part.
    bool has_begun() const { return index_ > 0 || refusal_; }
    /// Why the machine does not get all of the program; empty if it does.
    std::string trouble() const;

    static constexpr std::size_t kBlocks = 1000;  // of a part

private:
    ProgramPart next_part();
    void send(ProgramPart part);
    void take_answer(const Reply& reply);
    bool has_room() const { return part_->blocks.size() <= room_; }

    VirtualMachine& vm_;
    std::uint64_t program_;
    ProgramText& text_;
    std::function<void(std::size_t)> make_room_;
    Ticks ask_after_;
    std::uint32_t index_ = 0;                                         // of the next part; so many parts were taken
    std::uint32_t next_ = 0;                                          // the next block to read
    std::optional<ProgramPart> part_;                                 // not taken yet
    std::uint64_t room_ = std::numeric_limits<std::uint64_t>::max();  // the coordinator's room after the parts taken
    std::optional<std::uint64_t> unanswered_;                         // a part's or question's sequence number
    bool is_question_ = false;                                        // the last message was a question
    Tick sent_;                                                       // when the last message was sent
    bool is_over_ = false;                                            // the last part was read
    std::string cut_;                                                 // the error in the text, with its place
    std::optional<Reply> refusal_;
};

}  // namespace lockstep
