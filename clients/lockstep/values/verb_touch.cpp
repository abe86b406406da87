// lockstep touch
#include <memory>

#include "clients/lockstep/values/change_values.hpp"
#include "clients/lockstep/verb.hpp"
#include "clients/session/job_plan.hpp"
#include "clients/session/move_program.hpp"

namespace lockstep {
namespace {

struct TouchOptions : LiveOptions {
    std::string system = "G54";
    ChangeWords words;
};

/// Fails if an axis is not homed, because its position is not known.
Changed check_homed(const Session& session, const ChangeWords& words) {
    for (const std::string& word : words) {
        const auto target = parse_target(word);
        const auto axis = target ? find_axis(session.config(), target->axis) : std::unexpected(target.error());
        if (!axis) { return std::unexpected(axis.error()); }
        if (session.received().axis(*axis)->state.homed) { continue; }
        return std::unexpected("axis " + session.config().axes[*axis].name +
                               " is not homed, so its position is not known; home it: lockstep home");
    }
    return {};
}

Changed touch(Session& session, const TouchOptions& options, gcode::KeptValues& values) {
    const auto places = start_places(session);
    if (!places) { return std::unexpected(places.error().errors.front().message); }
    if (auto homed = check_homed(session, options.words); !homed) { return homed; }
    return touch_off(session.config(), *places, options.system, options.words, values);
}

}  // namespace

void add_touch(Verb command) {
    const Verb verb =
        command.add_verb("touch",
                         "set the work zero at the axes' present positions\n"
                         "The present positions get new coordinates in a coordinate system, as G10 L20 gives "
                         "them.");
    const auto options = std::make_shared<TouchOptions>();
    verb.add_option("words", options->words, "X=0 Z=-0.1; axes that are not named keep their zero").required();
    verb.add_option("--system", options->system, "G54 to G59, G59.1 to G59.3; programs begin with G54").with_default();
    add_take(verb, *options);
    add_live_options(verb, *options);
    verb.footer(footer("  lockstep touch X=0 Y=0\n  lockstep touch Z=0.1 --system G55\n"));
    verb.action([options] {
        return change_values_here(*options, offsets_text, [options](Session& session, auto& values) {
            return touch(session, *options, values);
        });
    });
}

}  // namespace lockstep
