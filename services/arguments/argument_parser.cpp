#include "services/arguments/argument_parser.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <map>
#include <optional>
#include <sstream>

#include <CLI/CLI.hpp>

namespace lockstep {

struct ParserState {
    CLI::App app;
    std::map<const CLI::App*, std::function<int()>> actions;
};

namespace {

std::vector<CLI::App*> verbs_of(CLI::App& verb) {
    return verb.get_subcommands([](const CLI::App* part) { return !part->get_name().empty(); });
}

/// A verb without an action must be followed by one of its verbs.
void require_verbs(CLI::App& verb, const ParserState& state) {
    const auto verbs = verbs_of(verb);
    if (verbs.empty()) { return; }
    verb.require_subcommand(state.actions.contains(&verb) ? 0 : 1, 1);
    for (CLI::App* part : verbs) { require_verbs(*part, state); }
}

const CLI::App& last_verb(const CLI::App& verb) {
    const auto chosen = verb.get_subcommands();
    return chosen.empty() ? verb : last_verb(*chosen.front());
}

/// CLI11's message, except for an unknown verb, which CLI11 would report as missing. Adds which help to read.
std::string text_of(const CLI::ParseError& error, CLI::App& app, const std::string& first) {
    const std::string name = app.get_name();
    const auto verbs = verbs_of(app);
    const bool is_known = std::ranges::any_of(verbs, [&](const CLI::App* verb) { return verb->get_name() == first; });
    if (is_known) { return error.what() + ("; see: " + name) + " " + first + " --help"; }
    const bool is_verb = !verbs.empty() && !first.empty() && !first.starts_with('-');
    return fmt::format("{}; see: {} --help", (is_verb ? "there is no verb '" + first + "'" : error.what()), name);
}

/// A list of verbs has one line for each.
class ShortListFormatter : public CLI::Formatter {
public:
    ShortListFormatter() { label("SUBCOMMAND", "VERB"); }

    std::string make_subcommand(const CLI::App* verb) const override {
        const std::string help = verb->get_description();
        std::ostringstream line;
        CLI::detail::format_help(line, verb->get_name(), help.substr(0, help.find('\n')), get_column_width());
        return line.str();
    }
};

}  // namespace

Argument Argument::required() const {
    option_->required();
    return *this;
}

Argument Argument::with_default() const {
    option_->capture_default_str();
    return *this;
}

Argument Argument::in_range(int least, int most) const {
    option_->check(CLI::Range(least, most));
    return *this;
}

Argument Argument::in_range(double least, double most) const {
    option_->check(CLI::Range(least, most));
    return *this;
}

Argument Argument::one_of(const std::vector<std::string>& words) const {
    option_->check(CLI::IsMember(words));
    return *this;
}

Argument Argument::checked_by(const std::function<std::string(const std::string&)>& error_of) const {
    option_->check(error_of);
    return *this;
}

Argument Argument::separated_by_commas() const {
    option_->delimiter(',');
    return *this;
}

Argument Argument::needs(Argument other) const {
    option_->needs(other.option_);
    return *this;
}

Argument Argument::excludes(Argument other) const {
    option_->excludes(other.option_);
    return *this;
}

Verb Verb::add_verb(const std::string& name, const std::string& help) const {
    CLI::App* verb = app_->add_subcommand(name, help);
    verb->group(heading_);
    return {*verb, *state_};
}

Verb Verb::under(const std::string& heading) const { return {*app_, *state_, heading}; }

Verb Verb::add_choice(const std::string& name, const std::string& help) const {
    auto* group = app_->add_option_group(name, help);
    group->require_option(1);
    return {*group, *state_};
}

template <class Value>
Argument Verb::add_option(const std::string& name, Value& value, const std::string& help) const {
    return Argument(*app_->add_option(name, value, help));
}

Argument Verb::add_flag(const std::string& name, bool& value, const std::string& help) const {
    return Argument(*app_->add_flag(name, value, help));
}

void Verb::footer(const std::string& text) const { app_->footer(text); }

void Verb::action(std::function<int()> run) const { state_->actions[app_] = std::move(run); }

ArgumentParser::ArgumentParser(const std::string& description, const std::string& name)
    : ArgumentParser(std::unique_ptr<ParserState>(new ParserState{CLI::App(description, name), {}})) {}

ArgumentParser::ArgumentParser(std::unique_ptr<ParserState> state)
    : Verb(state->app, *state), owned_(std::move(state)) {
    app_->formatter(std::make_shared<ShortListFormatter>());
}

ArgumentParser::~ArgumentParser() = default;

void ArgumentParser::version(const std::string& text) const { app_->set_version_flag("--version", text); }

int ArgumentParser::run(int argc, const char* const* argv) {
    return run(argc, argv, [](const std::string& error) {
        std::cerr << error << '\n';
        return kWrongUsage;
    });
}

int ArgumentParser::run(int argc, const char* const* argv,
                        const std::function<int(const std::string& error)>& on_error) {
    require_verbs(*app_, *state_);
    try {
        app_->parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) { return app_->exit(error); }
        return on_error(text_of(error, *app_, argc > 1 ? argv[1] : ""));
    }
    return state_->actions.at(&last_verb(*app_))();
}

// The kinds of values that options have.
#define LOCKSTEP_OPTION(...) \
    template Argument Verb::add_option(const std::string&, __VA_ARGS__&, const std::string&) const
LOCKSTEP_OPTION(std::string);
LOCKSTEP_OPTION(std::filesystem::path);
LOCKSTEP_OPTION(int);
LOCKSTEP_OPTION(std::int64_t);
LOCKSTEP_OPTION(std::uint16_t);
LOCKSTEP_OPTION(std::uint64_t);
LOCKSTEP_OPTION(double);
LOCKSTEP_OPTION(std::optional<std::string>);
LOCKSTEP_OPTION(std::optional<std::filesystem::path>);
LOCKSTEP_OPTION(std::optional<int>);
LOCKSTEP_OPTION(std::optional<std::uint16_t>);
LOCKSTEP_OPTION(std::optional<std::int64_t>);
LOCKSTEP_OPTION(std::optional<std::uint64_t>);
LOCKSTEP_OPTION(std::optional<double>);
LOCKSTEP_OPTION(std::vector<std::string>);
#undef LOCKSTEP_OPTION

}  // namespace lockstep
