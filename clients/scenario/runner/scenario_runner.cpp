#include "clients/scenario/runner/scenario_runner.hpp"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <map>

#include "clients/scenario/runner/control_groups.hpp"
#include "clients/scenario/runner/run_scenario.hpp"
#include "clients/scenario/runner/sandbox.hpp"
#include "services/files/descriptor.hpp"

namespace lockstep::scenario {
namespace {

namespace fs = std::filesystem;

constexpr int kPollInterval_ms = 100;

/// Makes and opens a new directory for a scenario's logs.
std::expected<int, std::string> open_folder(const fs::path& path) {
    std::error_code error;
    if (fs::exists(path, error)) {
        return std::unexpected(path.string() + ": exists already; name a new directory for the logs");
    }
    fs::create_directories(path, error);
    const int folder = open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder < 0) {
        return std::unexpected(path.string() + ": cannot be created; name another directory for the logs");
    }
    return folder;
}

class ScenarioRunner {
public:
    ScenarioRunner(const std::vector<Scenario>& scenarios, const RunnerOptions& options)
        : scenarios_(scenarios), options_(options), reports_(scenarios.size()) {}
    ~ScenarioRunner() {
        sandboxes_.clear();
        if (containers_) { remove_control_groups(); }
    }
    ScenarioRunner(const ScenarioRunner&) = delete;
    ScenarioRunner& operator=(const ScenarioRunner&) = delete;

    std::expected<proto::ScenarioRunReport, std::string> run() {
        if (const auto found = find_image(); !found) { return std::unexpected(found.error()); }
        if (const auto opened = open_folders(); !opened) { return std::unexpected(opened.error()); }
        while (next_ < scenarios_.size() || !sandboxes_.empty()) {
            if (options_.interrupted && options_.interrupted()) { break; }
            if (const auto begun = start_some(); !begun) { return std::unexpected(begun.error()); }
            wait();
            collect();
        }
        sandboxes_.clear();
        return report();
    }

private:
    /// Makes all log directories before the first scenario runs.
    std::expected<void, std::string> open_folders() {
        for (const Scenario& scenario : scenarios_) {
            if (!options_.keep) { break; }
            const auto folder = open_folder(*options_.keep / scenario.name());
            if (!folder) { return std::unexpected(folder.error()); }
            folders_.emplace_back(*folder);
        }
        return {};
    }

    std::expected<void, std::string> find_image() {
        const auto in_containers = [](const Scenario& scenario) { return scenario.asked.place() == Asked::CONTAINER; };
        if (std::ranges::none_of(scenarios_, in_containers)) { return {}; }
        auto containers = Containers::of(options_.image);
        if (!containers) { return std::unexpected(containers.error()); }
        containers_ = *std::move(containers);
        return {};
    }

    std::expected<void, std::string> start_some() {
        while (next_ < scenarios_.size() && sandboxes_.size() < static_cast<std::size_t>(options_.at_a_time)) {
            const Scenario& scenario = scenarios_[next_];
            const int folder = options_.keep ? folders_[next_].get() : -1;
            auto sandbox =
                Sandbox::start([&] { return run_scenario(scenario, containers_, folder).SerializeAsString(); });
            if (!sandbox) { return std::unexpected(sandbox.error()); }
            sandboxes_.emplace(next_++, *std::move(sandbox));
        }
        return {};
    }

    void wait() {
        std::vector<pollfd> ends;
        std::string names;
        for (const auto& [index, sandbox] : sandboxes_) {
            ends.push_back({sandbox.readable(), POLLIN, 0});
            names += (names.empty() ? "" : ", ") + scenarios_[index].name();
        }
        if (options_.progress) { options_.progress("running " + names); }
        poll(ends.data(), ends.size(), kPollInterval_ms);
        for (auto end = ends.begin(); auto& [index, sandbox] : sandboxes_) {
            if ((end++)->revents != 0 && sandbox.read_output()) { ended_.push_back(index); }
        }
    }

    void collect() {
        for (const std::size_t index : ended_) {
            const auto result = sandboxes_.at(index).result();
            proto::ScenarioReport& report = reports_[index];
            if (!result || !report.ParseFromString(*result)) {
                fill_broken(index, result ? "its report is damaged" : result.error());
            }
            if (options_.keep) { report.set_kept((*options_.keep / scenarios_[index].name()).string()); }
            if (options_.finished) { options_.finished(report); }
            sandboxes_.erase(index);
        }
        ended_.clear();
    }

    void fill_broken(std::size_t index, const std::string& why) {
        reports_[index].Clear();
        reports_[index].set_file(scenarios_[index].file.string());
        reports_[index].set_shows(scenarios_[index].asked.shows());
        reports_[index].set_broken(why);
    }

    proto::ScenarioRunReport report() {
        proto::ScenarioRunReport all;
        for (std::size_t i = 0; i < reports_.size(); ++i) {
            if (reports_[i].file().empty()) { fill_broken(i, "interrupted before its end"); }
            *all.add_scenarios() = reports_[i];
            reports_[i].held() ? all.set_held(all.held() + 1) : all.set_failed(all.failed() + 1);
        }
        return all;
    }

    const std::vector<Scenario>& scenarios_;
    const RunnerOptions& options_;
    std::vector<proto::ScenarioReport> reports_;
    std::vector<Descriptor> folders_;  // of the scenarios, open
    std::optional<Containers> containers_;
    std::map<std::size_t, Sandbox> sandboxes_;  // by the scenario's index
    std::vector<std::size_t> ended_;
    std::size_t next_ = 0;
};

}  // namespace

std::expected<proto::ScenarioRunReport, std::string> run_scenarios(const std::vector<Scenario>& scenarios,
                                                                   const RunnerOptions& options) {
    return ScenarioRunner(scenarios, options).run();
}

}  // namespace lockstep::scenario
