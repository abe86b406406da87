// The bodies of a program: each loop or branch until it has been run, and its subroutines, also those of files and
// those behind their call.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/gcode/flow/body.hpp"
#include "core/gcode/setup.hpp"

namespace lockstep::gcode {

class StoredBodies {
public:
    /// Both must outlive this. `parameters`: of labels that the program computes.
    StoredBodies(const Setup& setup, const Parameters& parameters) : setup_(setup), parameters_(parameters) {}

    /// The end of a body has not been read yet.
    bool is_recording() const { return recorder_.active(); }
    /// The O-word that began it, such as "o100 while"; nullopt if there is none.
    std::optional<std::string> open_word() const { return recorder_.open_word(); }
    /// Stores the first line of a body, or one within it. Returns the loop or branch that the line ends, which must be
    /// run at once; null if it ends none.
    std::expected<const Body*, GcodeError> take(const Line& line, const OWord& word, std::string_view text);
    /// Removes the loop or branch, which has been run.
    void remove_loop();
    /// Returns an error if the text has ended within a body.
    Result finish();

    /// Returns the subroutine of a call. Searches as LinuxCNC does: in the lines before, then in a file of its name,
    /// and without such a file behind `program_line`.
    std::expected<const Body*, GcodeError> find(const OWord& call, const Line& line, int program_line);

private:
    struct Text;
    Result read_file(const OWord& call, const Line& line, std::string_view text);
    Result read_behind(const OWord& call, const Line& line, int program_line);
    Text text_behind(const std::string& label, int program_line);
    void find_beginnings();
    std::optional<GcodeError> store_subroutines(const Text& source);

    const Setup& setup_;
    const Parameters& parameters_;
    Recorder recorder_;
    std::size_t lines_ = 0;     // of all bodies
    std::optional<Body> loop_;  // or branch of the program itself
    std::map<std::string, Body, std::less<>> subroutines_;
    std::set<std::string, std::less<>> called_early_;  // subroutines that are behind their first call
    /// A line of the program that begins a subroutine, and the place of its text in the program.
    struct Beginning {
        int line;
        std::size_t place;
    };
    std::map<std::string, std::vector<Beginning>, std::less<>> beginnings_;  // by label
    bool has_beginnings_ = false;
};

}  // namespace lockstep::gcode
