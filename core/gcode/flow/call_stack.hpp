// The bodies that are being run: a loop or branch of the program outermost, then the subroutines called from within.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/gcode/flow/body_run.hpp"
#include "core/gcode/state.hpp"

namespace lockstep::gcode {

class CallStack {
public:
    /// `kept` and `returned`: those of the program itself.
    CallStack(Parameters& parameters, KeptModes kept, std::optional<double> returned)
        : parameters_(parameters), kept_{std::move(kept)}, returned_(returned) {}

    bool is_empty() const { return levels_.empty(); }
    /// Of how many subroutines the end is still to be run.
    std::size_t calls() const { return kept_.size() - 1; }
    BodyRun& innermost() { return levels_.back().run; }
    /// The label of the subroutine that is being run; empty in the program itself.
    std::string subroutine() const;
    /// The modes stored by that subroutine, or by the program itself.
    KeptModes& kept() { return kept_.back(); }
    const KeptModes& kept() const { return kept_.back(); }
    /// The value that the last call has returned, if it has.
    const std::optional<double>& returned() const { return returned_; }

    /// Begins a loop or a branch of the program itself.
    void run(const Body& body) { levels_.push_back({.run = BodyRun(body, 0)}); }
    void call(const Body& subroutine, const Arguments& arguments);
    /// Goes to the end of the subroutine. `reader` is behind a return or an endsub, with a value or without.
    Result leave(Reader& reader);
    /// The modes that hold again behind the innermost body, if it has stored them for that.
    std::optional<Modal> modes_behind() const;
    /// Ends the innermost body.
    void end();
    void end_all();

private:
    struct Level {
        BodyRun run;
        bool is_call = false;
    };

    Parameters& parameters_;
    std::vector<Level> levels_;
    std::vector<KeptModes> kept_;  // of the program itself, then of each call
    std::optional<double> returned_;
};

}  // namespace lockstep::gcode
