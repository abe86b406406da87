// The unfinished tasks, in the machine's thread. A task that needs the lease begins when the lease is held.
#pragma once

#include <memory>
#include <vector>

#include "clients/web/machine/session_lease.hpp"
#include "clients/web/machine/task.hpp"

namespace lockstep::web {

class TaskQueue {
public:
    static constexpr std::size_t kMost = 64;
    static constexpr std::size_t kMostStops = 16;  // in addition, of tasks that need no lease

    bool is_full(bool is_stop) const { return tasks_.size() >= kMost + (is_stop ? kMostStops : 0); }
    bool is_empty() const { return tasks_.empty(); }
    void add(std::unique_ptr<Task> task) { tasks_.push_back({std::move(task)}); }
    void poll(Session& session, const SessionLease& lease);

    /// True if a task uses the session's one sender of programs.
    bool sends() const;
    /// True if a task waits for the lease.
    bool wants_lease() const;
    /// True if a waiting task takes the lease from another writer, too.
    bool takes_lease() const;

private:
    struct Entry {
        std::unique_ptr<Task> task;
        bool has_begun = false;
    };
    /// Returns true if the task is over.
    static bool poll(Entry& entry, Session& session, const SessionLease& lease);
    bool any_waits(Task::Lease least) const;

    std::vector<Entry> tasks_;
};

}  // namespace lockstep::web
