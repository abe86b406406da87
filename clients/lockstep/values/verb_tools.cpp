// lockstep tools
#include <memory>

#include <CLI/CLI.hpp>

#include "clients/lockstep/values/change_values.hpp"
#include "clients/lockstep/verb.hpp"

namespace lockstep {
namespace {

struct ToolOptions : LiveOptions {
    int number = 0;
    ChangeWords words;
};

void add_number(CLI::App& verb, ToolOptions& options) {
    verb.add_option("number", options.number, "the tool's number in T and H")->required()->check(CLI::Range(1, 99'999));
}

void add_set_tool(CLI::App& tools, Action& action) {
    const auto options = std::make_shared<ToolOptions>();
    CLI::App* verb = tools.add_subcommand("set", "add a tool, or change it; values that are not given do not change");
    add_number(*verb, *options);
    verb->add_option("words", options->words,
                     "axes and their offsets in mm, Z=25.4: the tool's length; D=6: its diameter; P=2: its pocket; "
                     "Q=1 to 9: the orientation of a lathe tool")
        ->required();
    add_take(*verb, *options);
    add_live_options(*verb, *options);
    verb->footer(footer("  lockstep tools set 1 Z=25.4 D=6\n  lockstep tools set 1 Z=25.38\n"));
    verb->callback([&action, options] {
        action = [options] {
            return change_values(*options, tools_text, [options](const auto& machine, auto& values) {
                return set_tool(machine, options->number, options->words, values);
            });
        };
    });
}

void add_remove(CLI::App& tools, Action& action) {
    const auto options = std::make_shared<ToolOptions>();
    CLI::App* verb = tools.add_subcommand("remove", "remove a tool from the table");
    add_number(*verb, *options);
    add_take(*verb, *options);
    add_live_options(*verb, *options);
    verb->footer(footer("  lockstep tools remove 1\n"));
    verb->callback([&action, options] {
        action = [options] {
            return change_values(*options, tools_text,
                                 [options](const auto&, auto& values) { return remove_tool(options->number, values); });
        };
    });
}

}  // namespace

void add_tools(CLI::App& app, Action& action) {
    CLI::App* verb =
        app.add_subcommand("tools",
                           "show or change the tool table, which the coordinator keeps: G43 takes a "
                           "tool's length from it, G41 and G42 its diameter, and G10 L1 changes it. This is "
                           "not possible while a job runs");
    const auto options = std::make_shared<ToolOptions>();
    add_live_options(*verb, *options);
    verb->require_subcommand(0, 1);
    verb->footer(
        footer("  lockstep tools\n  lockstep tools set 1 Z=25.4 D=6\n  lockstep tools remove 1\n"
               "  lockstep tools --json\n"));
    // CLI11 calls the callbacks of subcommands first, so a subcommand has set its own action already.
    verb->callback([&action, options, verb] {
        if (verb->get_subcommands().empty()) {
            action = [options] { return show_values(*options, tools_text); };
        }
    });
    add_set_tool(*verb, action);
    add_remove(*verb, action);
}

}  // namespace lockstep
