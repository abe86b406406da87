// lockstep tools
#include <memory>

#include "clients/lockstep/values/change_values.hpp"
#include "clients/lockstep/verb.hpp"

namespace lockstep {
namespace {

struct ToolOptions : LiveOptions {
    int number = 0;
    ChangeWords words;
};

void add_number(Verb verb, ToolOptions& options) {
    verb.add_option("number", options.number, "the tool's number in T and H").required().in_range(1, 99'999);
}

void add_set_tool(Verb tools) {
    const auto options = std::make_shared<ToolOptions>();
    const Verb verb = tools.add_verb("set", "add a tool, or change it; values that are not given do not change");
    add_number(verb, *options);
    verb.add_option("words", options->words,
                    "axes and their offsets in mm, Z=25.4: the tool's length; D=6: its diameter; P=2: its pocket; "
                    "Q=1 to 9: the orientation of a lathe tool")
        .required();
    add_take(verb, *options);
    add_live_options(verb, *options);
    verb.footer(footer("  lockstep tools set 1 Z=25.4 D=6\n  lockstep tools set 1 Z=25.38\n"));
    verb.action([options] {
        return change_values(*options, tools_text, [options](const auto& machine, auto& values) {
            return set_tool(machine, options->number, options->words, values);
        });
    });
}

void add_remove(Verb tools) {
    const auto options = std::make_shared<ToolOptions>();
    const Verb verb = tools.add_verb("remove", "remove a tool from the table");
    add_number(verb, *options);
    add_take(verb, *options);
    add_live_options(verb, *options);
    verb.footer(footer("  lockstep tools remove 1\n"));
    verb.action([options] {
        return change_values(*options, tools_text,
                             [options](const auto&, auto& values) { return remove_tool(options->number, values); });
    });
}

}  // namespace

void add_tools(Verb command) {
    const Verb verb =
        command.add_verb("tools",
                         "show or change the tool table\n"
                         "The coordinator keeps the table. G43 takes a tool's length from it, G41 and G42 its "
                         "diameter, and G10 L1 changes it. While a job runs, a change is possible only in its pauses.");
    const auto options = std::make_shared<ToolOptions>();
    add_live_options(verb, *options);
    verb.footer(
        footer("  lockstep tools\n  lockstep tools set 1 Z=25.4 D=6\n  lockstep tools remove 1\n"
               "  lockstep tools --json\n"));
    verb.action([options] { return show_values(*options, tools_text); });
    add_set_tool(verb);
    add_remove(verb);
}

}  // namespace lockstep
