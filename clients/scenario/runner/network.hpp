// The network of a sandbox: one namespace for all processes, or one for each, joined by a bridge, with links that can
// be cut.
#pragma once

#include <expected>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "clients/scenario/model/scenario.hpp"
#include "clients/scenario/runner/child_process.hpp"

namespace lockstep::scenario {

class Network {
public:
    /// Call it inside a sandbox. `log` receives the output of the programs that it runs. The error says what failed.
    static std::expected<Network, std::string> make(Asked::Place place, const std::vector<std::string>& processes,
                                                    const std::filesystem::path& log);

    /// The name of a process's own network namespace; empty if it has none.
    std::string namespace_of(const std::string& process) const;
    /// The prefix of a process's command line that runs it in its own network.
    CommandLine entry(const std::string& process) const;

    /// Drops `percent` of the process's packets, except those of the record, until heal(). The error says what failed.
    std::expected<void, std::string> lose(const std::string& process, double percent, Asked::Way way);
    std::expected<void, std::string> heal(const std::string& process);
    std::expected<void, std::string> heal_all();

    std::vector<std::string> linked() const;

private:
    explicit Network(std::filesystem::path log) : log_(std::move(log)) {}

    std::expected<void, std::string> make_loopback();
    std::expected<void, std::string> make_bridge();
    std::expected<void, std::string> add(const std::string& process, int number);
    std::expected<void, std::string> run_all(const std::vector<CommandLine>& commands) const;

    std::filesystem::path log_;
    std::map<std::string, std::string> namespaces_;  // of processes
};

}  // namespace lockstep::scenario
