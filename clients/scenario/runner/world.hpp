// A world of its own for what a scenario plays: network, processes and memory apart from the host's. Whatever becomes
// of this process, nothing of it is left behind: the kernel ends its processes and takes its networks and files away.
#pragma once

#include <sys/types.h>

#include <expected>
#include <filesystem>
#include <functional>
#include <string>

namespace lockstep::scenario {

/// Within a world: a directory in memory, gone with it.
std::filesystem::path world_folder();

class World {
public:
    /// Plays it in a world of its own; what it returns is its result. Call it while this process has one thread. Error:
    /// why there can be no such world, and the remedy.
    static std::expected<World, std::string> begin(const std::function<std::string()>& play);

    World(World&& other) noexcept;
    World& operator=(World&&) = delete;
    World(const World&) = delete;
    /// Ends it, where it has not ended by itself.
    ~World();

    /// Becomes readable when there is something to take.
    int readable() const { return pipe_; }
    /// True: it has ended, and its result is whole.
    bool take();
    /// Once it has ended. Error: how it ended without one.
    std::expected<std::string, std::string> result() const;

private:
    World(pid_t keeper, int pipe) : keeper_(keeper), pipe_(pipe) {}

    pid_t keeper_;  // the process outside, with whose end the world ends
    int pipe_;
    std::string said_;
    bool ended_ = false;
};

}  // namespace lockstep::scenario
