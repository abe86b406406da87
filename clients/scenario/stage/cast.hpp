// The processes of a machine on the stage: started, killed, stopped and woken as the scenario has it. Nobody starts one
// again by itself.
#pragma once

#include <sys/types.h>

#include <expected>
#include <string>
#include <vector>

#include "clients/lockstep/live/service_lines.hpp"
#include "clients/scenario/facts.hpp"

namespace lockstep::scenario {

class Cast {
public:
    /// `lines`: whole, with all that their command lines begin with.
    Cast(const std::vector<ServiceLine>& lines, StateDirectory state);

    /// Errors: there is no such process on the stage now, or it runs already; it cannot be started.
    std::expected<void, std::string> start(const std::string& name);
    std::expected<void, std::string> kill(const std::string& name);
    std::expected<void, std::string> pause(const std::string& name);
    std::expected<void, std::string> unpause(const std::string& name);
    /// Ended as asked, or by force; then started.
    std::expected<void, std::string> restart(const std::string& name);

    /// Neither ended nor stopped.
    bool is_acting(const std::string& name);
    /// Wakes and ends all.
    void end_all();

    /// Whether processes ended that nobody had ended, and how.
    Check ends_check() const;

private:
    struct Part {
        ServiceLine line;
        pid_t pid = 0;  // 0: it does not run
        bool is_paused = false;
    };

    Part* find(const std::string& name);
    std::expected<Part*, std::string> running(const std::string& name);
    void reap();
    /// False: it has not ended in time.
    bool end(Part& part, int signal);

    StateDirectory state_;
    std::vector<Part> parts_;
    std::string ended_by_themselves_;  // and how
};

}  // namespace lockstep::scenario
