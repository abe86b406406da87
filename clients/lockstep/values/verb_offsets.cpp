// lockstep offsets
#include <memory>

#include "clients/lockstep/values/change_values.hpp"
#include "clients/lockstep/verb.hpp"

namespace lockstep {
namespace {

struct OffsetOptions : LiveOptions {
    std::string name;
    ChangeWords words;
};

void add_set_offset(Verb offsets) {
    const auto options = std::make_shared<OffsetOptions>();
    const Verb verb = offsets.add_verb("set", "set one offset; axes that are not named keep theirs");
    verb.add_option("name", options->name, "G54 to G59, G59.1 to G59.3, G92, G28 or G30").required();
    verb.add_option("words", options->words,
                    "the origin in machine coordinates, mm or degrees: X=10 Y=20; R=30: rotated by 30 degrees about Z")
        .required();
    add_take(verb, *options);
    add_live_options(verb, *options);
    verb.footer(
        footer("  lockstep offsets set G54 X=10 Y=20\n  lockstep offsets set G55 X=100 R=30\n"
               "  lockstep offsets set G28 Z=50\n"));
    verb.action([options] {
        return change_values(*options, offsets_text, [options](const auto& machine, auto& values) {
            return set_offset(machine, options->name, options->words, values);
        });
    });
}

void add_clear(Verb offsets) {
    const auto options = std::make_shared<OffsetOptions>();
    const Verb verb =
        offsets.add_verb("clear", "set an offset to the machine's zero, or G28 and G30 to the park position");
    verb.add_option("name", options->name, "G54 to G59, G59.1 to G59.3, G92, G28 or G30; or all").required();
    add_take(verb, *options);
    add_live_options(verb, *options);
    verb.footer(footer("  lockstep offsets clear G54\n  lockstep offsets clear all\n"));
    verb.action([options] {
        return change_values(*options, offsets_text,
                             [options](const auto&, auto& values) { return clear_offset(options->name, values); });
    });
}

}  // namespace

void add_offsets(Verb command) {
    const Verb verb =
        command.add_verb("offsets",
                         "show or change the coordinate systems G54 to G59.3 and G92\n"
                         "G-code programs begin with these offsets, and with the places of G28 and G30. "
                         "The coordinator keeps them, and a program that reaches its end can change them. "
                         "While a job runs, a change is possible only in its pauses.");
    const auto options = std::make_shared<OffsetOptions>();
    add_live_options(verb, *options);
    verb.footer(
        footer("  lockstep offsets\n  lockstep offsets set G54 X=10 Y=20\n  lockstep offsets clear G54\n"
               "  lockstep offsets --json\n"));
    verb.action([options] { return show_values(*options, offsets_text); });
    add_set_offset(verb);
    add_clear(verb);
}

}  // namespace lockstep
